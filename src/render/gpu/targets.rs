//! What a frame is drawn into, of its size, kept from frame to frame.

use wgpu::{TextureFormat, TextureUsages};

use super::bindings::view;
use super::device::Device;
use super::pipelines::DEPTH;
use super::readback::Region;
use super::tiles::Lists;
use super::timing::Clock;
use crate::canvas::RenderError;

/// Diffuse light with a beside it; specular light.
pub(crate) const LIGHT: TextureFormat = TextureFormat::Rgba16Float;
/// Depth along the view's axis.
pub(crate) const DISTANCE: TextureFormat = TextureFormat::R32Float;
/// Ids of faces.
pub(crate) const FACES: TextureFormat = TextureFormat::R32Uint;
/// Discoloration, and the picture.
pub(crate) const BYTES: TextureFormat = TextureFormat::Rgba8Unorm;

/// The most pixels of a frame, 2.7 GB.
const MOST_PIXELS: u64 = 1 << 26;

/// Everything of a frame's size.
#[derive(Debug)]
pub(crate) struct Targets {
    /// Width and height.
    pub(crate) size: [u32; 2],
    /// The nearest face.
    pub(crate) faces: wgpu::TextureView,
    /// Diffuse light, in the end scattered.
    pub(crate) diffuse: wgpu::Texture,
    /// Diffuse light, scattered across.
    pub(crate) across: wgpu::Texture,
    /// Specular light.
    pub(crate) specular: wgpu::TextureView,
    /// Depth along the view's axis.
    pub(crate) distance: wgpu::TextureView,
    /// Discoloration.
    pub(crate) discolor: wgpu::TextureView,
    /// What decides which surface is nearest.
    pub(crate) nearest: wgpu::TextureView,
    /// The picture.
    pub(crate) picture: wgpu::Texture,
    /// The lists of tiles.
    pub(crate) lists: Lists,
    /// What is read back: the picture, the lists' lengths, and the times.
    pub(crate) staging: wgpu::Buffer,
}

impl Targets {
    /// For frames of a size.
    pub(crate) fn new(device: &Device, size: [u32; 2]) -> Result<Self, RenderError> {
        let [w, h] = size;
        if u64::from(w) * u64::from(h) > MOST_PIXELS {
            return Err(RenderError::TooLarge(format!("a frame of {w} x {h} pixels")));
        }
        let drawn = TextureUsages::RENDER_ATTACHMENT;
        let read = drawn | TextureUsages::TEXTURE_BINDING;
        let texture = |label, format, usage| device.texture(label, size, format, usage);
        let whole = |label, format| texture(label, format, read).map(|texture| view(&texture));
        let staged = Self::whole(size).padded() + Lists::DRAWS.next_multiple_of(256) + Clock::BYTES;
        Ok(Self {
            size,
            faces: whole("faces", FACES)?,
            diffuse: texture("diffuse light", LIGHT, read | TextureUsages::COPY_SRC)?,
            across: texture("light scattered across", LIGHT, read | TextureUsages::COPY_DST)?,
            specular: whole("specular light", LIGHT)?,
            distance: whole("distance", DISTANCE)?,
            discolor: whole("discoloration", BYTES)?,
            nearest: view(&texture("nearest", DEPTH, drawn)?),
            picture: texture("picture", BYTES, drawn | TextureUsages::COPY_SRC)?,
            lists: Lists::new(device, size)?,
            staging: device.staging("what is read back", staged)?,
        })
    }

    fn whole(size: [u32; 2]) -> Region {
        Region { origin: [0; 2], size, texel: 4 }
    }

    /// The picture as it lies at the beginning of what is read back.
    pub(crate) fn region(&self) -> Region {
        Self::whole(self.size)
    }

    /// Where the lists' lengths lie in it.
    pub(crate) fn draws_at(&self) -> u64 {
        self.region().padded()
    }

    /// Where the times do.
    pub(crate) fn times_at(&self) -> u64 {
        self.draws_at() + Lists::DRAWS.next_multiple_of(256)
    }
}

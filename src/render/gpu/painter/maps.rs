//! The two maps that are painted on, as they lie on the device.

use wgpu::{TextureFormat, TextureUsages};

use crate::canvas::RenderError;
use crate::canvas::image::Image;
use crate::render::gpu::device::Device;
use crate::render::gpu::readback::Region;

/// The colour map and the discolour map. They stay the same textures, whatever is painted.
#[derive(Debug)]
pub(super) struct Pair {
    pub(super) color: wgpu::Texture,
    pub(super) discolor: wgpu::Texture,
}

impl Pair {
    /// A scene's colour map, and nothing discoloured.
    pub(super) fn new(device: &Device, color: &Image) -> Result<Self, RenderError> {
        let usage = TextureUsages::TEXTURE_BINDING
            | TextureUsages::STORAGE_BINDING
            | TextureUsages::COPY_SRC
            | TextureUsages::COPY_DST;
        let texture = |label| device.texture(label, color.size, TextureFormat::Rgba8Unorm, usage);
        let pair = Self { color: texture("colour map")?, discolor: texture("discolour map")? };
        pair.reset(device, color)?;
        Ok(pair)
    }

    /// Makes them so again.
    pub(super) fn reset(&self, device: &Device, color: &Image) -> Result<(), RenderError> {
        write(device, &self.color, color.bytes(), 4)?;
        write(device, &self.discolor, Image::filled(color.size, [0; 4]).bytes(), 4)
    }

    /// Their width and height.
    pub(super) fn size(&self) -> [u32; 2] {
        [self.color.width(), self.color.height()]
    }
}

/// Writes a whole texture, row by row, of so many bytes a texel.
pub(super) fn write(
    device: &Device,
    texture: &wgpu::Texture,
    bytes: &[u8],
    texel: u32,
) -> Result<(), RenderError> {
    let bytes_per_row = Some(texel * texture.width());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image: None };
    device.guarded("writing a map", || {
        device.queue.write_texture(texture.as_image_copy(), bytes, layout, texture.size());
    })
}

/// A whole map as it is now.
pub(super) fn read(device: &Device, texture: &wgpu::Texture) -> Result<Image, RenderError> {
    let size = [texture.width(), texture.height()];
    let bytes = device.read_texture(texture, Region { origin: [0; 2], size, texel: 4 })?;
    Ok(Image { size, texels: texels(&bytes) })
}

/// Bytes as texels.
pub(super) fn texels(bytes: &[u8]) -> Vec<[u8; 4]> {
    bytes.as_chunks().0.to_vec()
}

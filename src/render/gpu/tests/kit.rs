//! The device, opened once; a scene of the built-in bust, or of any mesh, with maps that vary; and how far two pictures are apart.

use std::sync::{Arc, OnceLock};

use glam::DVec3;
use wgpu::TextureUsages;

use crate::assets::builtin::builtin;
use crate::canvas::RenderError;
use crate::canvas::frame::{Frame, FrameJob, Light, View, place_lights};
use crate::canvas::image::{Image, Maps};
use crate::canvas::look::{Look, Switches};
use crate::mesh::{Face, FaceId, Mesh, Surface};
use crate::render::gpu::device::Device;
use crate::render::gpu::frames::{Frames, Passes};
use crate::render::reference;

/// The device that all tests share, if there is one.
pub(crate) fn device() -> Option<Arc<Device>> {
    static DEVICE: OnceLock<Option<Arc<Device>>> = OnceLock::new();
    let device = DEVICE.get_or_init(|| own_device().map(Arc::new)).clone();
    if device.is_none() {
        eprintln!("skipped: no adapter");
    }
    device
}

/// A device of one's own, to break. Where there is none a test is skipped, and fails where one is required.
pub(super) fn own_device() -> Option<Device> {
    match Device::open() {
        Ok(device) => Some(device),
        Err(RenderError::NoAdapter(why)) => {
            assert_ne!(std::env::var("LANCET_GPU").as_deref(), Ok("require"), "no adapter: {why}");
            None
        }
        Err(other) => panic!("{other}"),
    }
}

/// A texel's place, and the texel there.
fn image(size: [u32; 2], texel: impl Fn(u32, u32) -> [u8; 4]) -> Image {
    let texels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| texel(x, y));
    Image { size, texels: texels.collect() }
}

/// Maps of several sizes, none of them even, in which everything varies.
fn maps() -> Maps {
    let wave = |x: u32, y: u32, step: u32| ((x * step + y * (step + 3)) % 64) as u8;
    Maps {
        color: image([97, 61], |x, y| {
            let a = if (x / 12 + y / 12) % 3 == 0 { 0 } else { 190 + wave(x, y, 5) };
            [200 + wave(x, y, 3) / 2, 150 + wave(x, y, 7) / 2, 130 + wave(x, y, 11) / 2, a]
        }),
        normal: image([53, 47], |x, y| [112 + wave(x, y, 9) / 2, 112 + wave(x, y, 5) / 2, 255, 255]),
        occlusion: image([31, 33], |x, y| [150 + wave(x, y, 3), 0, 0, 255]),
        specular: image([29, 37], |x, y| [100 + wave(x, y, 5), 60 + wave(x, y, 3), 0, 255]),
    }
}

/// Discoloration in a part of it.
fn discolor([w, h]: [u32; 2]) -> Image {
    let within = move |x: u32, y: u32| (x / 16 + y / 16) % 3 == 1;
    image([w, h], |x, y| if within(x, y) { [110, 80, 85, 40 + (x * 3 % 200) as u8] } else { [0; 4] })
}

/// A scene.
pub(super) struct Scene {
    pub(super) mesh: Mesh,
    pub(super) maps: Arc<Maps>,
    pub(super) discolor: Image,
    pub(super) look: Look,
    pub(super) switches: Switches,
    pub(super) lights: Vec<Light>,
    pub(super) view: View,
    pub(super) version: u64,
    pub(super) everything: bool,
    pub(super) origin: DVec3,
}

impl Scene {
    /// The built-in bust.
    pub(super) fn bust(size: [u32; 2]) -> Self {
        static BUST: OnceLock<Mesh> = OnceLock::new();
        let build = || Mesh::build(&builtin("bust").expect("the bust").mesh).expect("a mesh");
        Self::of(BUST.get_or_init(build).clone(), size)
    }

    /// Any mesh, seen from ahead and a little aside.
    pub(super) fn of(mesh: Mesh, size: [u32; 2]) -> Self {
        let [low, high] = mesh.bounds();
        let (centre, radius) = ((low + high) * 0.5, low.distance(high) * 0.5);
        let (look, maps) = (Look::default(), maps());
        let mut lights = place_lights(&look, centre, radius);
        // One that shines past it.
        lights.insert(1, Light { reaches: false, ..turned(lights[0]) });
        Self {
            view: view(centre, radius, 0.5, size),
            discolor: discolor(maps.color.size),
            maps: Arc::new(maps),
            switches: Switches::default(),
            version: 1,
            everything: false,
            origin: centre,
            lights,
            look,
            mesh,
        }
    }

    pub(super) fn job(&self) -> FrameJob<'_> {
        FrameJob {
            mesh: &self.mesh,
            version: self.version,
            view: self.view,
            lights: &self.lights,
            look: &self.look,
            switches: self.switches,
            unit_cm: 1.0,
            origin: self.origin,
            everything: self.everything,
        }
    }

    /// Looks from another side.
    pub(super) fn turn(&mut self, azimuth: f64) {
        let [low, high] = self.mesh.bounds();
        self.view = view((low + high) * 0.5, low.distance(high) * 0.5, azimuth, self.view.size);
    }

    /// Makes the chart of the face that is nearest to the eye the inside of a cut.
    pub(super) fn open_a_chart(&mut self) {
        let mesh = &self.mesh;
        let away = |f: &usize| mesh.triangle(FaceId(*f as u32))[0].distance(self.view.eye);
        let first = (0..mesh.face_count()).min_by(|a, b| away(a).total_cmp(&away(b))).expect("a face");
        let mut inside = vec![false; mesh.vertex_count()];
        inside[mesh.faces()[first].vertices[0].0 as usize] = true;
        let mut count = 0;
        while count < inside.iter().filter(|&&i| i).count() {
            count = inside.iter().filter(|&&i| i).count();
            for face in mesh.faces() {
                if face.vertices.iter().any(|v| inside[v.0 as usize]) {
                    face.vertices.iter().for_each(|v| inside[v.0 as usize] = true);
                }
            }
        }
        let open = |f: &Face| if inside[f.vertices[0].0 as usize] { Surface::Gutter } else { Surface::Skin };
        let surfaces: Vec<_> = mesh.faces().iter().map(open).collect();
        for (i, surface) in (0..).zip(surfaces) {
            let face = *self.mesh.face(FaceId(i));
            self.mesh.set_face(FaceId(i), Face { surface, ..face });
        }
        self.version += 1;
    }

    /// The frame that the CPU makes of it.
    pub(super) fn reference(&self) -> Frame {
        let mut frames = reference::Frames::new(self.maps.clone());
        frames.frame(&self.job(), &self.maps.color, &self.discolor).expect("a frame")
    }
}

/// A light with its back to what it shone on.
fn turned(light: Light) -> Light {
    let [right, up, forward] = light.basis;
    Light { basis: [-right, up, -forward], ..light }
}

fn view(centre: DVec3, radius: f64, azimuth: f64, size: [u32; 2]) -> View {
    let (sin, cos) = libm::sincos(azimuth);
    let distance = 1.1 * radius / libm::sin(0.3);
    let (right, forward) = (DVec3::new(cos, 0.0, -sin), DVec3::new(-sin, 0.0, -cos));
    View {
        eye: centre - forward * distance,
        basis: [right, DVec3::Y, forward],
        fov_y: 0.6,
        size,
        near: distance - 1.05 * radius,
        far: distance + 1.05 * radius,
    }
}

/// Renders a scene's frames on the device.
pub(super) struct OnDevice {
    pub(super) frames: Frames,
    painted: [wgpu::Texture; 2],
}

impl OnDevice {
    pub(super) fn new(device: &Arc<Device>, scene: &Scene) -> Self {
        static PASSES: OnceLock<Arc<Passes>> = OnceLock::new();
        let passes = PASSES.get_or_init(|| Arc::new(Passes::new(device).expect("passes"))).clone();
        let painted = [&scene.maps.color, &scene.discolor]
            .map(|map| device.upload("painted", map, TextureUsages::TEXTURE_BINDING).expect("a map"));
        Self { frames: Frames::new(device.clone(), passes, &scene.maps).expect("frames"), painted }
    }

    pub(super) fn try_frame(&mut self, scene: &Scene) -> Result<Frame, RenderError> {
        self.frames.frame(&scene.job(), &self.painted[0], &self.painted[1])
    }

    pub(super) fn frame(&mut self, scene: &Scene) -> Frame {
        self.try_frame(scene).expect("a frame")
    }
}

/// How far apart two pictures are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// Mean absolute difference of a channel, bytes.
    pub(super) mean: f64,
    /// Mean difference of each channel, bytes.
    pub(super) shift: [f64; 3],
    /// The part of the pixels with a channel off by more than 8.
    pub(super) outliers: f64,
    /// The most that a channel is off.
    pub(super) most: u8,
}

pub(super) fn gap(ours: &Image, theirs: &Image) -> Gap {
    assert_eq!(ours.size, theirs.size);
    let count = ours.texels.len() as f64;
    let mut gap = Gap { mean: 0.0, shift: [0.0; 3], outliers: 0.0, most: 0 };
    for (a, b) in ours.texels.iter().zip(&theirs.texels) {
        let off = [0, 1, 2].map(|c| i32::from(a[c]) - i32::from(b[c]));
        let most = off.map(i32::unsigned_abs).into_iter().max().unwrap_or(0);
        gap.most = gap.most.max(most as u8);
        gap.outliers += f64::from(u8::from(most > 8)) / count;
        for (c, off) in off.into_iter().enumerate() {
            gap.mean += f64::from(off.abs()) / (3.0 * count);
            gap.shift[c] += f64::from(off) / count;
        }
    }
    gap
}

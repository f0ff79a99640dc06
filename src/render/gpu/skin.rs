//! The skin pass: what the surface that is seen is made of, and what light leaves it (Lam 2016, Appendix B), pixel by pixel over the tiles that
//! hold any.
//!
//! Each combination of switches has a pipeline of its own, in which what is off is not there; nor are the targets that nobody would read.

use wgpu::{BindingResource, BufferUsages, ShaderStages, TextureFormat, TextureUsages};

use super::bindings::{Bound, group, layout, pipeline_layout, view};
use super::device::Device;
use super::mesh::Surface;
use super::pipelines::{Cache, Drawing, cleared};
use super::record::{Words, bytes};
use super::shadow::ShadowMaps;
use super::store::Store;
use super::targets::{BYTES, DISTANCE, LIGHT, Targets};
use super::tiles::Lists;
use super::timing::Recorder;
use super::uniforms::{self, Lamp, Scene, Transport};
use crate::canvas::RenderError;
use crate::canvas::frame::FrameJob;
use crate::canvas::image::Maps;
use crate::canvas::look::Switches;
use crate::render::{beckmann, srgb};

/// Farther than anything: the depth where nothing is seen.
const NOTHING: f64 = 1e30;

/// The shader's constants, in the order of a [`Key`].
const CONSTANTS: [&str; 8] = [
    "SHADOWS",
    "TRANSMITTANCE",
    "SPECULAR",
    "COLOR_MAP",
    "NORMAL_MAP",
    "OCCLUSION_MAP",
    "SPECULAR_MAP",
    "DISCOLORATION",
];

/// What is on.
type Key = [bool; 8];

fn key(switches: Switches) -> Key {
    [
        switches.shadows,
        switches.transmittance,
        switches.specular,
        switches.color_map,
        switches.normal_map,
        switches.occlusion_map,
        switches.specular_map,
        // It changes how light scatters, and nothing else.
        switches.discoloration && switches.scattering,
    ]
}

/// What is drawn into: light, distance, and if they are on specular light and discoloration.
fn formats(key: &Key) -> [Option<TextureFormat>; 4] {
    [Some(LIGHT), Some(DISTANCE), key[2].then_some(LIGHT), key[7].then_some(BYTES)]
}

/// Shades the surface.
#[derive(Debug)]
pub(crate) struct SkinPass {
    frame: wgpu::BindGroupLayout,
    maps: wgpu::BindGroupLayout,
    seen: wgpu::BindGroupLayout,
    whole: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    pipelines: Cache<Key>,
    decoded: wgpu::Buffer,
    beckmann: wgpu::Buffer,
}

/// What it keeps on the device for a scene.
#[derive(Debug)]
pub(crate) struct SkinState {
    scene: Store,
    lights: Store,
    transport: Store,
    normal: wgpu::TextureView,
    occlusion: wgpu::TextureView,
    specular: wgpu::TextureView,
}

impl SkinState {
    /// With a scene's maps, but for those that are painted on.
    pub(crate) fn new(device: &Device, maps: &Maps) -> Result<Self, RenderError> {
        let upload = |label, map| {
            device.upload(label, map, TextureUsages::TEXTURE_BINDING).map(|texture| view(&texture))
        };
        Ok(Self {
            scene: Store::new("scene", BufferUsages::UNIFORM),
            lights: Store::new("lights", BufferUsages::STORAGE),
            transport: Store::new("transport", BufferUsages::UNIFORM),
            normal: upload("normal map", &maps.normal)?,
            occlusion: upload("occlusion map", &maps.occlusion)?,
            specular: upload("specular map", &maps.specular)?,
        })
    }
}

/// What a frame shades with.
#[derive(Debug)]
pub(crate) struct Shaded<'a> {
    /// What is seen.
    pub(crate) surface: &'a Surface,
    /// The lights that reach it, by their place in the job; the first reads the first layer of the shadow maps.
    pub(crate) lights: &'a [usize],
    /// What they see.
    pub(crate) shadows: &'a ShadowMaps,
    /// The colour and the discolour map.
    pub(crate) painted: [&'a wgpu::Texture; 2],
}

impl SkinPass {
    /// Compiles what all pipelines share.
    pub(crate) fn new(device: &Device) -> Result<Self, RenderError> {
        let stages = ShaderStages::VERTEX_FRAGMENT;
        let [scene, transport] = [Scene::COUNT, Transport::COUNT].map(|n| Bound::Uniform(4 * n as u64));
        let frame = layout(device, "skin", stages, &[scene, Bound::Read, transport, Bound::Depths])?;
        let mut bound = vec![Bound::Read, Bound::Read];
        bound.extend([Bound::Texture; 5]);
        let maps = layout(device, "maps", ShaderStages::FRAGMENT, &bound)?;
        let seen =
            layout(device, "what is seen", stages, &[Bound::Faces, Bound::Read, Bound::Read, Bound::Read])?;
        let whole = pipeline_layout(device, "skin", &[&frame, &maps, &seen])?;
        let table =
            |label, values: &[f32]| device.filled(label, bytemuck::cast_slice(values), BufferUsages::STORAGE);
        Ok(Self {
            frame,
            maps,
            seen,
            whole,
            module: device.shader("skin")?,
            pipelines: Cache::new(),
            decoded: table("sRGB decoded", srgb::decoded())?,
            beckmann: table("Beckmann's distribution", beckmann::table())?,
        })
    }

    /// Shades what is seen.
    pub(crate) fn draw(
        &self,
        recorder: &mut Recorder<'_>,
        state: &mut SkinState,
        targets: &Targets,
        with: &Shaded<'_>,
        job: &FrameJob<'_>,
    ) -> Result<(), RenderError> {
        let device = recorder.device();
        let key = key(job.switches);
        let pipeline = self.pipelines.get(key, |key| self.make(device, key))?;
        let frame = self.bind_frame(device, state, with, job)?;
        let maps = self.bind_maps(device, state, with.painted)?;
        let seen = self.bind_seen(device, targets, with.surface)?;
        let diffuse = view(&targets.diffuse);
        let views = [&diffuse, &targets.distance, &targets.specular, &targets.discolor];
        let first = [0.0, NOTHING, 0.0, 0.0];
        let used = formats(&key).map(|format| format.is_some());
        let attachments: [_; 4] = std::array::from_fn(|i| used[i].then(|| cleared(views[i], first[i])));
        recorder.pass("skin", |encoder, stamps| {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("skin"),
                color_attachments: &attachments,
                timestamp_writes: stamps.render(true, true),
                ..wgpu::RenderPassDescriptor::default()
            });
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &frame, &[]);
            pass.set_bind_group(1, &maps, &[]);
            pass.set_bind_group(2, &seen, &[]);
            pass.draw_indirect(&targets.lists.draws, Lists::SEEN);
        })
    }

    fn make(&self, device: &Device, key: &Key) -> Result<wgpu::RenderPipeline, RenderError> {
        let constants: [_; 8] = std::array::from_fn(|i| (CONSTANTS[i], f64::from(u8::from(key[i]))));
        Drawing {
            label: "skin",
            layout: &self.whole,
            module: &self.module,
            vertex: "cover",
            fragment: Some("shade"),
            targets: &formats(key),
            constants: &constants,
            attributes: &[],
            nearest: false,
        }
        .make(device)
    }

    fn bind_frame(
        &self,
        device: &Device,
        state: &mut SkinState,
        with: &Shaded<'_>,
        job: &FrameJob<'_>,
    ) -> Result<wgpu::BindGroup, RenderError> {
        let scene = uniforms::scene(job, with.lights.len());
        let lit = (0..).zip(with.lights).map(|(layer, &i)| uniforms::lamp(&job.lights[i], job.origin, layer));
        let mut lamps: Vec<_> = lit.collect();
        if lamps.is_empty() {
            // Something has to be bound; it is not counted.
            lamps.push(Lamp::default());
        }
        let scene = state.scene.put(device, &bytes(&[scene]))?;
        let lights = state.lights.put(device, &bytes(&lamps))?;
        let transport = state.transport.put(device, &bytes(&[uniforms::transport(job)]))?;
        let maps = with.shadows.view();
        let resources = [
            scene.as_entire_binding(),
            lights.as_entire_binding(),
            transport.as_entire_binding(),
            BindingResource::TextureView(&maps),
        ];
        group(device, "skin", &self.frame, &resources)
    }

    fn bind_seen(
        &self,
        device: &Device,
        targets: &Targets,
        surface: &Surface,
    ) -> Result<wgpu::BindGroup, RenderError> {
        let [vertices, corners] = surface.buffers()?;
        let resources = [
            BindingResource::TextureView(&targets.faces),
            vertices.as_entire_binding(),
            corners.as_entire_binding(),
            targets.lists.seen.as_entire_binding(),
        ];
        group(device, "what is seen", &self.seen, &resources)
    }

    fn bind_maps(
        &self,
        device: &Device,
        state: &SkinState,
        painted: [&wgpu::Texture; 2],
    ) -> Result<wgpu::BindGroup, RenderError> {
        let [color, discolor] = painted.map(view);
        let textures = [&color, &state.normal, &state.occlusion, &state.specular, &discolor];
        let mut resources = vec![self.decoded.as_entire_binding(), self.beckmann.as_entire_binding()];
        resources.extend(textures.map(BindingResource::TextureView));
        group(device, "maps", &self.maps, &resources)
    }
}

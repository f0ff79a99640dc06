//! PP's first half on the device: which triangle has each texel (`shaders/place.wgsl`).
//!
//! The triangles of a painting are drawn into a target of triangle numbers, skirts first, faces over them; drawing in order is what makes the
//! later one win. The target holds only the tiles that may change, row by row of [`ACROSS`](super::journal::ACROSS). Every run of them is
//! drawn with its own triangles through a viewport that is the whole map, moved so that the run falls on its place, and a scissor
//! that lets nothing else through. So no triangle is clipped on the map, corners stay on the 1/256 grid that the CPU rounds to,
//! and the device's top-left rule gives the CPU's coverage.
//!
//! A number, not the coordinates: `paint` computes (s, d) at the texel's centre from the triangle's affine map, as the CPU does,
//! and a rasterizer's interpolation is no part of the result.

use wgpu::{BufferUsages, TextureFormat, TextureUsages};

use super::journal::{ACROSS, Block, Run};
use super::passes::bound;
use super::record::{bytes, record};
use crate::canvas::RenderError;
use crate::render::gpu::device::Device;
use crate::render::layout::{self, Affine, TILE};
use crate::render::spans::PARTS;

/// What the target holds: 0, or a triangle's number counted from 1.
const FORMAT: TextureFormat = TextureFormat::R32Uint;

/// The most triangle corners that are drawn at a time.
const MOST_CORNERS: usize = 1 << 26;

record! {
    /// A triangle on the map.
    Triangle {
        a: [f32; 2],
        b: [f32; 2],
        c: [f32; 2],
        value: [f32; 2],
        across: [f32; 2],
        down: [f32; 2],
        skirt: u32,
        unused: u32,
    }
}

record! {
    /// Where a run lies.
    Shift {
        map_origin: [u32; 2],
        target_origin: [u32; 2],
    }
}

impl From<&layout::Triangle> for Triangle {
    fn from(triangle: &layout::Triangle) -> Self {
        let corners = layout::corners(triangle);
        let affine = Affine::new(corners, triangle.at);
        let [x, y] = corners[0];
        let [here, right, below] = [[x, y], [x + PARTS, y], [x, y + PARTS]].map(|p| affine.at(p));
        let grows = |there: [f64; 2]| [0, 1].map(|k| (there[k] - here[k]) as f32);
        let [a, b, c] = triangle.corners;
        let (across, down, skirt) = (grows(right), grows(below), triangle.skirt.into());
        Self { a, b, c, value: triangle.at[0], across, down, skirt, unused: 0 }
    }
}

/// What a block's tiles are drawn with.
#[derive(Debug)]
pub(super) struct Prepared {
    bound: wgpu::BindGroup,
    /// Corners of triangles, run after run.
    corners: wgpu::Buffer,
    /// Where each run's corners end.
    ends: Vec<u32>,
}

/// The pass.
#[derive(Debug)]
pub(super) struct PlacePass(wgpu::RenderPipeline);

impl PlacePass {
    pub(super) fn new(device: &Device) -> Result<Self, RenderError> {
        let shader = device.shader("place")?;
        let pipeline = device.guarded("place", || {
            device.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("place"),
                layout: None,
                vertex: wgpu::VertexState {
                    module: &shader,
                    entry_point: Some("vertex"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &shader,
                    entry_point: Some("fragment"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(FORMAT.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
        })?;
        Ok(Self(pipeline))
    }

    /// A target with so many rows of tiles.
    pub(super) fn target(device: &Device, rows: u32) -> Result<wgpu::Texture, RenderError> {
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        device.texture("placed triangles", [ACROSS * TILE, rows * TILE], FORMAT, usage)
    }

    /// Prepares the drawing of a block.
    pub(super) fn prepare(
        &self,
        device: &Device,
        block: &Block,
        drawn: &Drawn<'_>,
    ) -> Result<Prepared, RenderError> {
        let runs: Vec<_> = block.runs.iter().map(Shift::from).collect();
        let runs = device.filled("runs", &bytes(&runs), BufferUsages::STORAGE)?;
        let (corners, ends) = corners(block, drawn.layout)?;
        let corners = device.filled("corners", bytemuck::cast_slice(&corners), BufferUsages::INDEX)?;
        let mask = drawn.mask.create_view(&wgpu::TextureViewDescriptor::default());
        let entries = [
            (0, drawn.triangles.as_entire_binding()),
            (1, wgpu::BindingResource::TextureView(&mask)),
            (2, runs.as_entire_binding()),
        ];
        let bound = bound(device, "place", &self.0.get_bind_group_layout(0), entries)?;
        Ok(Prepared { bound, corners, ends })
    }

    /// Asks for it.
    pub(super) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        block: &Block,
        prepared: &Prepared,
        target: &wgpu::TextureView,
        size: [u32; 2],
    ) {
        let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("PP: place triangles"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&self.0);
        pass.set_bind_group(0, &prepared.bound, &[]);
        pass.set_index_buffer(prepared.corners.slice(..), wgpu::IndexFormat::Uint32);
        let begins = std::iter::once(&0).chain(&prepared.ends);
        for (number, ((run, &begin), &end)) in (0..).zip(block.runs.iter().zip(begins).zip(&prepared.ends)) {
            let [x, y] = [0, 1].map(|k| run.target[k] as f32 - run.origin[k] as f32);
            let [across, down] = size.map(|side| side as f32);
            pass.set_viewport(x, y, across, down, 0.0, 1.0);
            pass.set_scissor_rect(run.target[0], run.target[1], run.size[0], run.size[1]);
            pass.draw_indexed(begin..end, 0, number..number + 1);
        }
    }
}

impl From<&Run> for Shift {
    fn from(run: &Run) -> Self {
        Self { map_origin: run.origin, target_origin: run.target }
    }
}

/// What is drawn, for all blocks of a painting.
#[derive(Debug)]
pub(super) struct Drawn<'a> {
    pub(super) layout: &'a layout::Layout,
    /// Its triangles on the device.
    pub(super) triangles: &'a wgpu::Buffer,
    /// 1 where a face of the mesh lies.
    pub(super) mask: &'a wgpu::Texture,
}

/// The corners of the triangles that may cover texels of each run, and where each run's end.
fn corners(block: &Block, layout: &layout::Layout) -> Result<(Vec<u32>, Vec<u32>), RenderError> {
    let (mut corners, mut ends) = (Vec::new(), Vec::new());
    for run in &block.runs {
        let meeting = (0..).zip(&layout.triangles).filter(|(_, triangle)| meets(triangle, run));
        corners.extend(meeting.flat_map(|(number, _): (u32, _)| [0, 1, 2].map(|k| 3 * number + k)));
        if corners.len() > MOST_CORNERS {
            return Err(RenderError::TooLarge(format!(
                "more than {} triangles over tiles",
                MOST_CORNERS / 3
            )));
        }
        ends.push(corners.len() as u32);
    }
    Ok((corners, ends))
}

/// Whether a triangle's box touches a run.
fn meets(triangle: &layout::Triangle, run: &Run) -> bool {
    (0..2).all(|k| {
        let [least, most] =
            [f32::min, f32::max].map(|pick| triangle.corners.map(|c| c[k]).into_iter().reduce(pick));
        least <= Some((run.origin[k] + run.size[k]) as f32) && most >= Some(run.origin[k] as f32)
    })
}

//! GP and PP on the device: the wound patch, and the maps that are painted on (Lam 2016, §5.3 and §5.4).
//!
//! What pixels must be is said in [`canvas::job`](crate::canvas::job). Here is how they come about: one submission a cut.
//!
//! | step | what it does | shader |
//! | --- | --- | --- |
//! | `patch` | makes the wound patch, if it is not the one made last | `patch.wgsl` |
//! | `journal` | saves the tiles that may change, of both maps | |
//! | `place` | draws the painting's triangles: which has each texel | `place.wgsl` |
//! | `paint` | patch and discoloration over the saved texels, into the maps | `paint.wgsl` |
//!
//! The maps never leave the device but to be looked at. Going back restores the saved tiles, bit for bit; what is no longer saved is made
//! again from the scene's own maps. Pipelines and the mask of the skin's texels are made when something is first painted.

mod check;
mod journal;
mod maps;
mod paint;
mod patch;
mod place;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use wgpu::{BindingResource, BufferUsages, TextureFormat, TextureUsages};

use self::journal::{Block, Journal, Saved, Trace, blocks};
use self::maps::Pair;
use self::paint::{Faults, PaintPass, Told};
use self::patch::{Made, PatchPass};
use self::place::{Drawn, PlacePass, Triangle};
use super::device::Device;
use super::record;
use crate::canvas::RenderError;
use crate::canvas::image::{Image, MapId, Maps};
use crate::canvas::job::{Painting, PatchJob};
use crate::mesh::Mesh;
use crate::render::layout::{TILE, lay_out};
use crate::render::mask::Charts;

/// Bytes that the journal may keep on the device.
const BUDGET: u64 = 64 << 20;

/// The passes, compiled.
#[derive(Debug)]
struct Passes {
    patch: PatchPass,
    place: PlacePass,
    paint: PaintPass,
}

impl Passes {
    fn new(device: &Device) -> Result<Self, RenderError> {
        let (patch, place) = (PatchPass::new(device)?, PlacePass::new(device)?);
        Ok(Self { patch, place, paint: PaintPass::new(device)? })
    }
}

/// Paints on the maps of one scene.
#[derive(Debug)]
pub struct Painter {
    device: Arc<Device>,
    /// The scene's own maps.
    scene: Arc<Maps>,
    maps: Pair,
    charts: Charts,
    /// Made when something is first painted.
    mask: Option<Mask>,
    passes: Option<Arc<Passes>>,
    /// Where triangles are placed; it grows with what is painted.
    target: Option<wgpu::Texture>,
    /// The patch that was made last.
    made: Option<Made>,
    journal: Journal,
}

impl Painter {
    /// A painter of a scene with nothing painted yet. Of the mesh only the faces' texture coordinates matter.
    pub fn new(device: Arc<Device>, maps: &Arc<Maps>, mesh: &Mesh) -> Result<Self, RenderError> {
        Self::with_budget(device, maps, mesh, BUDGET)
    }

    fn with_budget(
        device: Arc<Device>,
        maps: &Arc<Maps>,
        mesh: &Mesh,
        budget: u64,
    ) -> Result<Self, RenderError> {
        Ok(Self {
            maps: Pair::new(&device, &maps.color)?,
            device,
            scene: maps.clone(),
            charts: Charts::of(mesh),
            mask: None,
            passes: None,
            target: None,
            made: None,
            journal: Journal::new(budget),
        })
    }

    /// The colour map: the same texture for ever, `Rgba8Unorm`.
    pub fn color(&self) -> &wgpu::Texture {
        &self.maps.color
    }

    /// The discolour map: the same texture for ever, `Rgba8Unorm`.
    pub fn discolor(&self) -> &wgpu::Texture {
        &self.maps.discolor
    }

    /// The colour or the discolour map as it is now.
    pub fn map(&self, map: MapId) -> Result<Image, RenderError> {
        match map {
            MapId::Color => maps::read(&self.device, &self.maps.color),
            MapId::Discolor => maps::read(&self.device, &self.maps.discolor),
            other => Err(RenderError::Refused(format!("nobody paints on the map {other:?}"))),
        }
    }

    /// Makes the wound patch of a cut, and waits until it is there.
    pub fn patch(&mut self, job: &PatchJob) -> Result<(), RenderError> {
        let passes = self.passes()?;
        let (made, bound) = passes.patch.prepare(&self.device, job)?;
        self.device.submit("wound patch", |encoder| passes.patch.record(encoder, &made, &bound))?;
        self.device.wait()?;
        self.made = Some(made);
        Ok(())
    }

    /// Carries a painting out over those before it, and waits for it.
    pub fn paint(&mut self, painting: &Arc<Painting>) -> Result<(), RenderError> {
        let passes = self.passes()?;
        let cut = self.prepare(&passes, painting)?;
        self.device.submit("cut", |encoder| self.record(encoder, &passes, &cut))?;
        self.device.wait()?;
        self.made = Some(cut.wound.made);
        let saved = cut.blocks.into_iter().map(|block| block.saved).collect();
        self.journal.push(painting.clone(), Trace { saved, faults: cut.faults });
        Ok(())
    }

    /// Makes the maps those of these paintings, in this order: takes back what is not among them, carries out what is missing.
    pub fn follow(&mut self, paintings: &[Arc<Painting>]) -> Result<(), RenderError> {
        let common = self.journal.common(paintings);
        let kept = if self.go_back(common)? { common } else { self.start_again()? };
        paintings[kept..].iter().try_for_each(|painting| self.paint(painting))
    }

    /// Takes all but the first so many paintings back, or says that something of it is no longer saved.
    fn go_back(&mut self, count: usize) -> Result<bool, RenderError> {
        let Some(saved) = self.journal.back_to(count) else { return Ok(false) };
        if !saved.is_empty() {
            let maps = &self.maps;
            self.device.submit("paintings taken back", |encoder| {
                saved.iter().for_each(|saved| saved.restore(encoder, maps));
            })?;
            self.device.wait()?;
        }
        self.journal.truncate(count);
        Ok(true)
    }

    /// Goes back to the scene's own maps; so many paintings are left.
    fn start_again(&mut self) -> Result<usize, RenderError> {
        self.maps.reset(&self.device, &self.scene.color)?;
        self.journal.truncate(0);
        Ok(0)
    }

    /// The passes; they are compiled when something is first painted.
    fn passes(&mut self) -> Result<Arc<Passes>, RenderError> {
        let passes = match self.passes.take() {
            Some(passes) => passes,
            None => Arc::new(Passes::new(&self.device)?),
        };
        Ok(self.passes.insert(passes).clone())
    }

    /// The mask of the texels that faces cover.
    fn mask(&mut self) -> Result<wgpu::Texture, RenderError> {
        if let Some(mask) = &self.mask {
            return Ok(mask.texture.clone());
        }
        let (size, usage) = (self.maps.size(), TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST);
        let texture = self.device.texture("covered texels", size, TextureFormat::R8Uint, usage)?;
        let covered = self.charts.covered(size);
        maps::write(&self.device, &texture, &covered, 1)?;
        // Cuts do not change it, so the charts have done their work.
        self.charts = Charts::default();
        Ok(self.mask.insert(Mask { texture, covered }).texture.clone())
    }

    /// A target with at least so many rows of tiles.
    fn target(&mut self, rows: u32) -> Result<wgpu::TextureView, RenderError> {
        let target = match self.target.take() {
            Some(target) if target.height() >= rows * TILE => target,
            _ => PlacePass::target(&self.device, rows)?,
        };
        Ok(self.target.insert(target).create_view(&wgpu::TextureViewDescriptor::default()))
    }

    /// The patch of a painting; if it is not the one that was made last, with what makes it.
    fn wound(&self, passes: &Passes, job: &PatchJob) -> Result<Wound, RenderError> {
        if let Some(made) = self.made.as_ref().filter(|made| made.job == *job) {
            return Ok(Wound { made: made.clone(), bound: None });
        }
        let (made, bound) = passes.patch.prepare(&self.device, job)?;
        Ok(Wound { made, bound: Some(bound) })
    }

    /// Uploads what a cut needs.
    fn prepare(&mut self, passes: &Passes, painting: &Painting) -> Result<Cut, RenderError> {
        let wound = self.wound(passes, &painting.patch)?;
        let layout = lay_out(&painting.paint, self.maps.size());
        let blocks = blocks(&layout.tiles, self.maps.size());
        let rows = blocks.iter().map(Block::rows).max().unwrap_or(1);
        let (mask, target) = (self.mask()?, self.target(rows)?);
        let listed: Vec<_> = layout.triangles.iter().map(Triangle::from).collect();
        let triangles = &self.device.filled("triangles", &record::bytes(&listed), BufferUsages::STORAGE)?;
        let job = &PaintPass::job(&self.device, painting)?;
        let drawn = Drawn { layout: &layout, triangles, mask: &mask };
        let faults = Faults::none(&self.device)?;
        let texels = &wound.made.texels;
        let told = Told { job, triangles, wound: texels, placed: &target, faults: &faults };
        let blocks = blocks.into_iter().map(|block| self.upload(passes, block, &drawn, &told));
        Ok(Cut { blocks: blocks.collect::<Result<_, _>>()?, wound, target, faults })
    }

    /// Uploads what a block of a cut needs.
    fn upload(
        &self,
        passes: &Passes,
        block: Block,
        drawn: &Drawn<'_>,
        told: &Told<'_>,
    ) -> Result<Work, RenderError> {
        let placed = passes.place.prepare(&self.device, &block, drawn)?;
        let saved = Saved::new(&self.device, block)?;
        let painted = passes.paint.prepare(&self.device, &saved, told, &self.maps)?;
        Ok(Work { saved, placed, painted })
    }

    /// Asks for all of a cut.
    fn record(&self, encoder: &mut wgpu::CommandEncoder, passes: &Passes, cut: &Cut) {
        if let Some(bound) = &cut.wound.bound {
            passes.patch.record(encoder, &cut.wound.made, bound);
        }
        for Work { saved, placed, painted } in &cut.blocks {
            saved.save(encoder, &self.maps);
            passes.place.record(encoder, &saved.block, placed, &cut.target, self.maps.size());
            passes.paint.record(encoder, painted);
        }
    }
}

/// A patch, and what makes it if it is not there yet.
struct Wound {
    made: Made,
    bound: Option<wgpu::BindGroup>,
}

/// What a block of a cut is painted with.
struct Work {
    saved: Saved,
    placed: place::Prepared,
    painted: paint::Prepared,
}

/// A cut, ready to be recorded.
struct Cut {
    wound: Wound,
    blocks: Vec<Work>,
    target: wgpu::TextureView,
    faults: wgpu::Buffer,
}

/// The mask of the skin's texels, there and here: 1 where a face lies.
#[derive(Debug)]
struct Mask {
    texture: wgpu::Texture,
    covered: Vec<u8>,
}

/// A compute pipeline of the shader of this name.
fn compute_pipeline(device: &Device, name: &str) -> Result<wgpu::ComputePipeline, RenderError> {
    let shader = device.shader(name)?;
    device.guarded(name, || {
        device.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: None,
            module: &shader,
            entry_point: Some("compute"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    })
}

/// Binds what a pass works on.
fn bound<const N: usize>(
    device: &Device,
    name: &str,
    layout: &wgpu::BindGroupLayout,
    entries: [(u32, BindingResource<'_>); N],
) -> Result<wgpu::BindGroup, RenderError> {
    let entries = entries.map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource });
    device.guarded(name, || {
        device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(name),
            layout,
            entries: &entries,
        })
    })
}

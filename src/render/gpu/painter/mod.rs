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
mod passes;
mod patch;
mod place;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use wgpu::{BufferUsages, TextureFormat, TextureUsages};

use self::journal::{Block, Journal, Saved, Trace, blocks};
use self::maps::Pair;
use self::paint::{Faults, PaintPass, Told};
pub use self::passes::Passes;
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

/// How much of the device a painter may take.
#[derive(Clone, Copy, Debug)]
struct Room {
    /// Bytes that the journal may keep.
    journal: u64,
    /// Tiles that are painted at a time: this bounds the target that triangles are drawn into.
    tiles: usize,
}

/// A target of 16 MiB at most, and twice as much at a time for the journal.
const ROOM: Room = Room { journal: 64 << 20, tiles: 1024 };

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
    passes: Arc<Passes>,
    /// Where triangles are placed; it grows with what is painted.
    target: Option<wgpu::Texture>,
    /// The patch that was made last.
    made: Option<Made>,
    journal: Journal,
    room: Room,
}

impl Painter {
    /// A painter of a scene with nothing painted yet. Of the mesh only the faces' texture coordinates matter.
    pub fn new(device: Arc<Device>, maps: &Arc<Maps>, mesh: &Mesh) -> Result<Self, RenderError> {
        Self::sharing(device, &Arc::default(), maps, mesh)
    }

    /// The same, with passes that other painters on this device use too.
    pub fn sharing(
        device: Arc<Device>,
        passes: &Arc<Passes>,
        maps: &Arc<Maps>,
        mesh: &Mesh,
    ) -> Result<Self, RenderError> {
        Self::within(device, passes, maps, mesh, ROOM)
    }

    fn within(
        device: Arc<Device>,
        passes: &Arc<Passes>,
        maps: &Arc<Maps>,
        mesh: &Mesh,
        room: Room,
    ) -> Result<Self, RenderError> {
        Ok(Self {
            maps: Pair::new(&device, &maps.color)?,
            device,
            scene: maps.clone(),
            charts: Charts::of(mesh),
            mask: None,
            passes: passes.clone(),
            target: None,
            made: None,
            journal: Journal::new(room.journal),
            room,
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
        let pass = self.passes.patch(&self.device, &job.noise)?;
        let (made, bound) = pass.prepare(&self.device, job)?;
        self.device.submit("wound patch", |encoder| pass.record(encoder, &made, &bound))?;
        self.device.wait()?;
        self.made = Some(made);
        Ok(())
    }

    /// Carries a painting out over those before it, and waits for it.
    pub fn paint(&mut self, painting: &Arc<Painting>) -> Result<(), RenderError> {
        let cut = self.prepare(painting)?;
        self.device.submit("cut", |encoder| self.record(encoder, &cut))?;
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
    fn wound(&self, job: &PatchJob) -> Result<Wound, RenderError> {
        if let Some(made) = self.made.as_ref().filter(|made| made.job == *job) {
            return Ok(Wound { made: made.clone(), by: None });
        }
        let pass = self.passes.patch(&self.device, &job.noise)?;
        let (made, bound) = pass.prepare(&self.device, job)?;
        Ok(Wound { made, by: Some((pass, bound)) })
    }

    /// Uploads what a cut needs.
    fn prepare(&mut self, painting: &Painting) -> Result<Cut, RenderError> {
        let wound = self.wound(&painting.patch)?;
        let layout = lay_out(&painting.paint, self.maps.size());
        let blocks = blocks(&layout.tiles, self.maps.size(), self.room.tiles);
        let rows = blocks.iter().map(Block::rows).max().unwrap_or(1);
        let (mask, target) = (self.mask()?, self.target(rows)?);
        let device = &self.device;
        let listed: Vec<_> = layout.triangles.iter().map(Triangle::from).collect();
        let triangles = &device.filled("triangles", &record::bytes(&listed), BufferUsages::STORAGE)?;
        let (job, faults) = (&PaintPass::job(device, painting)?, Faults::none(device)?);
        let passes = (self.passes.place(device)?, self.passes.paint(device, &painting.paint.noise)?);
        let drawn = Drawn { layout: &layout, triangles, mask: &mask };
        let texels = &wound.made.texels;
        let told = Told { job, triangles, wound: texels, placed: &target, faults: &faults };
        let work = |block| {
            let placed = passes.0.prepare(device, &block, &drawn)?;
            let saved = Saved::new(device, block)?;
            let painted = passes.1.prepare(device, &saved, &told, &self.maps)?;
            Ok(Work { saved, placed, painted })
        };
        let blocks = blocks.into_iter().map(work).collect::<Result<_, _>>()?;
        Ok(Cut { wound, passes, blocks, target, faults })
    }

    /// Asks for all of a cut.
    fn record(&self, encoder: &mut wgpu::CommandEncoder, cut: &Cut) {
        if let Some((pass, bound)) = &cut.wound.by {
            pass.record(encoder, &cut.wound.made, bound);
        }
        let (place, paint) = &cut.passes;
        for Work { saved, placed, painted } in &cut.blocks {
            saved.save(encoder, &self.maps);
            place.record(encoder, &saved.block, placed, &cut.target, self.maps.size());
            paint.record(encoder, painted);
        }
    }
}

/// A patch, and what makes it if it is not there yet.
struct Wound {
    made: Made,
    by: Option<(Arc<PatchPass>, wgpu::BindGroup)>,
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
    passes: (Arc<PlacePass>, Arc<PaintPass>),
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

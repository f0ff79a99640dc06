//! GP's patch and PP's painting on the CPU, and the maps that follow the list of paintings.
//!
//! The two maps that are painted on are the scene's own until something is painted. Before each painting the tiles that it changes are
//! saved; taking it back puts them in place again. Where the journal's budget let them go, the maps begin anew from the
//! scene's, and the paintings are carried out again: the result is the same, since each depends on the maps before it alone.

mod journal;
mod noise;
mod paint;
mod patch;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use journal::{BUDGET, Journal};
use paint::Ground;
pub use patch::patch;

use super::super::inspect;
use super::super::mask::Charts;
use crate::canvas::image::{Image, Maps};
use crate::canvas::job::{Painting, PatchJob};
use crate::mesh::Mesh;
use crate::report::Check;

/// Paints on a scene's colour and discolour maps.
#[derive(Debug)]
pub struct Painter {
    maps: Arc<Maps>,
    /// What the mask is made of, until it is.
    charts: Charts,
    mask: Option<Vec<u8>>,
    /// `None` while it is the scene's own.
    color: Option<Image>,
    discolor: Image,
    /// The patch that was made last, and of what.
    patch: Option<(PatchJob, Image)>,
    /// What the maps are made of, oldest first.
    applied: Vec<Arc<Painting>>,
    journal: Journal,
}

impl Painter {
    /// A painter of a scene: its maps before any cut, and its mesh, of which only the faces' texture coordinates matter.
    pub fn new(maps: &Arc<Maps>, mesh: &Mesh) -> Self {
        Self::with_budget(maps, mesh, BUDGET)
    }

    fn with_budget(maps: &Arc<Maps>, mesh: &Mesh, budget: usize) -> Self {
        Self {
            maps: Arc::clone(maps),
            charts: Charts::of(mesh),
            mask: None,
            color: None,
            discolor: Image::filled(maps.color.size, [0; 4]),
            patch: None,
            applied: Vec::new(),
            journal: Journal::new(budget),
        }
    }

    /// The colour map as it is now.
    pub fn color(&self) -> &Image {
        self.color.as_ref().unwrap_or(&self.maps.color)
    }

    /// The discolour map as it is now.
    pub fn discolor(&self) -> &Image {
        &self.discolor
    }

    /// Makes the patch of a cut, which the next painting uses.
    pub fn patch(&mut self, job: &PatchJob) -> &Image {
        let made = self.patch.take().filter(|(made, _)| made == job);
        &self.patch.insert(made.unwrap_or_else(|| (job.clone(), patch::patch(job)))).1
    }

    /// Carries a painting out over those that were carried out before.
    pub fn paint(&mut self, painting: &Arc<Painting>) {
        self.patch(&painting.patch);
        let size = self.maps.color.size;
        let charts = &mut self.charts;
        let mask = self.mask.get_or_insert_with(|| std::mem::take(charts).covered(size));
        let color = self.color.get_or_insert_with(|| self.maps.color.clone());
        let ground = Ground { mask, color, discolor: &self.discolor };
        let patch = self.patch.as_ref().map(|(_, patch)| patch);
        let mut tiles = patch.map_or_else(Vec::new, |patch| paint::paint(painting, patch, ground));
        tiles.iter_mut().for_each(|tile| tile.swap(color, &mut self.discolor));
        self.journal.push(tiles);
        self.applied.push(Arc::clone(painting));
    }

    /// Makes the maps those of these paintings, in this order, whatever was painted before.
    pub fn follow(&mut self, paintings: &[Arc<Painting>]) {
        let same = |(a, b): &(&Arc<Painting>, &Arc<Painting>)| Arc::ptr_eq(a, b) || a == b;
        let common = self.applied.iter().zip(paintings).take_while(same).count();
        if self.applied.len() - common > self.journal.len() {
            self.begin_anew();
        }
        while self.applied.len() > common {
            self.take_back();
        }
        paintings[self.applied.len()..].iter().for_each(|painting| self.paint(painting));
    }

    /// Makes the maps the scene's own again.
    fn begin_anew(&mut self) {
        self.color = None;
        self.discolor.texels.fill([0; 4]);
        self.journal.clear();
        self.applied.clear();
    }

    /// Takes the last painting back.
    fn take_back(&mut self) {
        self.applied.pop();
        if let (Some(tiles), Some(color)) = (self.journal.pop(), &mut self.color) {
            tiles.into_iter().for_each(|mut tile| tile.swap(color, &mut self.discolor));
        }
    }

    /// GP's invariants, of the patch that was made last.
    pub fn check_patch(&self, job: &PatchJob) -> Vec<Check> {
        self.patch.as_ref().map_or_else(Vec::new, |(_, patch)| inspect::patch(job, patch))
    }

    /// PP's invariants, of the last painting.
    pub fn check_paint(&self) -> Vec<Check> {
        let (Some(painting), Some(tiles), Some(mask)) =
            (self.applied.last(), self.journal.last(), &self.mask)
        else {
            return Vec::new();
        };
        let size = self.maps.color.size;
        let differing = tiles.iter().flat_map(|tile| tile.differing(self.color(), &self.discolor));
        let changed: Vec<[u32; 2]> = differing.collect();
        let used = paint::used(&painting.paint, mask, size);
        vec![inspect::within(&painting.paint, size, mask, &changed), inspect::finite(used)]
    }
}

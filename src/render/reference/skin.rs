//! The skin pass: which surface is seen at each pixel, what it is made of, and what light leaves it.

use rayon::prelude::*;

use super::layers::{Layers, NOTHING, TILE, Tile};
use super::lighting::{Lighting, Parts};
use super::raster::Drawing;
use super::surface::{Facet, Materials};
use crate::mesh::Mesh;

/// Finds the surface that is nearest at each pixel.
pub(crate) fn visible(layers: &mut Layers, drawing: &Drawing, far: f64) {
    let (band, farthest) = (layers.band(), (1.0 / far) as f32);
    layers.visible.par_chunks_mut(band).enumerate().for_each(|(band, pixels)| {
        pixels.fill((NOTHING, farthest));
        drawing.draw(band, |at, triangle, inverse| {
            if inverse > pixels[at].1 {
                pixels[at] = (triangle, inverse);
            }
        });
    });
}

/// Shades what is seen.
pub(crate) struct Shading<'a> {
    /// What there is.
    pub(crate) mesh: &'a Mesh,
    /// What is seen of it.
    pub(crate) drawing: &'a Drawing,
    /// What it is made of.
    pub(crate) materials: &'a Materials<'a>,
    /// What falls on it.
    pub(crate) lighting: &'a Lighting<'a>,
    /// Tiles without surface are worked through too.
    pub(crate) everything: bool,
}

/// The rows of a band, of each layer.
struct Band<'a> {
    /// Its first row.
    top: usize,
    width: usize,
    visible: &'a [(u32, f32)],
    diffuse: &'a mut [[f32; 4]],
    specular: &'a mut [[f32; 3]],
    depth: &'a mut [f32],
    discolor: &'a mut [[f32; 4]],
}

impl Shading<'_> {
    /// Fills the layers, and says what is in each tile.
    pub(crate) fn run<P: Parts>(&self, layers: &mut Layers) {
        let (size, across, width) = (layers.band(), layers.tiles_across(), layers.size[0]);
        let Layers { visible, diffuse, specular, depth, discolor, tiles, .. } = layers;
        let bands = (
            visible.par_chunks(size),
            diffuse.par_chunks_mut(size),
            specular.par_chunks_mut(size),
            depth.par_chunks_mut(size),
            discolor.par_chunks_mut(size),
            tiles.par_chunks_mut(across),
        );
        bands.into_par_iter().enumerate().for_each(
            |(i, (visible, diffuse, specular, depth, discolor, tiles))| {
                let mut band = Band { top: i * TILE, width, visible, diffuse, specular, depth, discolor };
                tiles
                    .iter_mut()
                    .enumerate()
                    .for_each(|(i, tile)| *tile = self.tile::<P>(&mut band, i * TILE));
            },
        );
    }

    fn tile<P: Parts>(&self, band: &mut Band<'_>, left: usize) -> Tile {
        let (visible, width) = (band.visible, band.width);
        let columns = left..(left + TILE).min(width);
        let rows = || (0..visible.len() / width).map(|row| row * width);
        let mut seen = rows().flat_map(|row| &visible[row + columns.start..row + columns.end]);
        let mut tile = Tile { surface: seen.any(|(triangle, _)| *triangle != NOTHING), ..Tile::default() };
        if !tile.surface && !self.everything {
            rows().for_each(|row| band.clear(row + columns.start..row + columns.end));
            return tile;
        }
        let mut facet = None;
        for at in rows().flat_map(|row| columns.clone().map(move |x| row + x)) {
            match visible[at].0 {
                NOTHING => band.clear(at..at + 1),
                triangle => self.pixel::<P>(band, at, triangle, &mut facet, &mut tile),
            }
        }
        tile
    }

    /// Shades a pixel of a band. The facet is the last one's: often it is the same.
    fn pixel<P: Parts>(
        &self,
        band: &mut Band<'_>,
        at: usize,
        triangle: u32,
        facet: &mut Option<(u32, Facet)>,
        tile: &mut Tile,
    ) {
        if facet.as_ref().is_none_or(|(of, _)| *of != triangle) {
            *facet =
                Some((triangle, Facet::new(self.mesh, self.drawing.triangle(triangle), self.drawing.lens())));
        }
        let Some((_, facet)) = facet else { return };
        let point = facet.meet(self.drawing.lens().ray(at % band.width, band.top + at / band.width));
        let material = self.materials.at(facet, &point);
        let leaving = self.lighting.at::<P>(&point, &material);
        band.diffuse[at] = leaving.diffuse.extend(material.scattering).to_array();
        band.specular[at] = leaving.specular.to_array();
        band.depth[at] = 1.0 / band.visible[at].1;
        band.discolor[at] = material.discolor;
        tile.scatters |= material.scattering > 0.0;
        tile.discolored |= material.scattering > 0.0 && material.discolor[3] > 0.0;
    }
}

impl Band<'_> {
    fn clear(&mut self, pixels: std::ops::Range<usize>) {
        self.diffuse[pixels.clone()].fill([0.0; 4]);
        self.specular[pixels.clone()].fill([0.0; 3]);
        self.depth[pixels.clone()].fill(f32::INFINITY);
        self.discolor[pixels].fill([0.0; 4]);
    }
}

//! The texels that the skin covers: where a skirt must not paint.
//!
//! Cuts never change it: they split faces within their charts, and what they add lies in the gutter's own texture. So it is made
//! once for a scene, and not before something is painted: [`Charts`] keeps what is needed until then.

use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

use glam::Vec2;
use rayon::prelude::*;

use super::spans::{Corners, Window, each_copy, place, spans};
use crate::mesh::{Face, Mesh, Surface};

/// Faces that one task works through.
const BLOCK: usize = 4096;

/// The texture coordinates of a mesh's skin faces.
#[derive(Clone, Debug, Default)]
pub struct Charts(Vec<[Vec2; 3]>);

impl Charts {
    /// Those of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let textured = |face: &&Face| mesh.is_textured() && face.surface == Surface::Skin;
        let skin = mesh.faces().iter().filter(textured);
        Self(skin.map(|face| face.vertices.map(|v| mesh.vertex(v).uv)).collect())
    }

    /// 1 for every texel of a map whose centre a face covers, row by row; else 0.
    pub fn covered(&self, size: [u32; 2]) -> Vec<u8> {
        let [w, h] = size.map(|side| side as usize);
        let mask: Vec<AtomicU8> = (0..w * h).map(|_| AtomicU8::new(0)).collect();
        // Everybody writes the same, so it does not matter who is first.
        self.0.par_chunks(BLOCK).for_each(|faces| {
            for face in faces.iter().filter_map(|uv| place(*uv, size)) {
                each_copy(face, size, |face| mark(&mask, face, size));
            }
        });
        mask.into_iter().map(AtomicU8::into_inner).collect()
    }
}

/// Marks a face's texels.
#[inline]
fn mark(mask: &[AtomicU8], face: Corners, size: [u32; 2]) {
    spans(face, Window::whole(size), |row, columns| {
        let row = row as usize * size[0] as usize;
        let texels = &mask[row + columns.start as usize..row + columns.end as usize];
        texels.iter().for_each(|texel| texel.store(1, Relaxed));
    });
}

/// 1 for every texel of a map whose centre a skin face of a mesh covers, row by row; else 0.
pub fn covered(mesh: &Mesh, size: [u32; 2]) -> Vec<u8> {
    Charts::of(mesh).covered(size)
}

#[cfg(test)]
mod tests;

//! What is drawn over a frame or a map: edges, lines, points, sets of faces, charts, and whatever elements somebody has selected.
//!
//! | module | what it does |
//! | --- | --- |
//! | `scene` | where lines, points and faces lie in a view, and whether the surface hides them |
//! | `texture` | the same in texture space: [`draw_uv`] |
//! | `marked` | elements by their printed ids |
//! | `ink` | how much of a colour each pixel takes |
//! | `pick` | the way back: the face at a pixel, [`face_at`], or at texture coordinates, [`face_at_uv`] |
//!
//! Each drawing is collected as ink and laid over the picture at once, so that strokes that cross do not add up.

mod ink;
mod marked;
mod pick;
mod scene;
#[cfg(test)]
mod tests;
mod texture;

use ink::Ink;
use marked::Marked;
pub use marked::missing;
pub use pick::{face_at, face_at_uv};
use scene::Scene;
pub use texture::draw_uv;

use crate::canvas::frame::View;
use crate::canvas::image::Image;
use crate::mesh::Mesh;
use crate::report::Overlay;

/// Something to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drawing<'a> {
    /// The edges of the mesh.
    Wire,
    /// What a report has to show.
    Shown(&'a Overlay),
    /// Every face in its chart's colour.
    Charts,
    /// Elements by their printed ids, such as `f12`, `n3`, `e7`, `v9`. Those that there are not are left out. What is hidden is drawn too, but
    /// fainter, so that a selected element is always found.
    Marked(&'a [String]),
}

/// Colours for sets of faces, by their order, after the palette of Okabe and Ito, which colour-blind people can tell apart.
const FACES: [[u8; 3]; 8] = [
    [230, 159, 0],
    [86, 180, 233],
    [0, 158, 115],
    [240, 228, 66],
    [0, 114, 178],
    [213, 94, 0],
    [204, 121, 167],
    [200, 200, 200],
];
const LINE: [u8; 3] = [255, 235, 60];
const POINT: [u8; 3] = [255, 255, 255];
const WIRE: [u8; 3] = [30, 60, 90];
/// What is selected: no skin, no palette and no light comes near it.
const MARK: [u8; 3] = [255, 0, 220];

/// How much of its colour something takes, in 1/255.
mod share {
    pub(super) const FACE: u8 = 140;
    pub(super) const WIRE: u8 = 115;
    pub(super) const SEAM: u8 = 230;
    pub(super) const FULL: u8 = 255;
    pub(super) const HIDDEN_FACE: u8 = 55;
    pub(super) const HIDDEN_LINE: u8 = 120;
}

/// The colour of a set of faces: of those that are drawn over one picture, the first, the second, and so on.
pub fn face_colour(order: usize) -> [u8; 3] {
    FACES[order % FACES.len()]
}

/// Draws over a frame of a view of a mesh, in order.
pub fn draw(image: &mut Image, view: &View, mesh: &Mesh, drawings: &[Drawing<'_>]) {
    draw_supersampled(image, view, mesh, drawings, 1);
}

/// The same over a frame of which `factor` pixels, in both directions, will be shown as one: lines are as many pixels wide.
pub fn draw_supersampled(image: &mut Image, view: &View, mesh: &Mesh, drawings: &[Drawing<'_>], factor: u32) {
    if drawings.is_empty() || image.size != view.size {
        return;
    }
    let scene = Scene::new(view, mesh, factor);
    let mut colours = FACES.iter().cycle();
    for drawing in drawings {
        match drawing {
            Drawing::Wire => scene.wire().lay(image, WIRE),
            Drawing::Charts => scene.charts(image),
            Drawing::Marked(ids) => scene.marked(&Marked::of(mesh, ids)).lay(image, MARK),
            Drawing::Shown(Overlay::Faces { faces, .. }) => {
                scene.faces(faces).lay(image, *colours.next().unwrap_or(&LINE));
            }
            Drawing::Shown(Overlay::Line { points, .. }) => scene.polyline(points).lay(image, LINE),
            Drawing::Shown(Overlay::Points { points, .. }) => scene.points(points).lay(image, POINT),
        }
    }
}

/// Half the widths of strokes in pixels.
#[derive(Clone, Copy)]
struct Radii {
    line: i64,
    /// Of the lines of what is selected: a face of a few pixels has to be found too.
    mark: i64,
    point: i64,
}

impl Radii {
    fn new(factor: u32) -> Self {
        let factor = i64::from(factor.clamp(1, 16));
        Self { line: factor / 2, mark: factor / 2 + 1, point: factor + 2 }
    }
}

/// The pixels of a disc around one.
fn disc([x, y]: [i64; 2], radius: i64) -> impl Iterator<Item = [i64; 2]> {
    let across = move |dy: i64| (-radius..=radius).map(move |dx| [dx, dy]);
    let round =
        (-radius..=radius).flat_map(across).filter(move |[dx, dy]| dx * dx + dy * dy <= radius * radius);
    round.map(move |[dx, dy]| [x.saturating_add(dx), y.saturating_add(dy)])
}

/// The colour of each face's chart. Charts that touch differ, unless one touches more than there are colours.
fn chart_colours(mesh: &Mesh) -> Vec<[u8; 3]> {
    let charts = mesh.charts();
    let mut touching: Vec<[u32; 2]> = mesh
        .edges()
        .iter()
        .filter(|edge| mesh.is_seam(edge))
        .map(|edge| edge.faces.map(|face| charts[face.at()]))
        .filter(|[a, b]| a != b)
        .map(|[a, b]| [a.max(b), a.min(b)])
        .collect();
    touching.sort_unstable();
    touching.dedup();
    let (mut chosen, mut next, mut rank) = (vec![0_usize; charts.len()], touching.iter().peekable(), 0);
    for (face, &chart) in charts.iter().enumerate() {
        if chart as usize == face {
            let mut taken = [false; FACES.len()];
            while let Some([_, other]) = next.next_if(|pair| pair[0] == chart) {
                taken[chosen[*other as usize]] = true;
            }
            let free = (0..FACES.len()).map(|i| (rank + i) % FACES.len()).find(|colour| !taken[*colour]);
            chosen[face] = free.unwrap_or(rank % FACES.len());
            rank += 1;
        }
    }
    charts.iter().map(|chart| FACES[chosen[*chart as usize]]).collect()
}

//! Takes pictures of where a replay is, and draws over them what the screen wants to see.
//!
//! Rendering takes time, drawing hardly any. So the last picture is kept as it was before anything was drawn over it, until the state is another: a
//! selection, a tint or the edges come at once.

use std::sync::Arc;

use crate::canvas::frame::Orbit;
use crate::canvas::image::Image;
use crate::mesh::Mesh;
use crate::render::overlay::{self, Drawing};
use crate::replay::{self, Replay};
use crate::report::Overlay;
use crate::tui::image::window::{self, Window};
use crate::tui::shot::{Drawn, Shot, Sight, Subject, Tint};

/// See the module.
#[derive(Default)]
pub(super) struct Camera {
    kept: Option<(Aim, Bare)>,
}

/// What a picture without anything over it depends on, but for the state.
#[derive(Clone, Copy, PartialEq)]
struct Aim {
    subject: Subject,
    orbit: Option<Orbit>,
    limit: [u32; 2],
}

/// A picture without anything over it.
#[derive(Clone)]
struct Bare {
    image: Image,
    sight: Sight,
}

/// A picture as it was taken.
pub(super) struct Taken {
    pub(super) image: Arc<Image>,
    pub(super) sight: Sight,
    pub(super) legend: Vec<(String, [u8; 3])>,
}

impl Camera {
    /// The state is another.
    pub(super) fn forget(&mut self) {
        self.kept = None;
    }

    /// Takes a picture. An error says why there is none.
    pub(super) fn take(
        &mut self,
        replay: &mut dyn Replay,
        overlays: &[Overlay],
        shot: &Shot,
    ) -> Result<Taken, String> {
        let Bare { mut image, sight } = self.bare(replay, shot)?;
        let tinted = tinted(&shot.drawn.tint, overlays);
        let drawings = drawings(&shot.drawn, overlays, &tinted);
        match (sight, replay.mesh()) {
            (Sight::View(view), Some(mesh)) => {
                let reduction = Window::default().fit(image.size, shot.shown).reduction();
                overlay::draw_supersampled(&mut image, &view, mesh, &drawings, reduction);
            }
            (Sight::Map, Some(mesh)) => overlay::draw_uv(&mut image, mesh, &drawings),
            (_, None) => {}
        }
        let legend = tinted.iter().enumerate();
        let legend = legend.map(|(at, set)| (set.name().to_owned(), overlay::face_colour(at))).collect();
        Ok(Taken { image: Arc::new(image), sight, legend })
    }

    fn bare(&mut self, replay: &mut dyn Replay, shot: &Shot) -> Result<Bare, String> {
        let aim = Aim { subject: shot.subject, orbit: shot.orbit, limit: shot.limit };
        if let Some((_, bare)) = self.kept.as_ref().filter(|(kept, _)| *kept == aim) {
            return Ok(bare.clone());
        }
        let bare = render(replay, aim).ok_or_else(|| missing(replay))?;
        self.kept = Some((aim, bare.clone()));
        Ok(bare)
    }
}

fn render(replay: &mut dyn Replay, Aim { subject, orbit, limit }: Aim) -> Option<Bare> {
    match subject {
        Subject::Map(map) => Some(Bare { image: reduced(replay.map(map)?, limit), sight: Sight::Map }),
        Subject::Frame => {
            let (frame, view) = replay.shoot(&replay::Shot { orbit, limit: Some(limit) })?;
            Some(Bare { image: frame.image, sight: Sight::View(view) })
        }
    }
}

fn missing(replay: &dyn Replay) -> String {
    replay.failure().map_or("this engine has no picture of it".into(), ToString::to_string)
}

/// A map as large as it is shown, if it is larger: then what is drawn over it is not lost when it is reduced.
fn reduced(map: Image, limit: [u32; 2]) -> Image {
    let over = |k: usize| f64::from(map.size[k]) / f64::from(limit[k].max(1));
    let reduction = over(0).max(over(1));
    if reduction <= 1.0 {
        return map;
    }
    let size = map.size.map(|side| (f64::from(side) / reduction).round().max(1.0) as u32);
    window::crop(&map, &Window::default(), size)
}

/// The face that is seen at shares of a picture's width and height.
pub(super) fn face_at(mesh: &Mesh, sight: &Sight, share: [f64; 2]) -> Option<String> {
    let face = match sight {
        Sight::View(view) => overlay::face_at(view, mesh, [0, 1].map(|k| share[k] * f64::from(view.size[k]))),
        Sight::Map => overlay::face_at_uv(mesh, [share[0], 1.0 - share[1]]),
    };
    face.map(|face| face.to_string())
}

/// The sets of a group. A face that is in several is coloured as in the last of them alone, so that colours do not mix.
fn tinted(tint: &Tint, overlays: &[Overlay]) -> Vec<Overlay> {
    let Tint::Group(group) = tint else { return Vec::new() };
    let mut taken = rustc_hash::FxHashSet::default();
    let mut sets = Vec::new();
    for overlay in overlays.iter().rev().filter(|overlay| overlay.group() == group) {
        if let Overlay::Faces { name, faces } = overlay {
            let faces: Vec<u32> = faces.iter().copied().filter(|face| taken.insert(*face)).collect();
            sets.push(Overlay::Faces { name: name.clone(), faces });
        }
    }
    sets.reverse();
    sets.retain(|set| !set.is_empty());
    sets
}

fn drawings<'a>(drawn: &'a Drawn, overlays: &'a [Overlay], tinted: &'a [Overlay]) -> Vec<Drawing<'a>> {
    let mut drawings: Vec<Drawing<'a>> = tinted.iter().map(Drawing::Shown).collect();
    if drawn.tint == Tint::Charts {
        drawings.push(Drawing::Charts);
    }
    if drawn.wire {
        drawings.push(Drawing::Wire);
    }
    if drawn.lines {
        let lines = overlays.iter().filter(|overlay| !matches!(overlay, Overlay::Faces { .. }));
        drawings.extend(lines.map(Drawing::Shown));
    }
    if !drawn.marked.is_empty() {
        drawings.push(Drawing::Marked(&drawn.marked));
    }
    drawings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faces(name: &str, faces: &[u32]) -> Overlay {
        Overlay::Faces { name: name.into(), faces: faces.into() }
    }

    #[test]
    fn a_face_has_one_colour_and_a_set_that_has_none_is_no_set() {
        let line = Overlay::Line { name: "kind".into(), points: vec![[0.0; 3]] };
        let overlays = [
            faces("kind A", &[1, 2, 3]),
            line,
            faces("kind B", &[4]),
            faces("kind C", &[2, 4]),
            faces("rim", &[1]),
        ];
        let sets = tinted(&Tint::Group("kind".into()), &overlays);
        assert_eq!(sets, [faces("kind A", &[1, 3]), faces("kind C", &[2, 4])]);
        assert!(tinted(&Tint::Charts, &overlays).is_empty());
    }

    #[test]
    fn a_map_is_reduced_in_its_own_shape_and_never_enlarged() {
        let map = Image::filled([200, 100], [7, 7, 7, 255]);
        assert_eq!(reduced(map.clone(), [50, 80]).size, [50, 25]);
        assert_eq!(reduced(map.clone(), [400, 10]).size, [20, 10]);
        assert_eq!(reduced(map.clone(), [400, 400]).size, [200, 100]);
        assert_eq!(reduced(map, [0, 0]).size, [1, 1]);
    }
}

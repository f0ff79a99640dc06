//! Where a patch lies on the skin, against exact geodesics, in millimetres (Lam 2016, §5.3.2).
//!
//! PP lays the patch in coordinates (s, d): along the line, and away from it. Ours are measured on the surface, face by face outward from the line; the
//! thesis's in the texture. On a cylinder the exact ones are those of the unrolled sheet. On a sphere the line is a part of a great circle: d is
//! the arc to it, and s the arc along it to the foot.
//!
//! **Error.** At every corner of a painted face whose foot lies on the line, and that is within c_h of it: how far (s, d) is from the exact
//! place, as a distance on the unrolled plane. The root of the mean square, and the largest.
//!
//! On a chart that is isometric the texture's distances are the surface's, up to the digits of a texture coordinate. A chart that is stretched, and every chart of a
//! sphere, shows what is lost.

use glam::DVec2;

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::opening::faces_text;
use super::shapes::{LENGTH_CM, Shape};
use super::turns::{Task, in_turns};
use crate::canvas::look::Distance;
use crate::engine::Engine;
use crate::engine::wound::paint::{Corner, Painted};
use crate::engine::wound::{Edit, Mode, State, Work, Wound, WoundEvent};
use crate::measure::{MeasureError, drive};
use crate::mesh::Mesh;

/// Faces of the meshes, those of a quick run first.
const FACES: [usize; 6] = [500, 2_000, 8_000, 32_000, 128_000, 512_000];
/// How many of them a quick run takes.
const QUICK: usize = 4;
const SHAPES: [Shape; 3] = [Shape::Cylinder, Shape::StretchedCylinder, Shape::Sphere];
const DISTANCES: [(Distance, &str); 2] = [(Distance::Surface, "surface"), (Distance::Texture, "texture")];
/// Millimetres in a centimetre.
const MM: f64 = 10.0;

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    Ok(vec![measure(ask.of(&FACES, QUICK), ask.rounds)?])
}

/// A painting that is made again and again.
struct Laid {
    shape: Shape,
    setting: String,
    state: State,
    event: WoundEvent,
    errors: Errors,
}

/// How far a painting is from where it should be, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Errors {
    rms: f64,
    largest: f64,
}

fn measure(faces: &[usize], rounds: usize) -> Result<Curve, MeasureError> {
    let mut all = Vec::new();
    for shape in SHAPES {
        for (distance, name) in DISTANCES {
            for &faces in faces {
                all.push(Laid::new(shape, distance, name, faces)?);
            }
        }
    }
    let heads: Vec<(Shape, String, Errors)> =
        all.iter().map(|one| (one.shape, one.setting.clone(), one.errors)).collect();
    let mut tasks: Vec<Task<'_>> =
        all.iter_mut().map(|one| Box::new(|| one.paint_us()) as Task<'_>).collect();
    let timings = in_turns(rounds, &mut tasks)?;
    let row = |((shape, setting, errors), timing): ((Shape, String, Errors), _)| {
        Row::new(shape.name(), setting, timing, Some(errors.rms), vec![errors.largest])
    };
    Ok(Curve {
        name: "painting".into(),
        title: "Where a patch lies, by distance and resolution of the mesh".into(),
        time_of: "PP".into(),
        error: Measure::new("RMS distance from the exact place", "mm"),
        others: vec![Measure::new("largest", "mm")],
        rows: heads.into_iter().zip(timings).map(row).collect(),
        planted: planted(),
    }
    .with_front())
}

impl Laid {
    fn new(shape: Shape, distance: Distance, name: &str, faces: usize) -> Result<Self, MeasureError> {
        let mut state = State::new(shape.mesh(faces)?, shape.scene(distance));
        state.control.mode = Mode::Patch;
        let (event, faces) = (shape.cut(&state), state.mesh.face_count());
        let (painted, _, edit) = paint(&mut state, &event)?;
        let errors = Errors::of(samples(shape, &state.mesh, &painted));
        Wound::revert(&mut state, &edit);
        Ok(Self { shape, setting: format!("{name} {}", faces_text(faces)), state, event, errors })
    }

    /// Microseconds of PP.
    fn paint_us(&mut self) -> Result<f64, MeasureError> {
        let (_, us, edit) = paint(&mut self.state, &self.event)?;
        Wound::revert(&mut self.state, &edit);
        Ok(us)
    }
}

fn paint(state: &mut State, event: &WoundEvent) -> Result<(Painted, f64, Edit), MeasureError> {
    let ran = drive::run(state, event, false);
    let us = ran.us("PP");
    let painted = match ran.work {
        Some(Work::Cut(cut)) => cut.painted,
        _ => None,
    };
    match (painted, ran.patch, ran.rejection) {
        (Some(painted), Some(edit), _) => Ok((painted, us, edit)),
        (.., why) => Err(MeasureError::Rejected(why.map_or("nothing is painted".into(), |why| why.detail))),
    }
}

/// What PP says of the corners that are nodes, and what is true of them.
fn samples<'a>(shape: Shape, mesh: &'a Mesh, painted: &'a Painted) -> impl Iterator<Item = [DVec2; 2]> + 'a {
    let reach = f64::from(painted.painting.paint.height);
    let faces = painted.painting.paint.faces.iter().zip(&painted.corners);
    let corners = faces.flat_map(|(face, corners)| face.at.into_iter().zip(*corners));
    let both = corners.filter_map(move |(at, corner)| match corner {
        Corner::Node(node) => Some([at.as_dvec2(), shape.exact(mesh.position(node))]),
        Corner::Point(_) => None,
    });
    both.filter(move |[_, exact]| (0.0..=LENGTH_CM).contains(&exact.x) && exact.y.abs() <= reach)
}

impl Errors {
    fn of(samples: impl Iterator<Item = [DVec2; 2]>) -> Self {
        let (mut count, mut sum, mut largest) = (0.0, 0.0, 0.0_f64);
        for off in samples.map(|[laid, exact]| laid.distance(exact) * MM) {
            count += 1.0;
            sum += off * off;
            largest = largest.max(off);
        }
        Self { rms: (sum / count).sqrt(), largest }
    }
}

/// Exact places on the cylinder, moved by a quarter of a millimetre away from the line.
fn planted() -> Planted {
    let value = 0.25;
    let place = |i: usize| DVec2::new(0.04 * i as f64, 0.1);
    let moved = (0..100).map(|i| [place(i) + DVec2::new(0.0, value / MM), place(i)]);
    Planted { what: "all moved by 0.25 mm".into(), value, measured: Errors::of(moved).rms }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planted_error_is_measured_as_such() {
        let planted = planted();
        assert!((planted.measured - planted.value).abs() < 1e-12);
    }

    #[test]
    fn the_surface_is_nearer_than_a_texture_that_is_stretched() {
        let curve = measure(&[2_000, 8_000], 1).expect("they are painted");
        let rms = |series: &str, setting: &str| {
            let row = curve.rows.iter().find(|r| r.series == series && r.setting.starts_with(setting));
            row.and_then(|row| row.error).expect("a row")
        };
        let stretched = Shape::StretchedCylinder.name();
        assert!(rms("cylinder", "surface 2.0 k") < 0.1);
        assert!(rms(stretched, "surface 8") < 0.02 * rms(stretched, "texture 8"));
        assert!(curve.rows.iter().all(|row| row.error.is_some_and(f64::is_finite)));
    }
}

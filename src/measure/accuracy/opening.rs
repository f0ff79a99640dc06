//! How wide an incision is and what room it takes, against the closed form (Lam 2016, §4.3.1).
//!
//! **Truth.** On the smooth surface the line has the length L, and the thesis says all the rest: depth d(L), opening COD(L), and the width
//! w(s) = COD · 4 s (L − s)/L². A cross-section is a triangle, w(s) wide and d deep; where the surface bends along the line with the radius R, what lies z
//! below it is shorter by 1 − z/R. So the room of the incision is
//!
//! ```text
//! V = ∫∫ w(s) (1 − z/d)(1 − z/R) dz ds = COD · ⅔ L · d (½ − d/6R)
//! ```
//!
//! **Error.** Along the line, by shares of its arc length, the largest difference of the carved width (straight between the nodes, as the rims are) from
//! the closed form; of the volume between the gutter and the rims the difference as a share. Both come of the mesh alone: chords are shorter than
//! arcs, and a parabola has corners.

use glam::DVec3;

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::shapes::{LENGTH_CM, Shape};
use super::turns::{Task, in_turns};
use crate::canvas::look::Distance;
use crate::engine::Engine;
use crate::engine::wound::carve::Carved;
use crate::engine::wound::carve::opening::{cod_cm, depth_cm};
use crate::engine::wound::{Edit, State, Work, Wound, WoundEvent};
use crate::measure::{MeasureError, drive};
use crate::mesh::Mesh;
use crate::mesh::check::sixfold_volume;

/// Faces of the meshes, those of a quick run first.
const FACES: [usize; 7] = [500, 2_000, 8_000, 32_000, 128_000, 512_000, 2_000_000];
/// How many of them a quick run takes.
const QUICK: usize = 5;
const SHAPES: [Shape; 2] = [Shape::Plate, Shape::Sphere];
/// Places along the line at which widths are compared.
const PLACES: usize = 1000;
/// Micrometres in a centimetre.
const UM: f64 = 1e4;

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    measure(ask.of(&FACES, QUICK), ask.rounds)
}

/// An incision that is made again and again.
struct Incised {
    shape: Shape,
    state: State,
    event: WoundEvent,
    faces: usize,
    errors: Errors,
}

/// How far an incision is from the closed form.
#[derive(Clone, Copy, Debug)]
struct Errors {
    /// The width's largest difference, µm.
    width: f64,
    /// The same in the middle.
    middle: f64,
    /// The volume's difference, a share.
    volume: f64,
}

fn measure(faces: &[usize], rounds: usize) -> Result<Vec<Curve>, MeasureError> {
    let settings = SHAPES.iter().flat_map(|shape| faces.iter().map(move |faces| (*shape, *faces)));
    let mut all = settings.map(|(shape, faces)| Incised::new(shape, faces)).collect::<Result<Vec<_>, _>>()?;
    let heads: Vec<(Shape, String, Errors)> =
        all.iter().map(|one| (one.shape, faces_text(one.faces), one.errors)).collect();
    let mut tasks: Vec<Task<'_>> =
        all.iter_mut().map(|one| Box::new(|| one.carve_us()) as Task<'_>).collect();
    let timings = in_turns(rounds, &mut tasks)?;
    let rows = |error: fn(&Errors) -> (f64, Vec<f64>)| {
        let row = |((shape, setting, errors), timing): (&(Shape, String, Errors), _)| {
            let (error, others) = error(errors);
            Row::new(shape.name(), setting.clone(), timing, Some(error), others)
        };
        heads.iter().zip(timings.iter().copied()).map(row).collect::<Vec<Row>>()
    };
    Ok(vec![
        Curve {
            name: "opening-width".into(),
            title: "How wide an incision of 4 cm is, by resolution of the mesh".into(),
            time_of: "CI".into(),
            error: Measure::new("largest difference of the width along the line", "µm"),
            others: vec![Measure::new("difference in the middle", "µm")],
            rows: rows(|errors| (errors.width, vec![errors.middle])),
            planted: planted_width(),
        }
        .with_front(),
        Curve {
            name: "opening-volume".into(),
            title: "What room an incision of 4 cm takes, by resolution of the mesh".into(),
            time_of: "CI".into(),
            error: Measure::new("difference of the volume", "%"),
            others: Vec::new(),
            rows: rows(|errors| (100.0 * errors.volume, Vec::new())),
            planted: planted_volume(),
        }
        .with_front(),
    ])
}

/// A number of faces, short.
pub(super) fn faces_text(faces: usize) -> String {
    match faces {
        0..1_000 => faces.to_string(),
        1_000..10_000 => format!("{:.1} k", faces as f64 / 1e3),
        10_000..1_000_000 => format!("{:.0} k", faces as f64 / 1e3),
        _ => format!("{:.1} M", faces as f64 / 1e6),
    }
}

impl Incised {
    fn new(shape: Shape, faces: usize) -> Result<Self, MeasureError> {
        let mut state = State::new(shape.mesh(faces)?, shape.scene(Distance::Surface));
        state.mesh_and_bvh();
        let (event, faces) = (shape.cut(&state), state.mesh.face_count());
        let (carved, _, edit) = carve(&mut state, &event)?;
        let errors = Errors::of(shape, &state.mesh, &carved);
        Wound::revert(&mut state, &edit);
        Ok(Self { shape, state, event, faces, errors })
    }

    /// Microseconds of CI.
    fn carve_us(&mut self) -> Result<f64, MeasureError> {
        let (_, us, edit) = carve(&mut self.state, &self.event)?;
        Wound::revert(&mut self.state, &edit);
        Ok(us)
    }
}

/// Makes the cut: what was carved, the microseconds of it, and what to revert.
fn carve(state: &mut State, event: &WoundEvent) -> Result<(Carved, f64, Edit), MeasureError> {
    let ran = drive::run(state, event, false);
    let us = ran.us("CI");
    match (ran.work, ran.patch, ran.rejection) {
        (Some(Work::Cut(cut)), Some(edit), _) => Ok((cut.carved, us, edit)),
        (.., why) => Err(MeasureError::Rejected(why.map_or("the cut is rejected".into(), |why| why.detail))),
    }
}

impl Errors {
    fn of(shape: Shape, mesh: &Mesh, carved: &Carved) -> Self {
        let apart = |a, b| mesh.position(a).distance(mesh.position(b));
        let ends = [(0.0, 0.0), (1.0, 0.0)];
        let opened = carved.opened.iter().map(|o| (o.s / carved.length, apart(o.left, o.right)));
        // Beyond what is opened the line is closed.
        let profile: Vec<(f64, f64)> = [ends[0]].into_iter().chain(opened).chain([ends[1]]).collect();
        let (width, middle) = width_error(&profile);
        let volume = cavity(mesh, carved) / volume(shape.curvature()) - 1.0;
        Self { width, middle, volume: volume.abs() }
    }
}

/// The width in the middle, cm.
fn cod() -> f64 {
    cod_cm(LENGTH_CM, depth_cm(LENGTH_CM))
}

/// V, cm³, where the surface has a curvature along the line, 1/cm.
fn volume(curvature: f64) -> f64 {
    let depth = depth_cm(LENGTH_CM);
    cod() * LENGTH_CM * (2.0 / 3.0) * depth * (0.5 - depth * curvature / 6.0)
}

/// The largest difference of a width, given at shares of the line and straight between them, from the closed form; and the one in the middle; µm.
fn width_error(profile: &[(f64, f64)]) -> (f64, f64) {
    let off = |share: f64| (width_at(profile, share) - cod() * 4.0 * share * (1.0 - share)).abs() * UM;
    let largest = (0..=PLACES).map(|i| off(i as f64 / PLACES as f64)).fold(0.0, f64::max);
    (largest, off(0.5))
}

fn width_at(profile: &[(f64, f64)], share: f64) -> f64 {
    let after = profile.partition_point(|place| place.0 < share).clamp(1, profile.len() - 1);
    let ((from, a), (to, b)) = (profile[after - 1], profile[after]);
    let part = if to > from { ((share - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
    a + (b - a) * part
}

/// The volume between the gutter and the rims, cm³.
fn cavity(mesh: &Mesh, carved: &Carved) -> f64 {
    let at = |n| mesh.position(n);
    // Seen from within the cavity the gutter's faces turn the other way.
    let walls = carved.gutter.iter().map(|f| mesh.triangle(*f)).map(|[a, b, c]| [a, c, b]);
    let caps = carved.opened.windows(2).flat_map(|pair| {
        let [l0, r0, l1, r1] = [pair[0].left, pair[0].right, pair[1].left, pair[1].right].map(at);
        [[l0, r0, r1], [l0, r1, l1]]
    });
    enclosed(walls.chain(caps))
}

/// The volume that triangles enclose.
fn enclosed(triangles: impl Iterator<Item = [DVec3; 3]>) -> f64 {
    let mut triangles = triangles.peekable();
    let origin = triangles.peek().map_or(DVec3::ZERO, |t| t[0]);
    triangles.map(|t| sixfold_volume(origin, t)).sum::<f64>().abs() / 6.0
}

/// A profile of the closed form, with ten micrometres more in the middle and less towards the ends.
fn planted_width() -> Planted {
    let value = 10.0;
    let share = |i: usize| i as f64 / PLACES as f64;
    let wide = |x: f64| (cod() + value / UM) * 4.0 * x * (1.0 - x);
    let profile: Vec<(f64, f64)> = (0..=PLACES).map(|i| (share(i), wide(share(i)))).collect();
    Planted { what: "10 µm wider in the middle".into(), value, measured: width_error(&profile).0 }
}

/// A straight incision of the closed form, two per cent deeper.
fn planted_volume() -> Planted {
    let value = 2.0;
    let depth = depth_cm(LENGTH_CM) * (1.0 + value / 100.0);
    let section = |i: usize| {
        let share = i as f64 / PLACES as f64;
        let (x, half) = (share * LENGTH_CM, 0.5 * cod() * 4.0 * share * (1.0 - share));
        [DVec3::new(x, half, 0.0), DVec3::new(x, -half, 0.0), DVec3::new(x, 0.0, -depth)]
    };
    let between = |i: usize| {
        let ([l, r, b], [l1, r1, b1]) = (section(i), section(i + 1));
        [[l, r, r1], [l, r1, l1], [r, b, b1], [r, b1, r1], [b, l, l1], [b, l1, b1]]
    };
    let found = enclosed((0..PLACES).flat_map(between));
    let measured = 100.0 * (found / volume(0.0) - 1.0).abs();
    Planted { what: "a straight one, 2 % deeper".into(), value, measured }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planted_errors_are_measured_as_such() {
        assert!((planted_width().measured - 10.0).abs() < 0.01);
        assert!((planted_volume().measured - 2.0).abs() < 0.01);
    }

    #[test]
    fn a_finer_mesh_is_nearer_to_the_closed_form() {
        let curves = measure(&[2_000, 32_000], 1).expect("they are carved");
        for curve in &curves {
            assert!(curve.is_trusted());
            for rows in curve.rows.chunks(2) {
                let [coarse, fine] = [0, 1].map(|i| rows[i].error.expect("an error"));
                assert!(fine < 0.5 * coarse, "{} {}: {coarse} {fine}", curve.name, rows[0].series);
            }
        }
    }
}

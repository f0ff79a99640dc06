//! Picks: the hierarchy with exact signs, and every face tried with rounded arithmetic, against rational arithmetic (Lam 2016, §4.1.1).
//!
//! **Truth.** The face is the first of all by exact signs ([`first_face`]), without any hierarchy, and FC's own oracle confirms that the ray meets it between
//! its sides ([`exact`](crate::measure::exact)). The point is where the ray meets its plane, as a fraction. No pick has a say in it.
//!
//! **Error.** The root of the mean square of the distance of a pick's point from the exact one, in nanometres, over the picks that met the right
//! face; the largest; and how many of a million met another face or none. The thesis tries every face (Möller and Trumbore 1997), which costs the
//! more the larger the mesh is.

use glam::DVec3;

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::opening::faces_text;
use super::turns::{Task, in_turns, timed};
use crate::assets::builtin::builtin;
use crate::engine::wound::chain::At;
use crate::engine::wound::{Pick, State, pick};
use crate::measure::baseline::Scalar;
use crate::measure::exact::{Datum, ExactPoint, Question, Section, first_face};
use crate::measure::scaling::default_scene;
use crate::measure::{MeasureError, Random};
use crate::mesh::{FaceId, Mesh};

/// Faces of the bust, those of a quick run first.
const FACES: [usize; 3] = [8_000, 32_000, 128_000];
const QUICK: usize = 2;
/// Picks, and of a quick run.
const PICKS: usize = 200;
const QUICK_PICKS: usize = 40;
/// Where they go: the face, pixels of the usual view.
const FACE: [[f64; 2]; 2] = [[560.0, 720.0], [200.0, 480.0]];
/// Nanometres in a centimetre.
const NM: f64 = 1e7;

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    let picks = if ask.quick { QUICK_PICKS } else { PICKS };
    Ok(vec![measure(ask.of(&FACES, QUICK), picks, ask.rounds)?])
}

/// A pick, and what is exactly true of it.
struct Ray {
    pixel: [f64; 2],
    through: DVec3,
    face: FaceId,
    point: ExactPoint,
}

/// A ray's first face, and where it is met.
type Met = Option<(FaceId, DVec3)>;

/// A way to meet the surface.
type Way<'a> = Box<dyn FnMut(&Ray) -> Met + Send + 'a>;

/// How far picks are from where they should be.
#[derive(Clone, Copy, Debug)]
struct Errors {
    rms: f64,
    largest: f64,
    /// A million picks.
    wrong: f64,
}

fn measure(faces: &[usize], picks: usize, rounds: usize) -> Result<Curve, MeasureError> {
    let (mut rows, mut planted) = (Vec::new(), None);
    for &faces in faces {
        let mesh = Mesh::build(&builtin(&format!("bust:{faces}"))?.mesh)?;
        let series = format!("bust, {} faces", faces_text(mesh.face_count()));
        let mut state = State::new(mesh, default_scene());
        let rays = rays(&state, picks);
        planted = planted.or_else(|| rays.first().map(planted_in));
        rows.extend(of_mesh(&series, &mut state, &rays, rounds)?);
    }
    Ok(Curve {
        name: "picks".into(),
        title: "Where a pick is, by the way the surface is met".into(),
        time_of: "a pick".into(),
        error: Measure::new("RMS distance from the exact point", "nm"),
        others: vec![Measure::new("largest", "nm"), Measure::new("another face or none", "a million")],
        rows,
        planted: planted.ok_or_else(|| MeasureError::NoCut("picks".into()))?,
    }
    .with_front())
}

/// Rays into the inside of faces, with their exact points; two make one question for the oracle.
fn rays(state: &State, count: usize) -> Vec<Ray> {
    let mut random = Random::of(0, 0, "rays");
    let eye = state.control.camera.eye();
    let mut rays = Vec::with_capacity(count);
    for _ in 0..2 * count {
        let pixels = [0, 1].map(|_| FACE.map(|[low, high]| random.within(low, high)));
        let [Some(a), Some(b)] = pixels.map(|pixel| aimed(state, pixel)) else { continue };
        // A section has one place in a face.
        if a.at == b.at {
            continue;
        }
        let Ok(section) = Section::of(&state.mesh, &Question { eye, picks: [a, b] }) else { continue };
        rays.extend(
            [(pixels[0], a), (pixels[1], b)]
                .into_iter()
                .filter_map(|(pixel, datum)| Ray::new(pixel, datum, &section)),
        );
        if rays.len() >= count {
            break;
        }
    }
    rays.truncate(count);
    rays
}

/// What is true of a pixel: the ray, and the face that it meets first.
fn aimed(state: &State, pixel: [f64; 2]) -> Option<Datum> {
    let camera = state.control.camera;
    let through = camera.through(pixel)?;
    let face = first_face(&state.mesh, camera.eye(), through).0?;
    Some(Datum { through, at: At::Face(face) })
}

impl Ray {
    fn new(pixel: [f64; 2], datum: Datum, section: &Section<'_>) -> Option<Self> {
        let At::Face(face) = datum.at else { return None };
        Some(Self { pixel, through: datum.through, face, point: section.point(datum.at)? })
    }
}

fn of_mesh(series: &str, state: &mut State, rays: &[Ray], rounds: usize) -> Result<Vec<Row>, MeasureError> {
    let (eye, mesh) = (state.control.camera.eye(), state.mesh.clone());
    let ways: [(&str, Way<'_>); 3] = [
        ("every face, f32", Box::new(|ray| every_face::<f32>(&mesh, eye, ray.through))),
        ("every face, f64", Box::new(|ray| every_face::<f64>(&mesh, eye, ray.through))),
        ("hierarchy, exact signs", Box::new(|ray| by_hierarchy(state, ray))),
    ];
    let (mut names, mut errors, mut tasks) = (Vec::new(), Vec::new(), Vec::new());
    for (name, mut way) in ways {
        names.push(name);
        errors.push(Errors::of(rays, &mut way));
        let all =
            move || timed(|| rays.iter().filter(|ray| way(ray).is_some()).count()).1 / rays.len() as f64;
        let mut all = all;
        tasks.push(Box::new(move || Ok(all())) as Task<'_>);
    }
    let timings = in_turns(rounds, &mut tasks)?;
    let rows = names.into_iter().zip(timings).zip(errors);
    Ok(rows
        .map(|((name, timing), Errors { rms, largest, wrong })| {
            Row::new(series, name, timing, rms.is_finite().then_some(rms), vec![largest, wrong])
        })
        .collect())
}

fn by_hierarchy(state: &mut State, ray: &Ray) -> Met {
    let picked = pick::resolve(state, Pick::Pixel(ray.pixel)).ok()?;
    match picked.point.at {
        At::Face(face) => Some((face, picked.point.position)),
        _ => None,
    }
}

/// The nearest of all faces, by rounded arithmetic (Möller and Trumbore 1997).
fn every_face<S: Scalar>(mesh: &Mesh, eye: DVec3, through: DVec3) -> Met {
    let (from, to) = (vector::<S>(eye), vector::<S>(through));
    let way = minus(to, from);
    let mut nearest: Option<(S, FaceId)> = None;
    for face in (0..mesh.face_count()).map(FaceId::of) {
        let corners = mesh.triangle(face).map(vector::<S>);
        if let Some(t) = meets(from, way, corners).filter(|t| nearest.is_none_or(|best| *t < best.0)) {
            nearest = Some((t, face));
        }
    }
    let (t, face) = nearest?;
    Some((face, DVec3::from([0, 1, 2].map(|k| (from[k] + way[k] * t).wide()))))
}

/// Where along a ray a triangle is met.
fn meets<S: Scalar>(from: [S; 3], way: [S; 3], [a, b, c]: [[S; 3]; 3]) -> Option<S> {
    let (zero, one) = (S::of(0.0), S::of(1.0));
    let (ab, ac, off) = (minus(b, a), minus(c, a), minus(from, a));
    let (p, q) = (cross(way, ac), cross(off, ab));
    let det = dot(ab, p);
    if det == zero {
        return None;
    }
    let (u, v, t) = (dot(off, p) / det, dot(way, q) / det, dot(ac, q) / det);
    (u >= zero && v >= zero && u + v <= one && t > zero).then_some(t)
}

fn vector<S: Scalar>(p: DVec3) -> [S; 3] {
    p.to_array().map(S::of)
}

fn minus<S: Scalar>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross<S: Scalar>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot<S: Scalar>(a: [S; 3], b: [S; 3]) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Errors {
    fn of(rays: &[Ray], way: &mut dyn FnMut(&Ray) -> Met) -> Self {
        let (mut sum, mut right, mut largest) = (0.0, 0_u32, 0.0_f64);
        for ray in rays {
            if let Some((_, position)) = way(ray).filter(|(face, _)| *face == ray.face) {
                let off = ray.point.distance(position) * NM;
                sum += off * off;
                right += 1;
                largest = largest.max(off);
            }
        }
        let wrong = 1e6 * (rays.len() as f64 - f64::from(right)) / rays.len().max(1) as f64;
        Self { rms: (sum / f64::from(right)).sqrt(), largest, wrong }
    }
}

/// An exact point, moved by a micrometre.
fn planted_in(ray: &Ray) -> Planted {
    let value = 1000.0;
    let moved = ray.point.rounded() + DVec3::new(0.0, 0.6, 0.8) * (value / NM);
    let measured = Errors::of(std::slice::from_ref(ray), &mut |ray| Some((ray.face, moved))).rms;
    Planted { what: "a pick moved by 1 µm".into(), value, measured }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hierarchy_meets_the_right_face_and_is_nearest() {
        let curve = measure(&[3_000], 10, 1).expect("there are picks");
        assert!(curve.is_trusted(), "{:?}", curve.planted);
        let error = |i: usize| curve.rows[i].error.expect("some are right");
        assert!(error(2) <= error(1) && error(1) < 1e-3 * error(0));
        assert_eq!(curve.rows[2].others[1], 0.0);
    }

    /// Of the bust, and of the same a long way off.
    fn meshes() -> [Mesh; 2] {
        let mut indexed = builtin("bust:3000").expect("a scene").mesh;
        let here = Mesh::build(&indexed).expect("a mesh");
        indexed.positions.iter_mut().for_each(|p| *p += DVec3::splat(1e3));
        [here, Mesh::build(&indexed).expect("a mesh")]
    }

    #[test]
    fn another_face_is_counted_whatever_point_it_comes_with() {
        let [mesh, _] = meshes();
        let rays = rays(&State::new(mesh, default_scene()), 10);
        assert_eq!(rays.len(), 10);
        let mut picks = 0;
        let errors = Errors::of(&rays, &mut |ray| {
            picks += 1;
            let face = if picks % 2 == 0 { ray.face } else { FaceId(ray.face.0 ^ 1) };
            Some((face, ray.point.rounded()))
        });
        assert_eq!(errors.wrong, 5e5);
    }

    #[test]
    fn a_hierarchy_that_leads_nowhere_has_no_say_in_what_is_true() {
        let [here, away] = meshes();
        let mut state = State::new(here.clone(), default_scene());
        // Made of the one mesh, and asked about the other.
        state.mesh = away;
        state.mesh_and_bvh();
        state.mesh = here;
        let rays = rays(&state, 10);
        assert_eq!(rays.len(), 10);
        let errors = Errors::of(&rays, &mut |ray| by_hierarchy(&mut state, ray));
        assert_eq!(errors.wrong, 1e6);
    }
}

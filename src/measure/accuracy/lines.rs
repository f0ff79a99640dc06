//! FC by rounded arithmetic with an ε, in f32 and in f64, and by exact signs, against rational arithmetic (Lam 2016, §4.1.2 and §4.2).
//!
//! The same cuts for all: at random over the bust, and on the grid between nodes, where planes go through other nodes and along edges. Only cuts of
//! which rational arithmetic says that there is a line ([`exact`](crate::measure::exact)) count.
//!
//! **Error.** The root of the mean square of the distance of the line's points from where plane and element meet exactly, in nanometres, over the
//! lines that are right. **Failures**, a million cuts: a line that does not arrive, or along which the mesh cannot be divided; and, apart from these,
//! one that passes through other elements than the exact one. Where all of these
//! are as near to the plane as ε lets pass (four ulps of exact signs), the line is counted as moved, and is no failure: that is what an ε is for.
//!
//! An ε too small misses what coincides, one too large takes for one what is two: each arithmetic is tried with several. What a cut cannot be made of
//! by exact signs is a rejection with a reason, and counts as a failure here.

use glam::DVec3;

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::turns::{Task, Timing, in_turns, timed};
use crate::assets::builtin::builtin;
use crate::engine::wound::chain::At;
use crate::engine::wound::pick::{self, Picked};
use crate::engine::wound::plane::CutPlane;
use crate::engine::wound::{Pick, State, settle};
use crate::geometry::ulp;
use crate::measure::baseline::{self, BaselineChain, Failure, Scalar};
use crate::measure::exact::{Line, Question, Section};
use crate::measure::scaling::default_scene;
use crate::measure::{MeasureError, Random};
use crate::mesh::{Mesh, NodeId};

/// Cuts of a scene, and of a quick run.
const CUTS: usize = 1000;
const QUICK: usize = 150;
/// ε as shares of the mesh's diagonal.
const EPSILONS_32: [f64; 3] = [1e-7, 1e-6, 1e-5];
const EPSILONS_64: [f64; 3] = [1e-15, 1e-12, 1e-9];
/// Nanometres in a centimetre.
const NM: f64 = 1e7;
/// Where random cuts of the bust begin and end, pixels of the usual view.
const FACE: [[f64; 2]; 2] = [[540.0, 740.0], [180.0, 500.0]];

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    measure(if ask.quick { QUICK } else { CUTS }, ask.rounds)
}

/// Where a line's points are said to be.
type Places = Vec<(At, DVec3)>;
/// A way to form a line.
type Form = Box<dyn Fn(&Mesh, DVec3, &[Picked; 2]) -> Result<Places, Failure> + Sync>;

/// The same, by name, and how near to each other two elements may be to count as one.
struct Former {
    name: String,
    epsilon: f64,
    form: Form,
}

/// A cut that has a line.
struct Posed<'a> {
    picks: [Picked; 2],
    section: Section<'a>,
    line: Line,
}

/// What the lines of a former are like.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    rms: f64,
    largest: f64,
    /// A million.
    lost: f64,
    wrong: f64,
    moved: f64,
}

fn measure(cuts: usize, rounds: usize) -> Result<Vec<Curve>, MeasureError> {
    let mut rows = Vec::new();
    let mut planted = None;
    for (name, scene, coincident) in
        [("bust, at random", "bust", false), ("grid, through nodes", "grid", true)]
    {
        let mut state = State::new(Mesh::build(&builtin(scene)?.mesh)?, default_scene());
        let eye = state.control.camera.eye();
        let picks = questions(&mut state, cuts, coincident);
        let mesh = &state.mesh;
        let posed: Vec<Posed<'_>> =
            picks.into_iter().filter_map(|picks| Posed::new(mesh, eye, picks)).collect();
        rows.extend(of_scene(name, mesh, eye, &posed, rounds)?);
        planted = planted.or_else(|| Some((planted_distance(posed.first()?), planted_failures(&posed))));
    }
    let (distance, failures) = planted.ok_or_else(|| MeasureError::NoCut("lines".into()))?;
    let row = |row: &(String, String, Timing, Errors), error: Option<f64>, others: Vec<f64>| {
        Row::new(&row.0, row.1.clone(), row.2, error, others)
    };
    let right = |r: &(String, String, Timing, Errors)| r.3.rms.is_finite().then_some(r.3.rms);
    let fails = |r: &(String, String, Timing, Errors)| r.3.lost + r.3.wrong;
    Ok(vec![
        Curve {
            name: "lines-distance".into(),
            title: "Where the points of a cutting line are, by the arithmetic of FC".into(),
            time_of: "FC, a cut".into(),
            error: Measure::new("RMS distance from the exact point", "nm"),
            others: vec![Measure::new("largest", "nm")],
            rows: rows.iter().map(|r| row(r, right(r), vec![r.3.largest])).collect(),
            planted: distance,
        }
        .with_front(),
        Curve {
            name: "lines-failures".into(),
            title: "Cutting lines that fail, by the arithmetic of FC".into(),
            time_of: "FC, a cut".into(),
            error: Measure::new("failures", "a million cuts"),
            others: vec![
                Measure::new("no line, or no mesh", "a million"),
                Measure::new("another line", "a million"),
                Measure::new("moved within ε, or a detour", "a million"),
            ],
            rows: rows.iter().map(|r| row(r, Some(fails(r)), vec![r.3.lost, r.3.wrong, r.3.moved])).collect(),
            planted: failures,
        }
        .with_front(),
    ])
}

/// The picks of some cuts.
fn questions(state: &mut State, cuts: usize, coincident: bool) -> Vec<[Picked; 2]> {
    let mut random = Random::of(0, 0, "lines");
    let nodes = state.mesh.node_count();
    let mut all = Vec::with_capacity(cuts);
    for _ in 0..4 * cuts {
        let mut one = || match coincident {
            true => Pick::Node(NodeId::of(random.below(nodes))),
            false => Pick::Pixel(FACE.map(|[low, high]| random.within(low, high))),
        };
        let [from, to] = [one(), one()];
        if let (Ok(a), Ok(b)) = (pick::resolve(state, from), pick::resolve(state, to)) {
            all.push([a, b]);
        }
        if all.len() == cuts {
            break;
        }
    }
    all
}

impl<'a> Posed<'a> {
    /// None where there is no line, exactly.
    fn new(mesh: &'a Mesh, eye: DVec3, picks: [Picked; 2]) -> Option<Self> {
        let section = Section::of(mesh, &Question::of(eye, &picks)).ok()?;
        let line = section.line().ok()?;
        Some(Self { picks, section, line })
    }

    /// In which way a line is not the exact one.
    fn judge(&self, places: &Places, epsilon: f64) -> Result<(), Failure> {
        let chain = BaselineChain { places: places.clone(), faces: Vec::new() };
        baseline::judge(&self.section, &self.line, &chain, epsilon)
    }

    /// The exact places, rounded once.
    fn places(&self) -> Places {
        self.line.places.iter().map(|place| (place.at, place.point.rounded())).collect()
    }
}

fn of_scene(
    name: &str,
    mesh: &Mesh,
    eye: DVec3,
    posed: &[Posed<'_>],
    rounds: usize,
) -> Result<Vec<(String, String, Timing, Errors)>, MeasureError> {
    let formers = formers(mesh);
    let mut tasks: Vec<Task<'_>> = formers.iter().map(|former| former.task(mesh, eye, posed)).collect();
    let timings = in_turns(rounds, &mut tasks)?;
    let rows = formers.iter().zip(timings).map(|(former, timing)| {
        let errors = Errors::of(posed, former.epsilon, |_, cut| (former.form)(mesh, eye, &cut.picks));
        (name.to_owned(), former.name.clone(), timing, errors)
    });
    Ok(rows.collect())
}

impl Former {
    /// Forms all lines, and says how many microseconds one takes.
    fn task<'a>(&'a self, mesh: &'a Mesh, eye: DVec3, posed: &'a [Posed<'_>]) -> Task<'a> {
        let all = move || posed.iter().filter(|cut| (self.form)(mesh, eye, &cut.picks).is_ok()).count();
        Box::new(move || Ok(timed(all).1 / posed.len().max(1) as f64))
    }
}

/// The ways to form a line.
fn formers(mesh: &Mesh) -> Vec<Former> {
    let f32s = EPSILONS_32.map(|share| rounded::<f32>("f32", mesh, share));
    let f64s = EPSILONS_64.map(|share| rounded::<f64>("f64", mesh, share));
    let epsilon = settle::SNAP_ULPS * ulp(mesh.largest_coordinate());
    let exact = Former { name: "exact signs".into(), epsilon, form: Box::new(by_signs) };
    f32s.into_iter().chain(f64s).chain([exact]).collect()
}

fn rounded<S: Scalar + 'static>(name: &str, mesh: &Mesh, share: f64) -> Former {
    let epsilon = baseline::epsilon(mesh, share);
    let form: Form =
        Box::new(move |mesh, eye, picks| Ok(baseline::cut::<S>(mesh, eye, picks, epsilon)?.places));
    Former { name: format!("{name}, ε {share:e}"), epsilon, form }
}

/// FC as it is.
fn by_signs(mesh: &Mesh, eye: DVec3, picks: &[Picked; 2]) -> Result<Places, Failure> {
    let plane = CutPlane::through([eye, picks[0].through, picks[1].through]);
    let formed =
        plane.and_then(|mut plane| settle::form(mesh, &mut plane, *picks, mesh.largest_coordinate()).ok());
    let chain = formed.ok_or(Failure::DoesNotArrive)?.chain;
    Ok(chain.points.iter().map(|point| (point.at, point.position)).collect())
}

impl Errors {
    fn of(
        posed: &[Posed<'_>],
        epsilon: f64,
        form: impl Fn(usize, &Posed<'_>) -> Result<Places, Failure>,
    ) -> Self {
        let (mut sum, mut points, mut largest) = (0.0, 0.0, 0.0_f64);
        let (mut lost, mut wrong, mut moved) = (0, 0, 0);
        for (i, cut) in posed.iter().enumerate() {
            let formed = form(i, cut).and_then(|places| cut.judge(&places, epsilon).map(|()| places));
            let places = match formed {
                Ok(places) => places,
                Err(failure) => {
                    lost += u32::from(failure.is_lost());
                    wrong += u32::from(failure == Failure::WrongConstruct);
                    moved += u32::from(matches!(failure, Failure::Moved | Failure::Detour));
                    continue;
                }
            };
            for distance in distances(&cut.section, &places) {
                sum += distance * distance;
                points += 1.0;
                largest = largest.max(distance);
            }
        }
        let million = |count: u32| 1e6 * f64::from(count) / posed.len().max(1) as f64;
        let [lost, wrong, moved] = [lost, wrong, moved].map(million);
        Self { rms: (sum / points).sqrt(), largest, lost, wrong, moved }
    }
}

/// How far points are from where they are exactly, nm.
fn distances<'a>(section: &'a Section<'_>, places: &'a Places) -> impl Iterator<Item = f64> + 'a {
    places.iter().filter_map(|(at, position)| Some(section.point(*at)?.distance(*position) * NM))
}

/// The exact points of a line, moved by a micrometre.
fn planted_distance(cut: &Posed<'_>) -> Planted {
    let value = 1000.0;
    let off = DVec3::new(0.6, 0.0, 0.8) * (value / NM);
    let moved: Places = cut.places().into_iter().map(|(at, position)| (at, position + off)).collect();
    let (count, sum) = distances(&cut.section, &moved).fold((0.0, 0.0), |(n, s), d| (n + 1.0, s + d * d));
    Planted { what: "a line moved by 1 µm".into(), value, measured: f64::sqrt(sum / count) }
}

/// Exact lines, of which one in four is lost, and of another one in four the last point is left out.
fn planted_failures(posed: &[Posed<'_>]) -> Planted {
    let form = |i: usize, cut: &Posed<'_>| match i % 4 {
        0 => Err(Failure::DoesNotArrive),
        1 => Ok(cut.places().into_iter().rev().skip(1).rev().collect()),
        _ => Ok(cut.places()),
    };
    let failing = (0..posed.len()).filter(|i| i % 4 < 2).count();
    let errors = Errors::of(posed, 0.0, form);
    Planted {
        what: "every second line broken".into(),
        value: 1e6 * failing as f64 / posed.len().max(1) as f64,
        measured: errors.lost + errors.wrong,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_signs_fail_nowhere_and_are_nearest() {
        let curves = measure(40, 1).expect("there are lines");
        assert!(curves.iter().all(Curve::is_trusted), "{curves:?}");
        let [distance, failures] = curves.as_slice() else { panic!("two curves") };
        for rows in failures.rows.chunks(7) {
            assert_eq!(rows[6].error, Some(0.0), "{}", rows[6].series);
        }
        for rows in distance.rows.chunks(7) {
            let error = |i: usize| rows[i].error.unwrap_or(f64::INFINITY);
            assert!(error(6) < 1e-3 * error(1), "{}: {} {}", rows[0].series, error(6), error(1));
        }
    }
}

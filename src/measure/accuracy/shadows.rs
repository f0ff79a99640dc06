//! Percentage-closer filtering against the light that it stands for (Lam 2016, B.1.2.2).
//!
//! A ball hangs over a floor, below a lamp. **The lamp that a filter stands for.** A filter of k looks blurs over k texels of the map, each e = 2 z
//! tan half/size wide at the depth z of the floor; a square lamp of side a, facing the floor, blurs over a (z − z_b)/z_b behind a ball at the depth
//! z_b. So it stands for a lamp of side
//!
//! ```text
//! a = k e z_b/(z − z_b).
//! ```
//!
//! One lamp, that of `LOOKS` looks into a map of `SIZE`, is what all settings are compared with: a larger map needs more looks for the same lamp, and
//! a hard shadow stands for none.
//!
//! **Truth.** Rays from each place of the floor to many places of the lamp, the ball being met by its equation, not by its mesh. **Error.** The root
//! of the mean square of the difference over the places, in per cent of the lamp's light; and the largest. The filter blurs by the same width
//! everywhere, a lamp the more the farther away the ball is. A third distance is that over the places which the whole lamp shines on: what a wide
//! filter takes for shadow there is the floor itself.

use glam::DVec3;

use super::Ask;
use super::curve::{Curve, Measure, Planted, Row};
use super::turns::{Task, in_turns, timed};
use crate::assets::builtin::builtin;
use crate::canvas::frame::{Light, place_lights};
use crate::canvas::look::{Look, Spotlight};
use crate::measure::MeasureError;
use crate::mesh::{IndexedMesh, Mesh};
use crate::render::reference::alone::Shadows;

/// Looks along a side of the filter and texels along a side of the map that stand for the lamp.
const LOOKS: u32 = 5;
const SIZE: u32 = 512;
/// Texels along a side of the maps, and looks; those of a quick run first.
const SIZES: [u32; 4] = [256, 512, 1024, 2048];
const FILTERS: [u32; 5] = [1, 3, 5, 7, 9];
const QUICK: usize = 3;
/// The ball: its middle is so high above the floor, and its radius.
const HEIGHT: f64 = 2.0;
const RADIUS: f64 = 1.0;
/// Half the floor's side.
const FLOOR: f64 = 4.0;
/// Faces of the ball in the map.
const FACES: usize = 20_000;
/// Places of the floor along a side, and of the lamp.
const PLACES: usize = 96;
const RAYS: usize = 24;

/// Measures it.
pub fn run(ask: &Ask<'_>) -> Result<Vec<Curve>, MeasureError> {
    Ok(vec![measure(ask.of(&SIZES, QUICK), PLACES, ask.rounds)?])
}

fn measure(sizes: &[u32], places: usize, rounds: usize) -> Result<Curve, MeasureError> {
    let scene = Scene::new(places)?;
    let truth = scene.truth();
    let settings: Vec<[u32; 2]> = sizes.iter().flat_map(|s| FILTERS.map(|f| [*s, f])).collect();
    let errors: Vec<[f64; 3]> =
        settings.iter().map(|setting| errors(&scene.filtered(*setting), &truth)).collect();
    let task = |setting: [u32; 2]| -> Task<'_> {
        let scene = &scene;
        Box::new(move || Ok(timed(|| scene.filtered(setting)).1))
    };
    let mut tasks: Vec<Task<'_>> = settings.iter().map(|setting| task(*setting)).collect();
    let timings = in_turns(rounds, &mut tasks)?;
    let rows =
        settings.iter().zip(timings).zip(&errors).map(|(([size, filter], timing), [rms, others @ ..])| {
            let setting = format!("{size}, {filter} x {filter}");
            Row::new("ball over a floor", setting, timing, Some(*rms), others.to_vec())
        });
    Ok(Curve {
        name: "shadows".into(),
        title: "Shadows by size of the map and of the filter, against a lamp".into(),
        time_of: format!("drawing the map and {} looks", scene.floor.len()),
        error: Measure::new("RMS difference of what arrives", "% of the lamp's light"),
        others: vec![Measure::new("largest", "%"), Measure::new("RMS in full light", "%")],
        rows: rows.collect(),
        planted: planted(),
    }
    .with_front())
}

/// The ball, the floor, and the light.
struct Scene {
    mesh: Mesh,
    light: Light,
    /// Places of the floor that the shadow may fall on.
    floor: Vec<DVec3>,
}

impl Scene {
    fn new(places: usize) -> Result<Self, MeasureError> {
        let mesh = Mesh::build(&ball_over_floor(&builtin(&format!("sphere:{FACES}"))?.mesh))?;
        let lamp =
            Spotlight { azimuth: 0.6, zenith: 0.5, target: Some([0.0, 1.0, 0.0]), ..Spotlight::default() };
        let [low, high] = mesh.bounds();
        let look = Look { lights: Some(vec![lamp]), ..Look::default() };
        let light = place_lights(&look, (low + high) * 0.5, (high - low).length() * 0.5).into_iter().next();
        let light = light.ok_or_else(|| MeasureError::Rejected("the scene has no light".into()))?;
        let at = |i: usize| (2.0 * (i as f64 + 0.5) / places as f64 - 1.0) * 0.9 * FLOOR;
        let floor = (0..places * places).map(|k| DVec3::new(at(k % places), 0.0, at(k / places))).collect();
        Ok(Self { mesh, light, floor })
    }

    /// What arrives by a map of a size and a filter.
    fn filtered(&self, [size, filter]: [u32; 2]) -> Vec<f64> {
        let shadows = Shadows::draw(&self.mesh, &self.light, size);
        self.floor.iter().map(|place| f64::from(shadows.lit(*place, DVec3::Y, filter))).collect()
    }

    /// What arrives from the lamp.
    fn truth(&self) -> Vec<f64> {
        let side = self.lamp();
        let at = |i: usize| side * ((i as f64 + 0.5) / RAYS as f64 - 0.5);
        let [right, up, _] = self.light.basis;
        let lamp: Vec<DVec3> = (0..RAYS * RAYS)
            .map(|k| self.light.position + right * at(k % RAYS) + up * at(k / RAYS))
            .collect();
        let part = |place: &DVec3| {
            lamp.iter().filter(|from| !hidden(*place, **from)).count() as f64 / lamp.len() as f64
        };
        self.floor.iter().map(part).collect()
    }

    /// Side of the lamp that the filter stands for.
    fn lamp(&self) -> f64 {
        let ball = middle();
        let depth = |point: DVec3| (point - self.light.position).dot(self.light.basis[2]);
        let way = (ball - self.light.position).normalize();
        // Where the ray through the ball's middle meets the floor.
        let foot = ball - way * (ball.y / way.y);
        let (z, z_ball) = (depth(foot), depth(ball));
        let texel = 2.0 * z * self.light.tan_half / f64::from(SIZE);
        f64::from(LOOKS) * texel * z_ball / (z - z_ball)
    }
}

fn middle() -> DVec3 {
    DVec3::new(0.0, HEIGHT, 0.0)
}

/// Whether the ball lies between two points.
fn hidden(from: DVec3, to: DVec3) -> bool {
    let (way, off) = (to - from, middle() - from);
    let t = (off.dot(way) / way.length_squared()).clamp(0.0, 1.0);
    (off - way * t).length_squared() < RADIUS * RADIUS
}

fn ball_over_floor(sphere: &IndexedMesh) -> IndexedMesh {
    // The built-in sphere's first node tells its radius.
    let radius = sphere.positions.first().map_or(1.0, |p| p.length());
    let mut mesh = IndexedMesh { faces: sphere.faces.clone(), ..IndexedMesh::default() };
    mesh.positions = sphere.positions.iter().map(|p| *p * (RADIUS / radius) + middle()).collect();
    let first = mesh.positions.len() as u32;
    let corners = [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
    mesh.positions.extend(corners.map(|[x, z]| DVec3::new(x * FLOOR, 0.0, z * FLOOR)));
    mesh.faces.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    mesh
}

/// RMS and largest difference, per cent.
fn apart(found: &[f64], truth: &[f64]) -> [f64; 2] {
    let off = found.iter().zip(truth).map(|(a, b)| 100.0 * (a - b).abs());
    let (sum, largest) = off.fold((0.0, 0.0_f64), |(sum, most), off| (sum + off * off, most.max(off)));
    [(sum / found.len() as f64).sqrt(), largest]
}

/// RMS and largest difference, and RMS where the whole lamp is seen, per cent.
fn errors(found: &[f64], truth: &[f64]) -> [f64; 3] {
    let lit: (Vec<f64>, Vec<f64>) = found.iter().zip(truth).filter(|(_, t)| **t == 1.0).unzip();
    let ([rms, largest], [in_light, _]) = (apart(found, truth), apart(&lit.0, &lit.1));
    [rms, largest, in_light]
}

/// What arrives, and the same with a tenth less of it.
fn planted() -> Planted {
    let value = 10.0;
    let truth: Vec<f64> = (0..100).map(|i| 0.1 + 0.009 * f64::from(i)).collect();
    let less: Vec<f64> = truth.iter().map(|v| v - value / 100.0).collect();
    Planted { what: "10 % less everywhere".into(), value, measured: apart(&less, &truth)[0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planted_error_is_measured_as_such() {
        assert!((planted().measured - 10.0).abs() < 1e-9);
    }

    #[test]
    fn the_lamps_own_filter_is_nearer_than_a_hard_shadow() {
        let curve = measure(&[SIZE], 32, 1).expect("it is drawn");
        let error = |filter: u32| {
            let setting = format!("{SIZE}, {filter} x {filter}");
            curve.rows.iter().find(|row| row.setting == setting).and_then(|row| row.error).expect("a row")
        };
        assert!(error(LOOKS) < 0.6 * error(1), "{} {}", error(LOOKS), error(1));
        assert!(error(LOOKS) < error(9));
    }

    #[test]
    fn the_lamp_is_seen_but_behind_the_ball() {
        let scene = Scene::new(24).expect("a scene");
        let truth = scene.truth();
        assert!(truth.contains(&0.0) && truth.contains(&1.0));
        assert!(truth.iter().any(|v| *v > 0.0 && *v < 1.0));
    }
}

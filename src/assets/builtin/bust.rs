//! The bust: a head on its neck, closed at the base, in nine charts.
//!
//! The start is a cage of a few hundred faces around the solid of `sculpt`: a tube of 24 columns (the face, two sides and the back
//! above; the neck below) with a disc on top and one under the neck; `ear` folds a block of two by two cells on either side.
//! A node of the cage is a ray from inside the head; its place is where the ray leaves the solid. Bisection halves rays, so every
//! number of faces samples one and the same surface, finer on the face and coarser on the skull.

use glam::{DVec3, dvec3};

use super::bisect::{Surface, refine};
use super::cage;
use super::ear;
use super::sculpt::head;
use crate::mesh::IndexedMesh;

/// Where a node of the bust lies.
#[derive(Clone, Copy, Debug)]
pub(super) enum Site {
    /// Where a ray from inside leaves the head.
    Skin { origin: DVec3, direction: DVec3, reach: f64 },
    /// A place on the ear of a side.
    Ear { side: f64, s: f64, t: f64, reach: f64 },
}

impl Site {
    /// A place on the skin whose distance is not known yet.
    pub(super) fn skin(origin: DVec3, direction: DVec3) -> Self {
        Self::Skin { origin, direction: direction.normalize(), reach: 0.0 }
    }

    /// The ray and where along it the head's surface is, about.
    pub(super) fn ray(&self) -> (DVec3, DVec3, f64) {
        match *self {
            Self::Skin { origin, direction, reach } => (origin, direction, reach),
            Self::Ear { side, s, t, reach } => (DVec3::ZERO, ear::direction(side, s, t).normalize(), reach),
        }
    }

    /// Where its ray leaves the head: where it lies, but for the folds of an ear.
    pub(super) fn on_head(&self) -> DVec3 {
        let (origin, direction, guess) = self.ray();
        origin + direction * leave(origin, direction, guess)
    }
}

/// The bust at about this many faces.
pub(super) fn bust(faces: usize) -> IndexedMesh {
    refine(&Bust, cage::cage(), faces)
}

struct Bust;

impl Surface for Bust {
    type Site = Site;

    fn between(&self, a: &Site, b: &Site) -> Site {
        if let (&Site::Ear { side, s, t, reach }, &Site::Ear { side: other, s: s2, t: t2, reach: r2 }) =
            (a, b)
            && side == other
        {
            return Site::Ear { side, s: 0.5 * (s + s2), t: 0.5 * (t + t2), reach: 0.5 * (reach + r2) };
        }
        let ((o1, d1, r1), (o2, d2, r2)) = (a.ray(), b.ray());
        Site::Skin { origin: (o1 + o2) * 0.5, direction: (d1 + d2).normalize(), reach: 0.5 * (r1 + r2) }
    }

    fn position(&self, site: &mut Site) -> DVec3 {
        let (origin, direction, guess) = site.ray();
        let found = leave(origin, direction, guess);
        let p = origin + direction * found;
        match site {
            Site::Skin { reach, .. } => {
                *reach = found;
                p
            }
            Site::Ear { side, s, t, reach } => {
                *reach = found;
                p + ear::fold(*side, *s, *t)
            }
        }
    }

    fn edge_length(&self, p: DVec3) -> f64 {
        let p = dvec3(p.x.abs(), p.y, p.z);
        let face = grade(p.distance(dvec3(0.0, -2.5, 8.5)), (8.5, 0.36), (15.0, 1.5));
        let eye = grade(p.distance(dvec3(3.1, 0.7, 7.8)), (1.7, 0.21), (4.0, 0.5));
        let nose = grade(p.distance(dvec3(0.0, -2.6, 9.6)), (1.6, 0.28), (4.0, 0.5));
        let mouth = grade(p.distance(dvec3(0.0, -5.6, 8.6)), (2.2, 0.23), (4.0, 0.5));
        let ear = grade(p.distance(dvec3(8.0, -0.5, -1.5)), (3.2, 0.28), (6.0, 1.6));
        face.min(eye).min(nose).min(mouth).min(ear)
    }
}

/// Goes linearly from one (distance, edge length) to another.
fn grade(distance: f64, near: (f64, f64), far: (f64, f64)) -> f64 {
    let t = ((distance - near.0) / (far.0 - near.0)).clamp(0.0, 1.0);
    near.1 + (far.1 - near.1) * t
}

/// Where a ray from inside leaves the head: regula falsi (Illinois) in a bracket that is widened from the guess.
fn leave(origin: DVec3, direction: DVec3, guess: f64) -> f64 {
    let solid = |r: f64| head(origin + direction * r);
    let (mut inside, mut outside) = bracket(&solid, guess);
    let mut last_was_outside = None;
    for _ in 0..60 {
        let r = (inside.0 * outside.1 - outside.0 * inside.1) / (outside.1 - inside.1);
        let value = solid(r);
        if value.abs() < 1e-10 {
            return r;
        }
        let is_outside = value > 0.0;
        let again = last_was_outside.replace(is_outside) == Some(is_outside);
        let (moved, kept) =
            if is_outside { (&mut outside, &mut inside) } else { (&mut inside, &mut outside) };
        *moved = (r, value);
        kept.1 *= if again { 0.5 } else { 1.0 };
    }
    inside.0
}

/// Two points of the ray, the first inside and the second outside, with the solid's values there.
fn bracket(solid: &impl Fn(f64) -> f64, guess: f64) -> ((f64, f64), (f64, f64)) {
    let at = |r: f64| (r, solid(r));
    let mut inside = at(guess);
    let mut step = 0.02 + inside.1.abs();
    while inside.1 >= 0.0 && inside.0 > 0.0 {
        inside = at((inside.0 - step).max(0.0));
    }
    let mut outside = at(inside.0 + step);
    while outside.1 < 0.0 {
        inside = outside;
        step = 0.02 + 0.8 * inside.1.abs();
        outside = at(inside.0 + step);
    }
    (inside, outside)
}

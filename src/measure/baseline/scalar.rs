//! What the baseline computes with, and vectors of it.

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

/// f32 or f64.
pub trait Scalar:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The nearest.
    fn of(value: f64) -> Self;
    /// The same number.
    fn wide(self) -> f64;
    /// Square root.
    fn root(self) -> Self;
}

impl Scalar for f32 {
    fn of(value: f64) -> Self {
        value as Self
    }

    fn wide(self) -> f64 {
        f64::from(self)
    }

    fn root(self) -> Self {
        self.sqrt()
    }
}

impl Scalar for f64 {
    fn of(value: f64) -> Self {
        value
    }

    fn wide(self) -> f64 {
        self
    }

    fn root(self) -> Self {
        self.sqrt()
    }
}

/// A point or a direction.
pub(super) type Vector<S> = [S; 3];

pub(super) fn vector<S: Scalar>(p: DVec3) -> Vector<S> {
    p.to_array().map(S::of)
}

pub(super) fn wide<S: Scalar>(a: Vector<S>) -> DVec3 {
    DVec3::from(a.map(S::wide))
}

pub(super) fn sub<S: Scalar>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot<S: Scalar>(a: Vector<S>, b: Vector<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross<S: Scalar>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a + (b − a) t.
pub(super) fn along<S: Scalar>(a: Vector<S>, b: Vector<S>, t: S) -> Vector<S> {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * t)
}

pub(super) fn length<S: Scalar>(a: Vector<S>) -> S {
    dot(a, a).root()
}

pub(super) fn distance<S: Scalar>(a: Vector<S>, b: Vector<S>) -> S {
    length(sub(a, b))
}

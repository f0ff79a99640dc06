//! The checks of GP and PP find what is wrong: one planted defect for each way in which a painting can be.

use std::sync::Arc;

use glam::{DVec3, Vec2};

use super::kit::{painted, sheet, sphere, state};
use crate::canvas::job::PaintJob;
use crate::engine::wound::paint::Corner;
use crate::engine::wound::{Cut, Pick, State, checks};
use crate::report::Check;

fn made() -> (State, Box<Cut>) {
    let mut state = state(&sphere(4));
    let cut = painted(&mut state, Pick::Pixel([270.0, 165.0]), Pick::Pixel([360.0, 200.0]));
    (state, cut)
}

fn broken(checks: Vec<Check>) -> Vec<String> {
    checks.into_iter().filter(|c| !c.ok).map(|c| c.name).collect()
}

/// What the checks of PP find after something was done to a painting.
fn found(plant: impl Fn(&mut PaintJob, &mut Cut)) -> Vec<String> {
    let (state, mut cut) = made();
    let mut painted = cut.painted.take().unwrap();
    let mut painting = (*painted.painting).clone();
    plant(&mut painting.paint, &mut cut);
    painted.painting = Arc::new(painting);
    cut.painted = Some(painted);
    broken(checks::paint(&state, &cut))
}

#[test]
fn a_patch_of_another_size_or_height_is_found() {
    let found = |plant: fn(&mut Cut)| {
        let (state, mut cut) = made();
        plant(&mut cut);
        broken(checks::patch(&state, &cut))
    };
    assert_eq!(found(|_| {}), [""; 0]);
    assert_eq!(found(|cut| cut.patch.as_mut().unwrap().job.size[1] += 1), ["size", "radii"]);
    assert_eq!(found(|cut| cut.patch.as_mut().unwrap().job.size[0] += 2)[0], "size");
    assert_eq!(found(|cut| cut.patch.as_mut().unwrap().height *= 1.0 + 1e-6), ["radii"]);
    assert_eq!(found(|cut| cut.patch = None), ["size"]);
}

#[test]
fn a_painting_as_it_was_made_has_no_fault() {
    assert_eq!(found(|_, _| {}), [""; 0]);
}

#[test]
fn a_corner_that_is_nowhere_is_found() {
    assert!(found(|job, _| job.faces[3].at[1].x = f32::NAN).contains(&"finite".into()));
    assert_eq!(found(|job, _| job.noise_scale = f32::INFINITY), ["finite"]);
}

#[test]
fn a_line_that_is_not_spanned_is_found() {
    // All parts at the line's end are moved, so that nothing is torn.
    let end = |job: &mut PaintJob, by: Vec2| {
        let length = job.length;
        let corners = job.faces.iter_mut().flat_map(|f| &mut f.at);
        corners.filter(|at| **at == Vec2::new(length, 0.0)).for_each(|at| *at += by);
    };
    assert_eq!(found(|job, _| end(job, Vec2::new(-2e-4 * job.length, 0.0))), ["spans"]);
    assert_eq!(found(|job, _| end(job, Vec2::new(0.0, 2e-4 * job.height))), ["spans"]);
    assert!(found(|_, cut| cut.links[1].face = cut.links[0].face).contains(&"spans".into()));
}

#[test]
fn a_corner_that_does_not_fit_its_neighbours_is_found() {
    let last = |job: &mut PaintJob| {
        let last = job.faces.len() - 1;
        job.faces[last].at[0].x += 1e-5 * job.length;
    };
    assert_eq!(found(|job, _| last(job)), ["seams"]);
}

#[test]
fn a_face_left_out_out_of_place_or_out_of_reach_is_found() {
    let without = |i: usize| {
        let (state, mut cut) = made();
        let painted = cut.painted.as_mut().unwrap();
        let mut painting = (*painted.painting).clone();
        painting.paint.faces.remove(i);
        painting.paint.inner -= usize::from(i < painting.paint.inner);
        painted.corners.remove(i);
        painted.painting = Arc::new(painting);
        broken(checks::paint(&state, &cut))
    };
    let (_, cut) = made();
    let job = &cut.painted.as_ref().unwrap().painting.paint;
    assert_eq!(without(job.inner), ["gathered"]);
    assert_eq!(without(job.inner - 1), ["gathered"]);
    assert_eq!(found(|job, _| job.inner += 3), ["gathered"]);
    assert_eq!(found(|job, _| job.inner -= 3), ["gathered"]);
    assert_eq!(found(|job, _| job.height *= 0.9), ["gathered"]);
    // Some other face of the sphere, far from the line.
    assert_eq!(found(|job, _| job.faces.last_mut().unwrap().face = 5000), ["gathered"]);
}

#[test]
fn a_line_on_a_sheet_is_known_by_its_points_and_nodes() {
    let flat = |i: u32, j: u32| DVec3::new(f64::from(i), f64::from(j), 0.0);
    let mut state = state(&sheet(4, flat, |i, j| Vec2::new(i as f32, j as f32) / 4.0));
    let cut = painted(&mut state, Pick::Node(crate::mesh::NodeId(6)), Pick::Node(crate::mesh::NodeId(8)));
    let corners = &cut.painted.as_ref().unwrap().corners;
    assert!(corners.iter().flatten().all(|c| matches!(c, Corner::Node(_))), "it runs over nodes alone");
}

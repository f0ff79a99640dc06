//! MC and SD: the surface is the same, only divided; and the line is there.

use glam::{DVec2, DVec3};

use super::{euler, largest, position_bound, topology};
use crate::engine::wound::pattern::altitude;
use crate::engine::wound::state::{Before, Cut, State};
use crate::geometry::distance_to_plane;
use crate::mesh::check::{doubled_area, sixfold_volume};
use crate::mesh::refine::Refined;
use crate::mesh::{Face, FaceId, Mesh};
use crate::report::Check;

pub(in super::super) fn merge(state: &State, cut: &Cut) -> Vec<Check> {
    let mut checks = subdivision(state, &cut.refined, &cut.before_merge);
    checks.push(line(&state.mesh, cut));
    checks
}

pub(in super::super) fn subdivision(state: &State, refined: &Refined, before: &Before) -> Vec<Check> {
    let mesh = &state.mesh;
    let bound = position_bound(state);
    let families: Vec<Family<'_>> = before.parents.iter().zip(&refined.children).collect();
    let faces: Vec<FaceId> = refined.children.iter().flatten().copied().collect();
    let mut checks = vec![
        topology(mesh, &faces),
        euler(mesh, before),
        area(mesh, &families, bound),
        volume(mesh, &families, bound),
        Check::at_most("parent-distance", parent_distance(mesh, &families), bound),
    ];
    if mesh.is_textured() {
        checks.push(uv_affine(mesh, &families, bound));
    }
    checks
}

/// A face as it was, with its corners, and its children.
type Family<'a> = (&'a (Face, [DVec3; 3]), &'a Vec<FaceId>);

/// No area is gained or lost beyond what rounding the new corners can do.
fn area(mesh: &Mesh, families: &[Family<'_>], bound: f64) -> Check {
    let (mut off, mut allowed) = (0.0, 0.0);
    for ((_, parent), children) in families {
        let sum: f64 = children.iter().map(|&f| doubled_area(mesh.triangle(f)).length()).sum();
        off += (sum - doubled_area(*parent).length()).abs() * 0.5;
        allowed += bound * children.iter().map(|&f| perimeter(mesh.triangle(f))).sum::<f64>();
    }
    Check::at_most("area", off, allowed)
}

fn volume(mesh: &Mesh, families: &[Family<'_>], bound: f64) -> Check {
    let (mut off, mut allowed) = (0.0, 0.0);
    for ((_, parent), children) in families {
        let sum: f64 = children.iter().map(|&f| sixfold_volume(parent[0], mesh.triangle(f))).sum();
        off += sum.abs() / 6.0;
        let longest = perimeter(*parent);
        allowed += bound * longest * longest;
    }
    Check::at_most("volume", off, allowed)
}

fn perimeter([a, b, c]: [DVec3; 3]) -> f64 {
    a.distance(b) + b.distance(c) + c.distance(a)
}

fn parent_distance(mesh: &Mesh, families: &[Family<'_>]) -> f64 {
    let corners = families.iter().flat_map(|((_, parent), children)| {
        children.iter().flat_map(|&f| mesh.triangle(f)).map(|p| distance_to_plane(p, *parent))
    });
    largest(corners)
}

/// Texture coordinates of new corners are those of their place in the parent, up to 1e-6 (of their size, where that is more than 1) and what the place itself is uncertain by.
fn uv_affine(mesh: &Mesh, families: &[Family<'_>], bound: f64) -> Check {
    let mut worst = 0.0;
    for ((face, parent), children) in families {
        let uvs = face.vertices.map(|v| mesh.vertex(v).uv.as_dvec2());
        let extent = uvs[0].distance(uvs[1]).max(uvs[1].distance(uvs[2]));
        // Coordinates outside of the unit square have fewer digits after the point.
        let size = uvs.iter().map(|uv| uv.abs().max_element()).fold(1.0, f64::max);
        // In a face of no area no place is more uncertain than by the whole face.
        let uncertain = match altitude(*parent) {
            0.0 => 2.0 * extent,
            altitude => extent * 4.0 * bound / altitude,
        };
        let tolerance = 1e-6 * size + uncertain;
        for &child in *children {
            for (p, v) in mesh.triangle(child).into_iter().zip(mesh.face(child).vertices) {
                let expected = affine(*parent, uvs, p);
                let off = expected.distance(mesh.vertex(v).uv.as_dvec2()) / tolerance;
                worst = largest([worst, off].into_iter());
            }
        }
    }
    Check::at_most("uv-affine", worst * 1e-6, 1e-6)
}

/// The texture coordinates at a point of a triangle.
fn affine([a, b, c]: [DVec3; 3], uvs: [DVec2; 3], p: DVec3) -> DVec2 {
    let n = (b - a).cross(c - a);
    let square = n.length_squared();
    if square == 0.0 {
        return along_longest([a, b, c], uvs, p);
    }
    let v = (p - a).cross(c - a).dot(n) / square;
    let w = (b - a).cross(p - a).dot(n) / square;
    uvs[0] + (uvs[1] - uvs[0]) * v + (uvs[2] - uvs[0]) * w
}

/// The same of a triangle so thin that in floats it has no area: by its longest side, from which no place of it is far.
fn along_longest(at: [DVec3; 3], uvs: [DVec2; 3], p: DVec3) -> DVec2 {
    let side = |i: usize| at[(i + 1) % 3] - at[i];
    let i = (0..3).fold(0, |best, k| if side(k).length() > side(best).length() { k } else { best });
    let t = (p - at[i]).dot(side(i)) / side(i).length_squared();
    uvs[i].lerp(uvs[(i + 1) % 3], t)
}

/// The line's edges are there, in order, through the chain's points.
fn line(mesh: &Mesh, cut: &Cut) -> Check {
    let (line, points) = (&cut.line, &cut.formed.chain.points);
    if line.nodes.len() != points.len() || line.edges.len() + 1 != points.len() {
        return Check::fail("line", format!("{} nodes for {} points", line.nodes.len(), points.len()));
    }
    let moved = line.nodes.iter().zip(points).find(|(n, p)| mesh.position(**n) != p.position);
    let broken = line.edges.iter().zip(line.nodes.windows(2)).find(|(e, pair)| {
        let nodes = mesh.edge(**e).nodes;
        !(nodes.contains(&pair[0]) && nodes.contains(&pair[1]))
    });
    match (moved, broken) {
        (Some((n, _)), _) => Check::fail("line", "a node is not at its point").culprits([n]),
        (_, Some((e, _))) => Check::fail("line", "an edge does not join its nodes").culprits([e]),
        _ => Check::pass("line"),
    }
}

//! GP: the patch has the size that the line asks for, and the radii that follow from it.

use glam::DVec2;

use super::position_bound;
use crate::engine::wound::patch::{Patch, WIDEST};
use crate::engine::wound::pattern::altitude;
use crate::engine::wound::state::{Cut, State};
use crate::engine::wound::surface::SkinLink;
use crate::geometry::double;
use crate::mesh::{FaceId, Mesh};
use crate::report::Check;

/// How far p_w may be from L ρ as it is counted here, in parts of it: the roundings of positions and texture coordinates.
const SIZE_ERROR: f64 = 1e-5;

pub(in super::super) fn patch(state: &State, cut: &Cut) -> Vec<Check> {
    match &cut.patch {
        Some(patch) => vec![size(state, cut, patch), radii(cut, patch)],
        None => vec![Check::fail("size", "there is no patch")],
    }
}

fn length(cut: &Cut) -> f64 {
    cut.formed.chain.points.windows(2).map(|w| (w[1].position - w[0].position).length()).sum()
}

/// p_w by texels counted along the line with the gradient of each face's texture, and p_h by its formula.
fn size(state: &State, cut: &Cut, patch: &Patch) -> Check {
    let counted: f64 = cut.links.iter().map(|link| texels(&state.mesh, cut, link, state.map_size)).sum();
    let skin: f64 = cut.links.iter().map(|link| link.length).sum();
    let texels = length(cut) * counted / skin;
    let [width, height] = patch.job.size.map(f64::from);
    let roundings: f64 = cut.links.iter().map(|link| rounding(state, link.face)).sum();
    let slack = SIZE_ERROR * (1.0 + texels.abs()) + length(cut) * roundings / skin;
    let fits = match width {
        8.0 => texels <= 8.0 + slack,
        WIDEST => texels >= WIDEST - 1.0 - slack,
        _ => (width - 1.0 - slack..=width + slack).contains(&texels),
    };
    let ratio = 2.0 * libm::log(width) / std::f64::consts::LN_10;
    let tall = (height - (ratio * libm::sqrt(width)).max(4.0)).abs() <= 0.5 + 1e-9;
    let check = Check { value: Some(width), ..Check::pass("size") };
    match (fits && (8.0..=WIDEST).contains(&width), tall) {
        (true, true) => check,
        (false, _) => {
            Check { value: Some(width), ..Check::fail("size", format!("the line is {texels} texels long")) }
        }
        _ => Check {
            value: Some(height),
            ..Check::fail("size", format!("{width} texels ask for another height"))
        },
    }
}

/// How many texels a link crosses, by the gradient of the texture over its face.
fn texels(mesh: &Mesh, cut: &Cut, link: &SkinLink, map: [u32; 2]) -> f64 {
    let [from, to] = [link.link, link.link + 1].map(|i| cut.formed.chain.points[i].position);
    let step = gradient(mesh, link.face, to - from) * DVec2::from(map.map(f64::from));
    step.length()
}

/// How many texels the rounding of a link's two ends may be: many on a sliver, over which the texture changes fast.
fn rounding(state: &State, face: FaceId) -> f64 {
    let map = DVec2::from(state.map_size.map(f64::from));
    let uv = state.mesh.face(face).vertices.map(|v| state.mesh.vertex(v).uv.as_dvec2() * map);
    let widest = uv[0].distance(uv[1]).max(uv[1].distance(uv[2])).max(uv[2].distance(uv[0]));
    // Where the texture is one point there is no rounding, however thin the face.
    (2.0 * position_bound(state) * widest / altitude(state.mesh.triangle(face))).max(0.0)
}

/// What a step in space along a face is in its texture.
fn gradient(mesh: &Mesh, face: FaceId, step: glam::DVec3) -> DVec2 {
    let [a, b, c] = mesh.triangle(face);
    let uv = mesh.face(face).vertices.map(|v| mesh.vertex(v).uv.as_dvec2());
    // With doubled digits: a sliver's normal has few in floats.
    let normal = double::rounded(double::cross(double::difference(b, a), double::difference(c, a)));
    let scale = normal.length_squared();
    let weight = |from, to| {
        double::rounded(double::cross(
            double::difference(to, from),
            double::difference(step, glam::DVec3::ZERO),
        ))
        .dot(normal)
            / scale
    };
    uv[0] * weight(b, c) + uv[1] * weight(c, a) + uv[2] * weight(a, b)
}

/// c_h : L = p_h : p_w, L is the length of the line, and no radius is more than it.
fn radii(cut: &Cut, patch: &Patch) -> Check {
    let [width, height] = patch.job.size.map(f64::from);
    let length = length(cut);
    let off = (patch.height * width - length * height).abs() / (length * height);
    let check = Check::at_most("radii", off, 1e-12);
    match patch.height > 0.0 && patch.height <= length {
        true => check,
        false => Check::fail("radii", format!("a patch {} high on a line {length} long", patch.height)),
    }
}

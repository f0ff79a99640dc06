//! A frame: what is looked at and how, and the picture that it gives, pixel by pixel (Lam 2016, Appendix B).
//!
//! All geometry is in model units. Pixel (i, j) has its centre at (i + ½, j + ½) from the top left; one sample a pixel. Triangles cover
//! pixels by the top-left rule, with corners rounded to 1/256 of a pixel; attributes are perspective-correct; the nearest surface wins. Both
//! sides of a face are seen; from behind its normals are turned.
//!
//! # The skin pass
//!
//! At a pixel: P the position, N the interpolated vertex normal, made unit length, and turned towards the eye's side of the face if seen from behind; T and B
//! the interpolated tangent and bitangent; V the unit vector to the eye. Maps are sampled as [`image`](super::image) says; sRGB colours
//! decoded.
//!
//! - **skin** ([`Surface::Skin`]): albedo A and scattering strength a from the colour map; occlusion k_A; intensity and roughness from the specular
//!   map; n = unit(b (x T + y B) + √max(0, 1 − x² − y²) N), (x, y) from the normal map, b the bumpiness. What is switched off, or has no map, is at its default.
//! - **the inside of a cut** ([`Surface::Gutter`]): A between the three tissue colours at v = 1, ½, 0, mixed as sRGB values; k_A = ¼ + ¾ v;
//!   a = 0; n = N; the skin's own intensity and roughness. No map is read.
//!
//! For every light, with l the unit vector to it, D₀ and D its distances from its target and from P:
//! I = colour (D₀/D)² smoothstep(cos outer, cos inner, −l · axis), c = max(0, n · l), k the shadow:
//! - diffuse: A I c k;
//! - specular (c > 0): with h' = l + V, h = unit(h'): k_spec intensity D(n · h, m) F / (h' · h') I c k, where
//!   D = exp(−tan²α/m²)/(m² cos⁴α), cos α = n · h > 0 (Beckmann, looked up in a table over n · h and m), F = R₀ + (1 − R₀)(1 − V · h)⁵ (Schlick).
//!   A roughness below 0.05 counts as 0.05;
//! - transmitted: A I T(s) sat(0.3 − N · l), with T(s) = Σ w exp(−s²/v) or exp(−s²/2v), the six Gaussians of Table B.1, v in mm², and
//!   s = (1 − translucency) × the thickness in millimetres. The thickness is |z_in − z_out|: Q = P − N × 1 mm, z_out its depth from the
//!   light, z_in the bilinear depth in the shadow map at Q. Nothing comes through outside of the map.
//!
//! - ambient: A L_A k_A max(0, E(n)), E the irradiance's nine harmonics.
//!
//! The pass gives diffuse light (diffuse + transmitted + ambient; a beside it), specular light, the depth z along the view's forward axis, and the
//! discolour map's sample.
//!
//! **Shadows** (percentage-closer filtering): with e = 2 z tan half / size a texel's width at P's depth z from the light, Q = P + 1.5 e N; a look
//! compares z(Q) − ½ e with the four stored depths around it (lit where it is not more), and is bilinear between the four answers. filter × filter looks, one
//! texel apart, centred on Q, are averaged. Outside of the map all is lit. The map holds the nearest surface's depth along the light's axis at each
//! texel's centre, far where there is none; rows from the top, by [`Light::basis`].
//!
//! # Scattering (separable: Jimenez et al. 2012; Lam 2016, B.2.1.2)
//!
//! The kernel: n samples, x_u = −r + 2 r i/(n − 1), r = 2 up to 19 samples, else 3; offsets x = r sign(x_u)(x_u/r)²; profile
//! p(x) = Σ w G(v, x/(f + 0.001)), the red weights of Table B.1 without the first Gaussian, G(v, r) = exp(−r²/2v)/2πv; areas half the
//! distance to the neighbours; weights p × area, normalised to the sum 1 a channel, times t, and 1 − t more at the centre.
//!
//! Two passes over the diffuse light, across, then down. The step from offset x is a × x/r × width × H/(2 z tan(fov/2)) pixels. A sample is taken
//! bilinear (colour) and at the nearest pixel (depth z'), clamped to the frame; and mixed towards the centre's own colour by
//! sat(|z − z'|/width). Pixels with a = 0 stay as they are. In the second pass the centre's weight is multiplied by 1 + α(2 c − 1) a channel, (c, α) the
//! discoloration: once, so that it does not compound, and last, so that it stays where it is.
//!
//! # The picture
//!
//! Scattered diffuse light + specular light, clamped to 0 … 1, encoded as sRGB, rounded; alpha 255. Behind the model the background's colour.

use super::image::Image;
use super::look::{Look, Spotlight, Switches};
use crate::mesh::Mesh;
#[cfg(doc)]
use crate::mesh::Surface;
pub use crate::report::Pass;
use glam::DVec3;

/// Three key, fill and rim lights, for scenes that name none.
fn usual_lights() -> Vec<Spotlight> {
    let light = |azimuth, zenith, color| Spotlight { azimuth, zenith, color, ..Spotlight::default() };
    vec![
        light(0.7, 1.1, [1.25, 1.18, 1.08]),
        light(-0.9, 1.45, [0.34, 0.37, 0.42]),
        light(2.7, 1.0, [0.75, 0.72, 0.70]),
    ]
}

/// Where one looks from, as angles and a distance around a target that stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Angle around the vertical axis, radians.
    pub azimuth: f64,
    /// Angle from straight up, radians, 0 to π.
    pub zenith: f64,
    /// Eye to target, model units.
    pub distance: f64,
}

/// Where one looks from, and what the picture measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The eye.
    pub eye: DVec3,
    /// Right, up and forward, each of length 1.
    pub basis: [DVec3; 3],
    /// Vertical field of view, radians.
    pub fov_y: f64,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Depth along forward of the nearest thing that can be seen.
    pub near: f64,
    /// The same of the farthest.
    pub far: f64,
}

impl View {
    /// The largest size of this view's shape that lies within a box, and is no larger than the view.
    #[must_use]
    pub fn within(&self, limit: [u32; 2]) -> Self {
        let [w, h] = self.size.map(u64::from);
        let [lw, lh] = limit.map(u64::from);
        let scaled = |side: u64, num: u64, den: u64| ((side * num + den / 2) / den).max(1) as u32;
        let size = match (w <= lw && h <= lh, w * lh >= h * lw) {
            (true, _) => self.size,
            (false, true) => [limit[0], scaled(h, lw, w)],
            (false, false) => [scaled(w, lh, h), limit[1]],
        };
        Self { size, ..*self }
    }
}

/// A light in place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it is.
    pub position: DVec3,
    /// Right, up and forward (its axis), each of length 1: those of its shadow map.
    pub basis: [DVec3; 3],
    /// Distance of its target, D₀.
    pub distance: f64,
    /// Linear colour and intensity.
    pub color: [f32; 3],
    /// Cosine of the angle where its light ends.
    pub cos_outer: f64,
    /// Cosine of the angle where it begins to fade.
    pub cos_inner: f64,
    /// Tangent of half the shadow map's angle.
    pub tan_half: f64,
    /// Depths between which the shadow map sees.
    pub near: f64,
    /// The farther of them.
    pub far: f64,
    /// Whether its cone meets the model's bounds at all.
    pub reaches: bool,
}

/// Puts a scene's lights around bounds: their centre and radius.
pub fn place_lights(look: &Look, centre: DVec3, radius: f64) -> Vec<Light> {
    let usual = look.lights.is_none().then(usual_lights).unwrap_or_default();
    look.lights.as_ref().unwrap_or(&usual).iter().map(|light| place(light, centre, radius)).collect()
}

fn place(light: &Spotlight, centre: DVec3, radius: f64) -> Light {
    let ((sa, ca), (sz, cz)) = (libm::sincos(light.azimuth), libm::sincos(light.zenith));
    let position = centre + DVec3::new(sz * sa, cz, sz * ca) * (light.distance * radius);
    let target = light.target.map_or(centre, DVec3::from);
    let forward = (target - position).normalize_or(DVec3::NEG_Z);
    let up = if forward.y.abs() < 0.999 { DVec3::Y } else { DVec3::Z };
    let right = forward.cross(up).normalize();
    let to_centre = centre - position;
    let (along, away) = (to_centre.dot(forward), to_centre.length());
    // Half the angle under which the bounds are seen, and the angle to their middle.
    let (seen, aside) = (libm::asin((radius / away).min(1.0)), libm::acos((along / away).clamp(-1.0, 1.0)));
    let half = light.cone.min(aside + seen * 1.02);
    Light {
        position,
        basis: [right, right.cross(forward), forward],
        distance: position.distance(target),
        color: light.color,
        cos_outer: libm::cos(light.cone),
        cos_inner: libm::cos(light.cone * (1.0 - light.softness)),
        tan_half: libm::tan(half),
        near: (along - 1.02 * radius).max(0.01 * radius),
        far: along + 1.02 * radius,
        reaches: aside < light.cone + seen,
    }
}

/// A frame to render.
#[derive(Clone, Copy, Debug)]
pub struct FrameJob<'a> {
    /// The surface.
    pub mesh: &'a Mesh,
    /// Changes whenever the mesh does: a renderer that saw this version has nothing to upload.
    pub version: u64,
    /// Where one looks from.
    pub view: View,
    /// The lights in place.
    pub lights: &'a [Light],
    /// Light, skin and wounds.
    pub look: &'a Look,
    /// What is on.
    pub switches: Switches,
    /// Centimetres in a model unit.
    pub unit_cm: f64,
    /// A point near the model that never moves: positions may be kept relative to it in f32.
    pub origin: DVec3,
    /// Skips nothing: every pass, light and tile is worked through.
    pub everything: bool,
}

/// A frame as it was rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The picture.
    pub image: Image,
    /// What was done for it, in order.
    pub passes: Vec<Pass>,
}

//! What is at a pixel: the point of the surface, and what it is made of (Lam 2016, B.1.1).
//!
//! A face's attributes are perspective-correct: the ray d through a pixel meets the face of corners v₀, v₁, v₂, as they are seen, where their
//! weights are as d · (v₁ × v₂), d · (v₂ × v₀), d · (v₀ × v₁). That needs no division by a depth, so a face that reaches behind the eye is like any
//! other. Weights are kept from 0 to 1: a pixel that only the rounded corners cover has the attributes of the face's border.

use glam::{DVec3, Vec3};

use super::lens::Lens;
use super::raster::Triangle;
use super::sample::Sampler;
use crate::canvas::image::{Image, Maps};
use crate::canvas::look::{Look, Switches};
use crate::mesh::{FaceId, Mesh, Surface, Vertex};
use crate::render::srgb;

/// A face, ready to be asked what is seen of it.
pub(crate) struct Facet {
    /// v₁ × v₂, v₂ × v₀ and v₀ × v₁.
    sides: [DVec3; 3],
    corners: [DVec3; 3],
    vertices: [Vertex; 3],
    surface: Surface,
    /// −1 for one that is seen from behind.
    sign: f64,
}

/// A point of the surface.
pub(crate) struct Point {
    /// P, relative to the eye: far from the origin positions themselves have no digits left between two pixels.
    pub(crate) position: DVec3,
    /// N, on the eye's side.
    pub(crate) normal: DVec3,
    /// T and B, as they are between the corners.
    tangents: [DVec3; 2],
    /// Texture coordinates.
    pub(crate) uv: [f64; 2],
}

impl Facet {
    /// A face as a lens sees it.
    pub(crate) fn new(mesh: &Mesh, triangle: &Triangle, lens: &Lens) -> Self {
        let id = FaceId(triangle.face);
        let corners = mesh.triangle(id);
        let [a, b, c] = corners.map(|p| lens.see(p));
        let face = mesh.face(id);
        Self {
            sides: [b.cross(c), c.cross(a), a.cross(b)],
            corners: corners.map(|p| lens.relative(p)),
            vertices: face.vertices.map(|v| mesh.vertex(v)),
            surface: face.surface,
            sign: if triangle.behind() { -1.0 } else { 1.0 },
        }
    }

    /// What a ray meets.
    pub(crate) fn meet(&self, ray: DVec3) -> Point {
        let weights = self.weights(ray);
        let mean = |of: fn(&Vertex) -> Vec3| -> DVec3 {
            weights.iter().zip(&self.vertices).map(|(w, vertex)| of(vertex).as_dvec3() * *w).sum()
        };
        let uv =
            |axis: usize| weights.iter().zip(&self.vertices).map(|(w, v)| w * f64::from(v.uv[axis])).sum();
        Point {
            position: weights.iter().zip(&self.corners).map(|(w, corner)| *corner * *w).sum(),
            normal: mean(|v| v.normal).normalize_or(DVec3::Y) * self.sign,
            tangents: [mean(|v| v.tangent), mean(|v| v.bitangent)],
            uv: [uv(0), uv(1)],
        }
    }

    fn weights(&self, ray: DVec3) -> [f64; 3] {
        let parts = self.sides.map(|side| side.dot(ray));
        let sum: f64 = parts.iter().sum();
        let inside = parts.map(|part| (part / sum).clamp(0.0, 1.0));
        let sum: f64 = inside.iter().sum();
        // A face that is seen as a line: anywhere on it will do.
        if sum.is_finite() && sum > 0.0 { inside.map(|w| w / sum) } else { [1.0 / 3.0; 3] }
    }
}

/// What the surface is made of at a point.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Material {
    /// A, linear.
    pub(crate) albedo: Vec3,
    /// How far light scatters, a.
    pub(crate) scattering: f32,
    /// How much ambient light arrives, k_A.
    pub(crate) occlusion: f32,
    /// Specular intensity.
    pub(crate) intensity: f32,
    /// Roughness m.
    pub(crate) roughness: f32,
    /// n: the normal with its bumps.
    pub(crate) normal: Vec3,
    /// c and α of the discoloration.
    pub(crate) discolor: [f32; 4],
}

/// The maps of a scene as a frame reads them; `None` is switched off.
pub(crate) struct Materials<'a> {
    look: &'a Look,
    albedo: Vec3,
    color: Option<Sampler<'a>>,
    normal: Option<Sampler<'a>>,
    occlusion: Option<Sampler<'a>>,
    specular: Option<Sampler<'a>>,
    discolor: Option<Sampler<'a>>,
}

impl<'a> Materials<'a> {
    /// Those of a scene, with its painted maps.
    pub(crate) fn new(
        look: &'a Look,
        switches: Switches,
        maps: &'a Maps,
        [color, discolor]: [&'a Image; 2],
    ) -> Self {
        // Discoloration changes how light scatters, and nothing else.
        let discolored = switches.discoloration && switches.scattering;
        Self {
            look,
            albedo: srgb::decode_color(look.skin.albedo).into(),
            color: switches.color_map.then(|| Sampler::srgb(color)),
            normal: switches.normal_map.then(|| Sampler::signed(&maps.normal)),
            occlusion: switches.occlusion_map.then(|| Sampler::plain(&maps.occlusion)),
            specular: switches.specular_map.then(|| Sampler::plain(&maps.specular)),
            discolor: discolored.then(|| Sampler::plain(discolor)),
        }
    }

    /// What a facet is made of at one of its points.
    pub(crate) fn at(&self, facet: &Facet, point: &Point) -> Material {
        match facet.surface {
            Surface::Skin => self.skin(point),
            Surface::Gutter => self.tissue(point),
        }
    }

    fn skin(&self, point: &Point) -> Material {
        let sample = |map: Option<Sampler<'_>>| map.map(|map| map.at(point.uv));
        let (skin, full) = (&self.look.skin, [self.albedo.x, self.albedo.y, self.albedo.z, 1.0]);
        let [r, g, b, scattering] = sample(self.color).unwrap_or(full);
        let [intensity, roughness, ..] =
            sample(self.specular).unwrap_or([skin.intensity, skin.roughness, 0.0, 0.0]);
        Material {
            albedo: Vec3::new(r, g, b),
            scattering,
            occlusion: sample(self.occlusion).map_or(1.0, |[k, ..]| k),
            intensity,
            roughness,
            normal: sample(self.normal).map_or(point.normal.as_vec3(), |[x, y, ..]| self.bumped(point, x, y)),
            discolor: sample(self.discolor).unwrap_or_default(),
        }
    }

    /// n = unit(b (x T + y B) + √max(0, 1 − x² − y²) N); exactly N where the map is flat.
    fn bumped(&self, point: &Point, x: f32, y: f32) -> Vec3 {
        let [tangent, bitangent] = point.tangents.map(|t| t.as_vec3());
        let (normal, height) = (point.normal.as_vec3(), (1.0 - x * x - y * y).max(0.0).sqrt());
        if [x, y] == [0.0; 2] {
            return normal;
        }
        ((tangent * x + bitangent * y) * self.look.skin.bumpiness + normal * height).normalize_or(normal)
    }

    /// The inside of a cut, from its rim, v = 1, to its bottom.
    fn tissue(&self, point: &Point) -> Material {
        let (v, [rim, middle, bottom]) =
            (point.uv[1].clamp(0.0, 1.0) as f32, self.look.wound.tissue.map(Vec3::from));
        let color = if v > 0.5 { middle.lerp(rim, 2.0 * v - 1.0) } else { bottom.lerp(middle, 2.0 * v) };
        Material {
            albedo: srgb::decode_color(color.into()).into(),
            occlusion: 0.25 + 0.75 * v,
            intensity: self.look.skin.intensity,
            roughness: self.look.skin.roughness,
            normal: point.normal.as_vec3(),
            ..Material::default()
        }
    }
}

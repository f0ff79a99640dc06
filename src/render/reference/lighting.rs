//! Light at a point of the surface: diffuse, specular, transmitted and ambient (Lam 2016, B.1 and B.2.2).
//!
//! Specular reflection is Kelemen and Szirmay-Kalos' with Beckmann's distribution and Schlick's Fresnel term. We depart from the thesis in
//! that term, R₀ + (1 − R₀)(1 − V · h)⁵, and in measuring the thickness in millimetres instead of by an empirical scale.

use glam::{DVec3, Vec3};

use super::shadow::{ShadowMap, ShadowsAround};
use super::surface::{Material, Point};
use crate::canvas::frame::{FrameJob, Light};
use crate::canvas::look::{Ambient, Law, Look};
use crate::render::kernel::PROFILE;
use crate::render::{beckmann, sat};

/// What a part does not add is not compiled in.
pub(crate) trait Parts: Sync {
    /// Specular reflection.
    const SPECULAR: bool;
    /// Light that comes through.
    const TRANSMITTED: bool;
}

/// A choice of parts.
pub(crate) struct With<const SPECULAR: bool, const TRANSMITTED: bool>;

impl<const SPECULAR: bool, const TRANSMITTED: bool> Parts for With<SPECULAR, TRANSMITTED> {
    const SPECULAR: bool = SPECULAR;
    const TRANSMITTED: bool = TRANSMITTED;
}

/// A light, and its shadow map if anything reads it.
pub(crate) struct Lamp<'a> {
    light: &'a Light,
    /// Where it is, relative to the eye.
    position: DVec3,
    /// Its map, for points relative to the eye.
    map: Option<ShadowsAround<'a>>,
}

impl<'a> Lamp<'a> {
    /// A light with its map, seen from an eye.
    pub(crate) fn new(light: &'a Light, map: Option<&'a ShadowMap>, eye: DVec3) -> Self {
        Self { light, position: light.position - eye, map: map.map(|map| map.around(eye)) }
    }
}

/// All light of a frame.
pub(crate) struct Lighting<'a> {
    lamps: Vec<Lamp<'a>>,
    look: &'a Look,
    /// Whether the maps cast shadows; else they are there for transmitted light alone.
    shadows: bool,
    /// A millimetre in model units.
    millimetre: f64,
    /// What the square of s, in mm, is multiplied by in each Gaussian's exponent.
    decay: [f32; 6],
    table: &'static [f32],
}

/// Light that leaves a point towards the eye.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Leaving {
    /// Diffuse, transmitted and ambient.
    pub(crate) diffuse: Vec3,
    /// Specular.
    pub(crate) specular: Vec3,
}

/// What a point, its material and the eye say to every light.
struct Site<'a> {
    point: &'a Point,
    material: &'a Material,
    normal: Vec3,
    /// V.
    view: Vec3,
}

/// A light as it arrives at a point.
struct Arriving {
    /// l.
    direction: Vec3,
    /// I.
    light: Vec3,
}

impl<'a> Lighting<'a> {
    /// The light of a frame, from these lamps.
    pub(crate) fn new(job: &FrameJob<'a>, lamps: Vec<Lamp<'a>>) -> Self {
        let per = match job.look.scattering.law {
            Law::Published => 1.0,
            Law::Derived => 2.0,
        };
        Self {
            lamps,
            look: job.look,
            shadows: job.switches.shadows,
            millimetre: 0.1 / job.unit_cm,
            decay: PROFILE.map(|gaussian| (-1.0 / (per * gaussian.variance)) as f32),
            table: beckmann::table(),
        }
    }

    /// The light that leaves a point.
    pub(crate) fn at<P: Parts>(&self, point: &Point, material: &Material) -> Leaving {
        let view = (-point.position).normalize_or_zero().as_vec3();
        let site = Site { point, material, normal: point.normal.as_vec3(), view };
        let mut sum = Leaving { diffuse: self.ambient(material), specular: Vec3::ZERO };
        for lamp in &self.lamps {
            let arriving = arriving(lamp, point.position);
            if arriving.light != Vec3::ZERO {
                self.add::<P>(&mut sum, lamp, &site, &arriving);
            }
        }
        sum
    }

    /// Adds what a light does.
    fn add<P: Parts>(&self, sum: &mut Leaving, lamp: &Lamp<'_>, site: &Site<'_>, arriving: &Arriving) {
        let (material, cos) = (site.material, site.material.normal.dot(arriving.direction));
        if cos > 0.0 {
            let lit = arriving.light * (cos * self.shadow(lamp, site.point));
            sum.diffuse += material.albedo * lit;
            if P::SPECULAR {
                sum.specular += lit * self.specular(site, arriving.direction);
            }
        }
        let wrapped = sat(0.3 - site.normal.dot(arriving.direction));
        if P::TRANSMITTED && wrapped > 0.0 {
            sum.diffuse += material.albedo * arriving.light * self.transmitted(lamp, site.point) * wrapped;
        }
    }

    /// k.
    fn shadow(&self, lamp: &Lamp<'_>, point: &Point) -> f32 {
        let map = lamp.map.filter(|_| self.shadows);
        map.map_or(1.0, |map| map.lit(point.position, point.normal, self.look.shadows.filter))
    }

    /// Specular reflectance: k_spec intensity D F/(h' · h').
    fn specular(&self, site: &Site<'_>, light: Vec3) -> f32 {
        let between = light + site.view;
        let square = between.length_squared();
        let half = between / square.sqrt();
        let cos = site.material.normal.dot(half);
        // Also false where light comes from behind the point exactly, and there is no half-way direction.
        if cos > 0.0 {
            let skin = &self.look.skin;
            let lobe = beckmann::lookup(self.table, cos, site.material.roughness);
            let fresnel = schlick(skin.reflectance, sat(site.view.dot(half)));
            skin.specular * site.material.intensity * lobe * fresnel / square
        } else {
            0.0
        }
    }

    /// T(s), from the point moved a millimetre inwards.
    fn transmitted(&self, lamp: &Lamp<'_>, point: &Point) -> Vec3 {
        let inside = point.position - point.normal * self.millimetre;
        let Some(thickness) = lamp.map.and_then(|map| map.thickness(inside)) else { return Vec3::ZERO };
        let s = (1.0 - f64::from(self.look.scattering.translucency)) * thickness / self.millimetre;
        self.transmittance((s * s) as f32)
    }

    /// T by the square of s in mm².
    fn transmittance(&self, square: f32) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for (gaussian, decay) in PROFILE.iter().zip(self.decay) {
            let exponent = square * decay;
            // Below this exp() is 0 in f32.
            if exponent > -104.0 {
                sum += Vec3::from(gaussian.weights.map(|w| w as f32)) * libm::expf(exponent);
            }
        }
        sum
    }

    /// A L_A k_A max(0, E(n)).
    fn ambient(&self, material: &Material) -> Vec3 {
        let Ambient { intensity, irradiance } = &self.look.ambient;
        material.albedo
            * (intensity * material.occlusion)
            * irradiated(irradiance, material.normal).max(Vec3::ZERO)
    }
}

/// F.
fn schlick(reflectance: f32, cos: f32) -> f32 {
    let away = 1.0 - cos;
    let square = away * away;
    reflectance + (1.0 - reflectance) * (square * square * away)
}

/// E: what nine spherical harmonics say for a direction.
fn irradiated(harmonics: &[[f32; 3]; 9], n: Vec3) -> Vec3 {
    let (x, y, z) = (n.x, n.y, n.z);
    let basis = [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y];
    harmonics.iter().zip(basis).map(|(color, b)| Vec3::from(*color) * b).sum()
}

/// A light at a point: colour (D₀/D)² smoothstep(cos outer, cos inner, −l · axis).
fn arriving(&Lamp { light, position, .. }: &Lamp<'_>, point: DVec3) -> Arriving {
    let to = position - point;
    let distance = to.length();
    let direction = to / distance;
    let inside = -direction.dot(light.basis[2]);
    let fade = smoothstep(light.cos_outer, light.cos_inner, inside);
    // Bounded, so that a point at the light itself has a finite colour.
    let near = (light.distance / distance).min(1e6);
    let part = if fade > 0.0 { (near * near * fade) as f32 } else { 0.0 };
    Arriving { direction: direction.as_vec3(), light: Vec3::from(light.color) * part }
}

/// From 0 to 1 between two edges; a step where they are one, and nothing for what is no number.
fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    if x >= to && x > from {
        1.0
    } else if x > from {
        let part = (x - from) / (to - from);
        part * part * (3.0 - 2.0 * part)
    } else {
        0.0
    }
}

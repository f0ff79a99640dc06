//! What a scene says about light, skin and wounds. Everything has a default; unknown fields are errors.
//!
//! Colours of light are linear; colours of skin and wounds are sRGB, as one reads them off a picture.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The whole look of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Look {
    /// Spotlights; none given is three: key, fill and rim.
    pub lights: Option<Vec<Spotlight>>,
    /// Light from everywhere.
    pub ambient: Ambient,
    /// How shadows are looked up.
    pub shadows: Shadows,
    /// The skin.
    pub skin: Skin,
    /// How light scatters in it.
    pub scattering: Scattering,
    /// What a cut paints.
    pub wound: Wound,
    /// sRGB colour behind the model.
    pub background: Background,
    /// Which parts are on. `set` events change them.
    pub switches: Switches,
}

/// A light at a point, with a cone. It stands around the centre of the mesh's bounds, by the angles of the camera, and shines on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Spotlight {
    /// Angle around the vertical axis, radians.
    pub azimuth: f64,
    /// Angle from straight up, radians.
    pub zenith: f64,
    /// Distance from the centre, in radii of the bounding sphere; more than 1.
    pub distance: f64,
    /// What it shines on, model units; the centre of the mesh's bounds by default.
    pub target: Option<[f64; 3]>,
    /// Linear colour and intensity: the radiance that a white surface would have that faces it at the centre.
    pub color: [f32; 3],
    /// Half the angle of its cone, radians.
    pub cone: f64,
    /// The part of the cone, from its border inwards, over which it fades, 0 to 1.
    pub softness: f64,
}

impl Default for Spotlight {
    fn default() -> Self {
        Self {
            azimuth: 0.0,
            zenith: std::f64::consts::FRAC_PI_2,
            distance: 4.0,
            target: None,
            color: [1.0; 3],
            cone: 0.45,
            softness: 0.2,
        }
    }
}

/// Light from everywhere (Lam 2016, B.1.2.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Ambient {
    /// Its intensity L_A.
    pub intensity: f32,
    /// Irradiance by direction, as nine spherical harmonics a channel, already convolved with the cosine and divided by π: the sum is
    /// what a white surface reflects. In the order 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y², without further constants. A scene may
    /// name an environment map instead.
    pub irradiance: [[f32; 3]; 9],
}

impl Default for Ambient {
    /// A bright sky, a darker ground.
    fn default() -> Self {
        let mut irradiance = [[0.0; 3]; 9];
        irradiance[0] = [0.62, 0.62, 0.66];
        irradiance[1] = [0.26, 0.28, 0.34];
        Self { intensity: 0.35, irradiance }
    }
}

/// How shadows are looked up (Lam 2016, B.1.2.2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Shadows {
    /// Texels along a side of a shadow map, 16 to 8192.
    pub size: u32,
    /// Looks along a side of the filter, 1 to 9; each is one bilinear comparison.
    pub filter: u32,
}

impl Default for Shadows {
    fn default() -> Self {
        Self { size: 1024, filter: 3 }
    }
}

/// The skin (Lam 2016, B.1.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Skin {
    /// Albedo where there is no colour map, sRGB.
    pub albedo: [f32; 3],
    /// Specular intensity where there is no specular map.
    pub intensity: f32,
    /// Roughness m where there is no specular map.
    pub roughness: f32,
    /// What every specular intensity is multiplied by, k_spec.
    pub specular: f32,
    /// What the normal map's tangent and bitangent parts are multiplied by.
    pub bumpiness: f32,
    /// Reflectance at normal incidence, R₀; 0.028 between air and skin.
    pub reflectance: f32,
}

impl Default for Skin {
    fn default() -> Self {
        Self {
            albedo: [0.80, 0.62, 0.53],
            intensity: 0.6,
            roughness: 0.35,
            specular: 1.0,
            bumpiness: 1.0,
            reflectance: 0.028,
        }
    }
}

/// Which law transmittance follows with the thickness s (Lam 2016, B.2.2.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// Σ w exp(−s²/v): the published look.
    #[default]
    Published,
    /// Σ w exp(−s²/2v): what follows from the Gaussians.
    Derived,
}

/// How light scatters in skin (Lam 2016, B.2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Scattering {
    /// How far from its centre the kernel reaches on the surface, w, centimetres. With more than 19 samples it reaches half as far again.
    pub width_cm: f32,
    /// How much of the light scatters, t, a channel.
    pub strength: [f32; 3],
    /// How far it scatters, f, a channel.
    pub falloff: [f32; 3],
    /// Samples of the kernel, odd, 3 to 41.
    pub samples: u32,
    /// How much further than real light goes through, 0 to 1: the thickness is multiplied by 1 − translucency.
    pub translucency: f32,
    /// The law of transmittance.
    pub law: Law,
}

impl Default for Scattering {
    fn default() -> Self {
        Self {
            width_cm: 0.6,
            strength: [0.78, 0.70, 0.75],
            falloff: [0.57, 0.13, 0.08],
            samples: 9,
            translucency: 0.83,
            law: Law::Published,
        }
    }
}

/// By what distance a patch is laid on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Distance {
    /// Along the surface.
    #[default]
    Surface,
    /// In the texture, as the thesis does it: to compare with.
    Texture,
}

/// Fractional Brownian motion (Lam 2016, Snippet 5.2).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Fbm {
    /// How many noises are added, 1 to 16.
    pub octaves: u32,
    /// The first one's frequency.
    pub frequency: f32,
    /// The first one's height.
    pub amplitude: f32,
    /// What each frequency is multiplied by for the next.
    pub lacunarity: f32,
    /// What each height is multiplied by for the next.
    pub persistence: f32,
}

impl Default for Fbm {
    fn default() -> Self {
        Self { octaves: 4, frequency: 4.0, amplitude: 0.5, lacunarity: 2.0, persistence: 0.5 }
    }
}

/// What a cut paints (Lam 2016, §5.3 and §5.4).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Wound {
    /// The patch's inner layer, sRGB.
    pub inner: [f32; 3],
    /// The darker colour of its outer layer, sRGB.
    pub dark: [f32; 3],
    /// The lighter colour of its outer layer, sRGB.
    pub light: [f32; 3],
    /// Frequency and height of the noise at the inner layer's edge.
    pub edge: [f32; 2],
    /// The noise between the two.
    pub noise: Fbm,
    /// The least and the most that the discoloration leaves of each channel.
    pub discolor: [[f32; 2]; 3],
    /// The noise of the discoloration; its frequency is cycles across the colour map.
    pub blotches: Fbm,
    /// The inside of the cut from its rim to its bottom, at equal distances, sRGB.
    pub tissue: [[f32; 3]; 3],
    /// By what distance a patch is laid on the surface.
    pub distance: Distance,
}

impl Default for Wound {
    fn default() -> Self {
        Self {
            inner: [0.42, 0.05, 0.05],
            dark: [0.62, 0.22, 0.19],
            light: [0.80, 0.47, 0.40],
            edge: [4.0, 0.25],
            noise: Fbm::default(),
            discolor: [[0.85, 0.95], [0.60, 0.75], [0.60, 0.85]],
            blotches: Fbm { frequency: 32.0, ..Fbm::default() },
            tissue: [[0.74, 0.30, 0.25], [0.60, 0.10, 0.09], [0.36, 0.02, 0.03]],
            distance: Distance::Surface,
        }
    }
}

/// sRGB colour behind the model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Background(pub [f32; 3]);

impl Default for Background {
    fn default() -> Self {
        Self([0.13, 0.14, 0.16])
    }
}

impl Background {
    /// It as a texel of a picture.
    pub fn bytes(self) -> [u8; 4] {
        let [r, g, b] = self.0.map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u8);
        [r, g, b, 255]
    }
}

/// Which parts of the renderer are on (Lam 2016, §6.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Switches {
    /// Shadow maps.
    pub shadows: bool,
    /// Light that comes through.
    pub transmittance: bool,
    /// Specular reflection.
    pub specular: bool,
    /// Subsurface scattering.
    pub scattering: bool,
    /// Its local discoloration.
    pub discoloration: bool,
    /// The colour map; off, the skin's albedo, scattering in full.
    pub color_map: bool,
    /// The normal map; off, the surface's normals.
    pub normal_map: bool,
    /// The occlusion map; off, all ambient light arrives.
    pub occlusion_map: bool,
    /// The specular map; off, the skin's intensity and roughness.
    pub specular_map: bool,
}

impl Default for Switches {
    fn default() -> Self {
        Self {
            shadows: true,
            transmittance: true,
            specular: true,
            scattering: true,
            discoloration: true,
            color_map: true,
            normal_map: true,
            occlusion_map: true,
            specular_map: true,
        }
    }
}

//! The maps of the built-in meshes, made by code: the same bytes on every machine and with any number of threads.
//!
//! `texels` says which place of the surface each texel shows; what is painted there is a function of the place in space (`noise`,
//! `features`), so that no seam shows and the atlas may be anything. `skin` gives the bust's colour, scattering and shine, `relief` its
//! pores and wrinkles as normals, `occlusion` how open it is to the sky. The other meshes have the plain skin's colour alone.
//!
//! A mesh's atlas is the same at every number of faces, since faces are only ever halved. So one set of maps, made on a mesh of a
//! size of its own, fits them all.

mod features;
mod noise;
mod occlusion;
mod relief;
mod skin;
#[cfg(test)]
mod tests;
mod texels;

use occlusion::Openness;
use relief::Relief;
use skin::to_byte;
use texels::Texels;

use super::{BUST_FACES, boxes, bust, round};
use crate::canvas::image::Image;
use crate::mesh::{IndexedMesh, Mesh};

/// Faces of the sphere that its map is painted on.
const SPHERE_FACES: usize = 5_120;
/// Nothing is hidden so deep that no light at all gets there.
const LEAST_OPEN: f64 = 0.15;
/// Between the charts, beyond what any sample reaches.
const BLANK_NORMAL: [u8; 4] = [128, 128, 255, 255];
const BLANK_SPECULAR: [u8; 4] = [128, 97, 0, 255];

/// Which built-in meshes there are maps for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::assets) enum MapKind {
    Bust,
    Sphere,
    Slab,
    Torus,
    TwoFingers,
    Grid,
}

/// Maps made by code; what is missing is as on any mesh.
pub(in crate::assets) struct Painted {
    pub color: Image,
    pub normal: Option<Image>,
    pub occlusion: Option<Image>,
    pub specular: Option<Image>,
}

impl MapKind {
    /// By the name of a scene, with or without its number of faces.
    pub(in crate::assets) fn of(name: &str) -> Option<Self> {
        match name.split(':').next()? {
            "bust" => Some(Self::Bust),
            "sphere" => Some(Self::Sphere),
            "slab" => Some(Self::Slab),
            "torus" => Some(Self::Torus),
            "two-fingers" => Some(Self::TwoFingers),
            "grid" => Some(Self::Grid),
            _ => None,
        }
    }

    fn mesh(self) -> IndexedMesh {
        match self {
            Self::Bust => bust::bust(BUST_FACES),
            Self::Sphere => round::sphere(SPHERE_FACES),
            Self::Slab => boxes::slab(),
            Self::Torus => round::torus(),
            Self::TwoFingers => boxes::two_fingers(),
            Self::Grid => boxes::grid(),
        }
    }
}

/// Makes the maps of a mesh, with this many texels along a side.
pub(in crate::assets) fn paint(kind: MapKind, side: u32) -> Painted {
    let mesh = Mesh::build(&kind.mesh()).expect("the built-in meshes are manifold and oriented");
    let texels = Texels::new(&mesh, side);
    match kind {
        MapKind::Bust => paint_bust(&mesh, &texels),
        _ => {
            let [color] = texels.paint([skin::blank()], |site| [skin::plain(site.position)]);
            Painted { color, normal: None, occlusion: None, specular: None }
        }
    }
}

fn paint_bust(mesh: &Mesh, texels: &Texels<'_>) -> Painted {
    let relief = Relief::new(texels.texel_size());
    let openness = Openness::new(mesh);
    let blank = [skin::blank(), BLANK_NORMAL, [255; 4], BLANK_SPECULAR];
    let [color, normal, occlusion, specular] = texels.paint(blank, |site| {
        let open = to_byte(openness.at(site).max(LEAST_OPEN));
        let position = site.position;
        [skin::color(position), relief.texel(site), [open, open, open, 255], skin::specular(position)]
    });
    Painted { color, normal: Some(normal), occlusion: Some(occlusion), specular: Some(specular) }
}

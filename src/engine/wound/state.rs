//! What a run of the wound engine changes, and a cut on its way through the stages.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use super::camera::Camera;
use super::carve::Carved;
use super::event::{Mode, Pick, Value};
use super::merge::{Line, face_box};
use super::paint::Painted;
use super::patch::Patch;
use super::pick::Picked;
use super::plane::CutPlane;
use super::settings;
use super::settle::Formed;
use super::surface::SkinLink;
use super::view::{Bounds, Seen};
use crate::canvas::job::Painting;
use crate::canvas::look::Look;
use crate::geometry::bvh::Bvh;
use crate::mesh::refine::{Refined, Refinement};
use crate::mesh::{self, Face, FaceId, Mark, Mesh};

/// What a scene says to the engine, apart from the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Width and height of the view in pixels.
    pub viewport: [u32; 2],
    /// Centimetres in a model unit.
    pub unit_cm: f64,
    /// Pixels within which a pick moves to a node.
    pub snap_px: f64,
    /// Vertical field of view, radians.
    pub fov_y: f64,
    /// What the camera looks at, model units; the centre of the bounding box by default.
    pub target: Option<[f64; 3]>,
    /// Where the camera begins, radians.
    pub azimuth: f64,
    /// The same from straight up, radians.
    pub zenith: f64,
    /// Eye to target, model units; far enough to see everything by default.
    pub distance: Option<f64>,
    /// Light, skin and wounds.
    pub look: Look,
    /// Width and height of the colour map: what a wound patch's size is counted in.
    pub map_size: [u32; 2],
}

/// The small part of the state.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// Where one looks from.
    pub camera: Camera,
    /// How far cuts go.
    pub mode: Mode,
    /// A first click that waits for its second.
    pub pending: Option<[f64; 2]>,
    /// Settings that `set` events changed.
    pub settings: BTreeMap<String, Value>,
    /// What follows from the settings, shared until one changes.
    pub seen: Arc<Seen>,
}

/// Everything that a run changes.
#[derive(Clone, Debug)]
pub struct State {
    /// The mesh.
    pub mesh: Mesh,
    /// What the cuts painted on the maps, in order.
    pub paintings: Vec<Arc<Painting>>,
    /// The small part.
    pub control: Control,
    /// Made when the first pick or incision asks for it; follows every edit from then on.
    pub(super) bvh: Option<Bvh>,
    /// The largest coordinate of the mesh as it was loaded: what ulps are counted by.
    pub(super) largest: f64,
    pub(super) unit_cm: f64,
    /// Around the mesh as it was loaded: lights, depths and the point that positions are relative to never move.
    pub(super) bounds: Bounds,
    /// The scene's own look, shared by all states of a run.
    pub(super) look: Arc<Look>,
    pub(super) map_size: [u32; 2],
}

/// What a committed piece of work changed in the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    /// The mesh's part.
    pub mesh: mesh::Patch,
    /// What was painted.
    pub painting: Option<Arc<Painting>>,
}

impl State {
    /// A mesh in a scene, before anything happened to it.
    pub fn new(mesh: Mesh, scene: Scene) -> Self {
        let bounds = Bounds::of(&mesh);
        let distance = scene
            .distance
            .unwrap_or_else(|| Camera::fitting_distance(bounds.radius, scene.fov_y, scene.viewport));
        let camera = Camera {
            target: scene.target.map_or(bounds.centre, DVec3::from),
            azimuth: scene.azimuth,
            zenith: scene.zenith,
            distance,
            fov_y: scene.fov_y,
            viewport: scene.viewport,
        };
        let settings = settings::of_scene(&scene.look, scene.snap_px);
        let seen = Arc::new(Seen::new(&scene.look, bounds, &settings));
        let control = Control { camera, mode: Mode::default(), pending: None, settings, seen };
        Self {
            largest: mesh.largest_coordinate(),
            mesh,
            paintings: Vec::new(),
            control,
            bvh: None,
            unit_cm: scene.unit_cm,
            bounds,
            look: Arc::new(scene.look),
            map_size: scene.map_size,
        }
    }

    /// Changes settings, which have been validated.
    pub(super) fn set(&mut self, values: &BTreeMap<String, Value>) {
        let control = &mut self.control;
        control.settings.extend(values.iter().map(|(name, value)| (name.clone(), *value)));
        control.seen = Arc::new(Seen::new(&self.look, self.bounds, &control.settings));
    }

    pub(super) fn snap_px(&self) -> f64 {
        settings::number(&self.control.settings, "snap_px").unwrap_or(0.0)
    }

    /// The mesh and the hierarchy over its faces, which is made where it is missing.
    pub fn mesh_and_bvh(&mut self) -> (&Mesh, &Bvh) {
        let (mesh, bvh) = self.parts();
        (mesh, bvh)
    }

    /// The same, to be changed.
    pub(super) fn parts(&mut self) -> (&mut Mesh, &mut Bvh) {
        let mesh = &mut self.mesh;
        let bvh = self.bvh.get_or_insert_with(|| Bvh::build(mesh.face_count(), &|f| face_box(mesh, f)));
        (mesh, bvh)
    }

    /// Brings the hierarchy up to a mesh in which `faces` were changed, added, or taken away from the end.
    pub(super) fn follow(&mut self, faces: &[FaceId]) {
        let Some(bvh) = &mut self.bvh else { return };
        let mesh = &self.mesh;
        let bounds = |f: u32| face_box(mesh, f);
        let count = mesh.face_count();
        if bvh.len() > count {
            bvh.truncate(count, &bounds);
        }
        let known = bvh.len();
        bvh.update(faces.iter().map(|f| f.0).filter(|&f| (f as usize) < known), &bounds);
        for &face in faces.iter().filter(|f| (known..count).contains(&f.at())) {
            bvh.insert(near(mesh, face, bvh.len()), &bounds);
        }
    }
}

/// A neighbour of a face that comes before it and so is in the hierarchy already; any face where it has none.
fn near(mesh: &Mesh, face: FaceId, known: usize) -> u32 {
    let across = mesh.face(face).edges.into_iter().map(|e| mesh.edge(e).other_face(face));
    across.filter(|f| f.at() < known).min().map_or(known as u32 - 1, |f| f.0)
}

/// A piece of work for the stages.
#[derive(Debug)]
pub enum Work {
    /// A cut.
    Cut(Box<Cut>),
    /// A subdivision of a face.
    Subdivide {
        /// The face and how it is divided.
        plan: Refinement,
        /// What came of it.
        refined: Refined,
        /// The mesh before.
        before: Box<Before>,
    },
}

impl Work {
    /// What was painted.
    pub fn painting(&self) -> Option<&Arc<Painting>> {
        match self {
            Self::Cut(cut) => cut.painted.as_ref().map(|painted| &painted.painting),
            Self::Subdivide { .. } => None,
        }
    }
}

/// What checks need to know of the mesh before a stage.
#[derive(Clone, Debug, Default)]
pub struct Before {
    /// The moment in the mesh's journal.
    pub mark: Mark,
    /// V, E and F.
    pub counts: [usize; 3],
    /// The faces that were divided, as they were.
    pub parents: Vec<(Face, [DVec3; 3])>,
}

impl Before {
    pub(super) fn now(mesh: &Mesh) -> Self {
        let counts = [mesh.node_count(), mesh.edge_count(), mesh.face_count()];
        Self { mark: mesh.mark(), counts, parents: Vec::new() }
    }
}

/// A cut on its way through the stages.
#[derive(Debug)]
pub struct Cut {
    /// How far it goes.
    pub mode: Mode,
    /// What chance is drawn by.
    pub seed: u64,
    /// Why nothing is painted.
    pub unpainted: Option<&'static str>,
    /// The eye.
    pub eye: DVec3,
    /// What was asked for.
    pub picks: [Pick; 2],
    /// What the picks met.
    pub picked: Option<[Picked; 2]>,
    /// The cutting plane.
    pub plane: Option<CutPlane>,
    /// FC's line.
    pub formed: Formed,
    /// Arc length at the points of FC's line.
    pub arc: Vec<f64>,
    /// The parts of FC's line that lie in skin.
    pub links: Vec<SkinLink>,
    /// GP's patch.
    pub patch: Option<Patch>,
    /// What PP painted.
    pub painted: Option<Painted>,
    /// MC's line.
    pub line: Line,
    /// MC's children.
    pub refined: Refined,
    /// The mesh before MC.
    pub before_merge: Before,
    /// What CI did.
    pub carved: Carved,
    /// The mesh before CI.
    pub before_carve: Before,
}

//! What a run of the wound engine changes, and a cut on its way through the stages.

use std::collections::BTreeMap;

use glam::DVec3;

use super::camera::Camera;
use super::carve::Carved;
use super::event::{Mode, Pick, SETTINGS, Value};
use super::merge::{Line, face_box};
use super::pick::Picked;
use super::plane::CutPlane;
use super::settle::Formed;
use crate::geometry::bvh::Bvh;
use crate::mesh::refine::{Refined, Refinement};
use crate::mesh::{Face, FaceId, Mark, Mesh};

/// What a scene says to the engine, apart from the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

/// Everything that a run changes.
#[derive(Clone, Debug)]
pub struct State {
    /// The mesh.
    pub mesh: Mesh,
    /// The small part.
    pub control: Control,
    /// Made when the first pick or incision asks for it; follows every edit from then on.
    pub(super) bvh: Option<Bvh>,
    /// The largest coordinate of the mesh as it was loaded: what ulps are counted by.
    pub(super) largest: f64,
    pub(super) unit_cm: f64,
}

impl State {
    /// A mesh in a scene, before anything happened to it.
    pub fn new(mesh: Mesh, scene: Scene) -> Self {
        let [lo, hi] = mesh.bounds();
        let radius = (hi - lo).length() * 0.5;
        let distance =
            scene.distance.unwrap_or_else(|| Camera::fitting_distance(radius, scene.fov_y, scene.viewport));
        let camera = Camera {
            target: scene.target.map_or((lo + hi) * 0.5, DVec3::from),
            azimuth: scene.azimuth,
            zenith: scene.zenith,
            distance,
            fov_y: scene.fov_y,
            viewport: scene.viewport,
        };
        let defaults = SETTINGS.iter().map(|(name, value)| (name.to_string(), *value));
        let mut settings: BTreeMap<String, Value> = defaults.collect();
        settings.insert("snap_px".into(), Value::Number(scene.snap_px));
        let largest = mesh.largest_coordinate();
        let control = Control { camera, mode: Mode::default(), pending: None, settings };
        Self { mesh, control, bvh: None, largest, unit_cm: scene.unit_cm }
    }

    pub(super) fn snap_px(&self) -> f64 {
        match self.control.settings.get("snap_px") {
            Some(Value::Number(px)) => *px,
            _ => 0.0,
        }
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

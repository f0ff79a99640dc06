//! Picks against brute force: what the hierarchy finds is what a look at every face finds, before and after edits.
//!
//! The bytes become a few sheets of triangles over one another (`sheets`), on coordinates that are rounded hard, so that rays go through nodes and
//! along edges and sheets lie at one depth or an ulp apart; then rays and edits by turns. An edit is a cut or a subdivision as the engine
//! makes it, or its taking back: it adds faces to the hierarchy, moves some, and takes some away.
//!
//! Brute force is written apart: every face, exact signs alone, no parameter along the ray, no box. The rule is that of
//! [`crate::engine::wound::pick`]: the nearest face wins, by exact comparison, and of several at one place the one with the lowest id.

mod sheets;

use arbitrary::{Arbitrary, Result, Unstructured};
use glam::DVec3;

use super::{Finding, Hits, Outcome};
use crate::canvas::look::Look;
use crate::engine::wound::pick::cast;
use crate::engine::wound::{Edit, Pick, Scene, State, Wound, WoundEvent};
use crate::engine::{Engine, Part, Start};
use crate::measure::exact::first_face;
use crate::mesh::{EdgeId, FaceId, Mesh, NodeId};

/// Rays and edits of one input.
const MOST_STEPS: usize = 16;
/// Faces beyond which an input is not grown further: brute force looks at all of them for every ray.
const MOST_FACES: usize = 400;

pub(super) fn run(data: &[u8]) -> Outcome {
    let mut hits = Hits::default();
    let mut bytes = Unstructured::new(data);
    // Bytes that end early are no input, and no finding.
    let Ok(indexed) = sheets::sheets(&mut bytes) else { return Ok(hits) };
    let mesh = Mesh::build(&indexed).map_err(|e| Finding::new("sheets-are-a-mesh", e.to_string()))?;
    let mut run = Run { state: State::new(mesh, scene()), edits: Vec::new() };
    for _ in 0..MOST_STEPS {
        match run.step(&mut bytes, &mut hits) {
            Ok(result) => result?,
            Err(_) => break,
        }
    }
    Ok(hits)
}

fn scene() -> Scene {
    Scene {
        viewport: [64, 64],
        unit_cm: 1.0,
        snap_px: 0.0,
        fov_y: 0.6,
        target: None,
        azimuth: 0.0,
        zenith: std::f64::consts::FRAC_PI_2,
        distance: None,
        look: Look::default(),
        map_size: [64, 64],
    }
}

struct Run {
    state: State,
    edits: Vec<Edit>,
}

impl Run {
    /// A ray, or an edit.
    fn step(
        &mut self,
        bytes: &mut Unstructured<'_>,
        hits: &mut Hits,
    ) -> Result<std::result::Result<(), Box<Finding>>> {
        let kind = bytes.int_in_range(0..=7u8)?;
        if kind >= 3 {
            return Ok(self.look(sheets::ray(bytes, &self.state.mesh)?, hits));
        }
        let event = match kind {
            0 => WoundEvent::Cut { from: self.pick(bytes)?, to: self.pick(bytes)? },
            1 => WoundEvent::Subdivide { at: pixel(bytes)?, into: *bytes.choose(&[3, 4, 6])? },
            _ => WoundEvent::Undo {},
        };
        hits.note(self.edit(&event));
        Ok(Ok(()))
    }

    fn pick(&self, bytes: &mut Unstructured<'_>) -> Result<Pick> {
        let mesh = &self.state.mesh;
        let half = |bytes: &mut Unstructured<'_>| Ok(f64::from(bytes.int_in_range(0..=8u8)?) / 8.0);
        Ok(match bytes.int_in_range(0..=3u8)? {
            0 => Pick::Node(NodeId::of(bytes.choose_index(mesh.node_count())?)),
            1 => Pick::Edge(EdgeId::of(bytes.choose_index(mesh.edge_count())?), half(bytes)?),
            2 => Pick::Face(
                FaceId::of(bytes.choose_index(mesh.face_count())?),
                half(bytes)? / 2.0,
                half(bytes)? / 2.0,
            ),
            _ => Pick::Pixel(pixel(bytes)?),
        })
    }

    /// Runs an event as a session does; says what became of it.
    fn edit(&mut self, event: &WoundEvent) -> &'static str {
        if *event == (WoundEvent::Undo {}) {
            let Some(edit) = self.edits.pop() else { return "nothing to undo" };
            Wound::revert(&mut self.state, &edit);
            return "undone";
        }
        if self.state.mesh.face_count() > MOST_FACES {
            return "large enough";
        }
        let Start::Run(mut work) = Wound::start(&mut self.state, event, 0) else { return "not begun" };
        for stage in Wound::STAGES {
            let runs = (stage.part)(&work) == Part::Run;
            if runs && (stage.run)(&mut self.state, &mut work).is_err() {
                Wound::rollback(&mut self.state, &mut work);
                return "rejected";
            }
        }
        self.edits.push(Wound::commit(&mut self.state, &mut work));
        "applied"
    }

    /// A ray, by the hierarchy and by brute force.
    fn look(&mut self, [eye, through]: [DVec3; 2], hits: &mut Hits) -> std::result::Result<(), Box<Finding>> {
        let (mesh, bvh) = self.state.mesh_and_bvh();
        let found = cast(mesh, bvh, eye, through).map(|hit| hit.face);
        let (expected, level) = first_face(mesh, eye, through);
        hits.note(match (expected, level) {
            (None, _) => "miss",
            (Some(_), 1) => "hit",
            (Some(_), _) => "hits at one place",
        });
        if found == expected {
            return Ok(());
        }
        let name =
            |face: Option<FaceId>| face.map_or("nothing".into(), |f| format!("{f} {:?}", mesh.triangle(f)));
        let detail = format!(
            "from {eye:?} through {through:?}: the hierarchy finds {}, brute force {}",
            name(found),
            name(expected)
        );
        Err(Finding::new("pick-is-the-first", detail))
    }
}

fn pixel(bytes: &mut Unstructured<'_>) -> Result<[f64; 2]> {
    let quarter = |v: u8| f64::from(v) / 4.0;
    Ok([quarter(u8::arbitrary(bytes)?), quarter(u8::arbitrary(bytes)?)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Random;

    #[test]
    fn random_bytes_reach_everything_and_hold() {
        let mut hits = Hits::default();
        for i in 0..300 {
            let mut random = Random::of(5, i, "pick");
            let data: Vec<u8> = (0..600).map(|_| random.any() as u8).collect();
            hits.add(&run(&data).unwrap_or_else(|finding| panic!("{finding}")));
        }
        for reached in ["hit", "miss", "hits at one place", "applied", "undone", "rejected"] {
            assert!(hits.0.get(reached).is_some_and(|n| *n > 5), "{reached}: {hits:?}");
        }
    }
}

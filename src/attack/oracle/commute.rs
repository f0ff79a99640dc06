//! Cuts whose supports have nothing in common can be made in either order: the same faces at the same places, to the last bit, however they are
//! numbered.
//!
//! A cut's support is what it changed (the opening) and the faces beside that, what it added (the gutter), and the tissue that was looked at for it,
//! which is within a few depths.

use std::collections::BTreeSet;

use glam::DVec3;

use super::{Verdict, Witness, require};
use crate::attack::Hits;
use crate::attack::drive::{self, Ran};
use crate::engine::wound::{Pick, State, WoundEvent};
use crate::mesh::{Face, FaceId, Mesh, NodeId};
use crate::report::Outcome;

/// How far around a cut something may matter to it, in depths. Twice the depth is looked at for tissue.
const REACH: f64 = 3.0;

/// A cut that was applied, and the state before it.
pub(crate) struct Earlier {
    before: State,
    event: WoundEvent,
    seed: u64,
    support: Support,
}

struct Support {
    /// Nodes that were there before: changed, of a face that was, or beside one that was.
    nodes: BTreeSet<NodeId>,
    low: DVec3,
    high: DVec3,
}

impl Earlier {
    pub(crate) fn of(before: State, event: &WoundEvent, seed: u64, ran: &Ran, after: &State) -> Option<Self> {
        let support = Support::of(&before.mesh, &after.mesh, ran)?;
        Some(Self { before, event: event.clone(), seed, support })
    }
}

impl Support {
    fn of(before: &Mesh, after: &Mesh, ran: &Ran) -> Option<Self> {
        let (cut, edit) = (ran.applied()?, ran.edit.as_ref()?);
        let changed: BTreeSet<NodeId> = edit.mesh.nodes().collect();
        edit.mesh.faces().next()?;
        // A face beside one that changed says how far a node may move.
        let beside = |mesh: &Mesh| {
            let faces = (0..mesh.face_count()).map(FaceId::of).filter(|&f| mesh.has_face(f));
            let faces = faces.map(|f| mesh.face(f).nodes);
            let beside: Vec<[NodeId; 3]> = faces.filter(|n| n.iter().any(|n| changed.contains(n))).collect();
            beside.into_iter().flatten()
        };
        let of_faces = edit.mesh.faces().flat_map(|f| after.face(f).nodes);
        let all: BTreeSet<NodeId> = of_faces.chain(beside(after)).collect();
        let there = |n: &NodeId| before.has_node(*n);
        let nodes = all.iter().copied().chain(beside(before)).filter(there).collect();
        let at = || all.iter().map(|n| after.position(*n));
        let reach = DVec3::splat(REACH * cut.carved.depth);
        let low = at().fold(DVec3::INFINITY, DVec3::min) - reach;
        let high = at().fold(DVec3::NEG_INFINITY, DVec3::max) + reach;
        Some(Self { nodes, low, high })
    }

    fn is_apart(&self, other: &Self) -> bool {
        let boxes = self.low.cmpgt(other.high).any() || other.low.cmpgt(self.high).any();
        boxes && self.nodes.is_disjoint(&other.nodes)
    }
}

pub(super) fn look(witness: &Witness<'_>, hits: &mut Hits) -> Verdict {
    let Some(earlier) = witness.earlier else { return Ok(()) };
    let Some(support) = Support::of(&witness.before.mesh, &witness.after.mesh, witness.ran) else {
        return Ok(());
    };
    if !names_only(&earlier.before.mesh, witness.event) || !support.is_apart(&earlier.support) {
        return Ok(());
    }
    hits.note("oracle commute");
    let mut state = earlier.before.clone();
    state.control = witness.before.control.clone();
    let first = drive::run(&mut state, witness.event, witness.seed, None);
    state.control = earlier.before.control.clone();
    let second = drive::run(&mut state, &earlier.event, earlier.seed, None);
    let applied = [first.outcome, second.outcome] == [Outcome::Applied; 2];
    require(applied, "commute", || format!("the other way round: {}, {}", first.word(), second.word()))?;
    let (mine, theirs) = (geometry(&witness.after.mesh), geometry(&state.mesh));
    require(mine == theirs, "commute", || {
        let [here, there] = [only(&mine, &theirs), only(&theirs, &mine)];
        format!("the other way round it is another surface: {there}, and not {here}")
    })
}

/// The first face that is in one list and not in another.
fn only(of: &[Corners], other: &[Corners]) -> String {
    let first = of.iter().find(|corners| other.binary_search(corners).is_err());
    first.map_or("nothing".into(), |corners| {
        let at = corners.map(|corner| corner.map(f64::from_bits));
        format!("a face at {at:?}")
    })
}

/// Whether a cut's picks name nothing but what is there.
fn names_only(mesh: &Mesh, event: &WoundEvent) -> bool {
    let is_there = |pick: &Pick| match *pick {
        Pick::Node(n) => mesh.has_node(n),
        Pick::Edge(e, _) => mesh.has_edge(e),
        Pick::Face(f, ..) => mesh.has_face(f),
        Pick::Pixel(_) => false,
    };
    matches!(event, WoundEvent::Cut { from, to } if is_there(from) && is_there(to))
}

/// The bits of a face's corners.
type Corners = [[u64; 3]; 3];

/// The corners of every face, each beginning with its least, in order.
fn geometry(mesh: &Mesh) -> Vec<Corners> {
    let mut all: Vec<Corners> = mesh.faces().iter().map(|face| corners(mesh, face)).collect();
    all.sort_unstable();
    all
}

fn corners(mesh: &Mesh, face: &Face) -> Corners {
    let mut at = face.nodes.map(|n| mesh.position(n).to_array().map(f64::to_bits));
    let least = (0..3).min_by_key(|&i| at[i]).unwrap_or(0);
    at.rotate_left(least);
    at
}

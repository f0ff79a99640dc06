//! Whether a mesh is what it claims to be. Each check is small and returns where it failed.
//!
//! Local checks look at some faces and what hangs on them; [`whole`] looks at everything.

use glam::DVec3;

use super::{EdgeId, FaceId, Mesh, NodeId};

/// A place where the topology is broken, and how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// The element at fault, such as `f7`.
    pub element: String,
    /// What is wrong with it.
    pub what: String,
}

fn broken(element: impl ToString, what: impl Into<String>) -> Broken {
    Broken { element: element.to_string(), what: what.into() }
}

/// Looks at faces: corners differ, sides join them, every side knows the face, and each corner's fan holds the face.
pub fn around(mesh: &Mesh, faces: &[FaceId]) -> Result<(), Broken> {
    faces.iter().try_for_each(|&f| face(mesh, f))?;
    let mut nodes: Vec<NodeId> = faces.iter().flat_map(|&f| mesh.face(f).nodes).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let mut corners: Vec<(NodeId, FaceId)> =
        faces.iter().flat_map(|&f| mesh.face(f).nodes.map(|n| (n, f))).collect();
    corners.sort_unstable();
    nodes.into_iter().try_for_each(|n| fan(mesh, n, &corners))
}

/// Looks at everything: all faces, all edges, and that every node's faces are one fan.
pub fn whole(mesh: &Mesh) -> Result<(), Broken> {
    let faces: Vec<FaceId> = (0..mesh.face_count()).map(FaceId::of).collect();
    around(mesh, &faces)?;
    (0..mesh.edge_count()).map(EdgeId::of).try_for_each(|e| edge(mesh, e))?;
    let mut used = vec![false; mesh.node_count()];
    mesh.faces().iter().flat_map(|f| f.nodes).for_each(|n| used[n.at()] = true);
    match used.iter().position(|u| !u) {
        Some(n) => Err(broken(NodeId::of(n), "belongs to no face")),
        None => Ok(()),
    }
}

fn face(mesh: &Mesh, id: FaceId) -> Result<(), Broken> {
    let f = mesh.face(id);
    let [a, b, c] = f.nodes;
    if a == b || b == c || c == a {
        return Err(broken(id, "uses a node twice"));
    }
    if f.nodes.iter().any(|&n| !mesh.has_node(n)) || f.vertices.iter().any(|v| v.at() >= mesh.vertex_count())
    {
        return Err(broken(id, "names a node or vertex that does not exist"));
    }
    for side in 0..3 {
        let (from, to) = (f.nodes[side], f.nodes[(side + 1) % 3]);
        if !mesh.has_edge(f.edges[side]) {
            return Err(broken(id, "names an edge that does not exist"));
        }
        let e = mesh.edge(f.edges[side]);
        let direction = usize::from(e.nodes[0] != from);
        if e.nodes[direction] != from || e.nodes[1 - direction] != to {
            return Err(broken(id, format!("{} does not join its corners {from} and {to}", f.edges[side])));
        }
        if e.faces[direction] != id {
            return Err(broken(
                f.edges[side],
                format!("knows {} where {id} runs along it", e.faces[direction]),
            ));
        }
    }
    Ok(())
}

fn edge(mesh: &Mesh, id: EdgeId) -> Result<(), Broken> {
    let e = mesh.edge(id);
    if e.faces == [FaceId::NONE; 2] {
        return Err(broken(id, "has no face"));
    }
    for f in e.faces.into_iter().filter_map(FaceId::some) {
        if !mesh.has_face(f) || mesh.face(f).side(id).is_none() {
            return Err(broken(id, format!("knows {f}, which does not know it")));
        }
    }
    Ok(())
}

fn fan(mesh: &Mesh, node: NodeId, corners: &[(NodeId, FaceId)]) -> Result<(), Broken> {
    let start = corners.partition_point(|c| c.0 < node);
    let mine = corners[start..].iter().take_while(|c| c.0 == node);
    let anchor = mesh.anchor(node);
    if anchor == FaceId::NONE || !mesh.has_face(anchor) || mesh.face(anchor).corner(node).is_none() {
        return Err(broken(node, format!("is anchored at {anchor}, which it is no corner of")));
    }
    let mut reached: Vec<FaceId> = mesh.fan(node).map(|(f, _)| f).collect();
    reached.sort_unstable();
    match mine.map(|c| c.1).find(|f| reached.binary_search(f).is_err()) {
        Some(f) => Err(broken(node, format!("its fan does not reach {f}"))),
        None => Ok(()),
    }
}

/// V − E + F.
pub fn euler(mesh: &Mesh) -> i64 {
    mesh.node_count() as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64
}

/// Twice the vector area of a triangle.
pub fn doubled_area([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Six times the signed volume of the tetrahedron that a triangle spans with a point.
pub fn sixfold_volume(from: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    (a - from).dot((b - from).cross(c - from))
}

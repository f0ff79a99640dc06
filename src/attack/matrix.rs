//! Which configuration was met in which degenerate case, and how often.
//!
//! What counts is what the chain of an applied cut shows, not what a generator had in mind. A cell that can be reached and never is is a
//! failure of the generators; one that cannot be has its reason here, and if it is met all the same, the reason is wrong.

use std::collections::BTreeMap;

use serde::Serialize;

use super::oracle::Witness;
use super::trial::Look;
use super::{Finding, Hits, attempt, fusion};
use crate::engine::wound::Cut;
use crate::engine::wound::chain::At;
use crate::engine::wound::plane::CutPlane;
use crate::measure::Random;
use crate::mesh::{FaceId, Mesh, NodeId, Surface};
use crate::report::{Row, Table};

/// Where the two ends of a link can lie (Lam 2016, §4.2.1).
pub const CONFIGURATIONS: [&str; 9] = ["NN", "NE", "NF", "EN", "EE", "EF", "FN", "FE", "FF"];

/// How thin a face counts as a sliver: longest side over height.
const SLIVER: f64 = 1e6;
/// How near picks count as nearly equal, in largest coordinates.
const NEARLY: f64 = 1e-9;

/// A degenerate case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Degeneracy {
    /// None asked for.
    Any,
    /// The line goes on through a node at one of the link's ends.
    ThroughNode,
    /// The link runs along an edge.
    AlongEdge,
    /// A face at the link lies in the cutting plane.
    Coplanar,
    /// An end of the link lies on a seam.
    Seam,
    /// An end of the link lies on the boundary.
    Boundary,
    /// The link lies in the gutter of an earlier cut.
    Gutter,
    /// The link's face is a million times as long as high.
    Sliver,
    /// The two picks are the same but for the last few digits.
    NearPicks,
}

impl Degeneracy {
    /// All of them, in the order of the table's columns.
    pub const ALL: [Self; 9] = [
        Self::Any,
        Self::ThroughNode,
        Self::AlongEdge,
        Self::Coplanar,
        Self::Seam,
        Self::Boundary,
        Self::Gutter,
        Self::Sliver,
        Self::NearPicks,
    ];

    /// Head of its column.
    pub fn title(self) -> &'static str {
        match self {
            Self::Any => "any",
            Self::ThroughNode => "through a node",
            Self::AlongEdge => "along an edge",
            Self::Coplanar => "coplanar",
            Self::Seam => "on a seam",
            Self::Boundary => "at a boundary",
            Self::Gutter => "on a gutter",
            Self::Sliver => "sliver",
            Self::NearPicks => "near picks",
        }
    }

    /// Why a configuration cannot be met in this case.
    pub fn impossible(self, configuration: &str) -> Option<&'static str> {
        let has = |letter: char| configuration.contains(letter);
        match self {
            Self::ThroughNode if !has('N') => Some("neither end is a node"),
            Self::AlongEdge if has('F') => Some("a point inside of a face lies on no edge"),
            Self::Seam | Self::Boundary if configuration == "FF" => {
                Some("points inside of a face lie on no edge and no node")
            }
            _ => None,
        }
    }
}

/// A cell of the matrix, for reports.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Cell {
    /// Such as `NE`.
    pub configuration: &'static str,
    /// The degenerate case.
    pub degeneracy: Degeneracy,
    /// How often it was met.
    pub hits: u64,
    /// Why it cannot be met.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impossible: Option<&'static str>,
}

/// Hit counts of all cells.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Matrix {
    /// Row by row.
    pub cells: Vec<Cell>,
}

impl Matrix {
    /// The cells among what targets reached.
    pub fn of(hits: &Hits) -> Self {
        let cell = |configuration: &'static str, degeneracy: Degeneracy| Cell {
            configuration,
            degeneracy,
            hits: hits.0.get(&name(configuration, degeneracy)).copied().unwrap_or(0),
            impossible: degeneracy.impossible(configuration),
        };
        let rows = CONFIGURATIONS.into_iter().flat_map(|c| Degeneracy::ALL.map(|d| cell(c, d)));
        Self { cells: rows.collect() }
    }

    /// The cells that could be reached and were not.
    pub fn empty(&self) -> Vec<&Cell> {
        self.cells.iter().filter(|cell| cell.hits == 0 && cell.impossible.is_none()).collect()
    }

    /// The cells that were reached although they cannot be.
    pub fn wrong(&self) -> Vec<&Cell> {
        self.cells.iter().filter(|cell| cell.hits > 0 && cell.impossible.is_some()).collect()
    }

    /// For people: a dash for what cannot be, with the reasons below.
    pub fn tables(&self) -> Vec<Table> {
        vec![self.counts(), self.reasons()]
    }

    fn counts(&self) -> Table {
        let columns = std::iter::once("configuration").chain(Degeneracy::ALL.map(Degeneracy::title));
        let text = |cell: &Cell| match (cell.impossible, cell.hits) {
            (Some(_), 0) => "-".to_owned(),
            (_, hits) => hits.to_string(),
        };
        let rows = self.cells.chunks(Degeneracy::ALL.len());
        let row = |cells: &[Cell]| {
            std::iter::once(cells[0].configuration.to_owned()).chain(cells.iter().map(text)).collect()
        };
        table("Links met", columns, rows.map(row))
    }

    fn reasons(&self) -> Table {
        let mut reasons: BTreeMap<(Degeneracy, &str), Vec<&str>> = BTreeMap::new();
        for cell in &self.cells {
            if let Some(why) = cell.impossible {
                reasons.entry((cell.degeneracy, why)).or_default().push(cell.configuration);
            }
        }
        let row = |((case, why), which): ((Degeneracy, &str), Vec<&str>)| {
            vec![case.title().to_owned(), which.join(" "), why.to_owned()]
        };
        table(
            "Cannot be met",
            ["case", "configurations", "because"].into_iter(),
            reasons.into_iter().map(row),
        )
    }
}

fn table(
    title: &str,
    columns: impl Iterator<Item = &'static str>,
    rows: impl Iterator<Item = Vec<String>>,
) -> Table {
    let rows = rows.map(|cells| Row { ids: Vec::new(), cells }).collect();
    Table { title: title.into(), columns: columns.map(str::to_owned).collect(), rows }
}

fn name(configuration: &str, degeneracy: Degeneracy) -> String {
    format!("cell {configuration} {}", degeneracy.title())
}

/// Notes the cells that a cut reached, if it was applied.
pub(super) fn note(witness: &Witness<'_>, hits: &mut Hits) {
    let Some(cut) = witness.ran.applied() else { return };
    let (mesh, largest) = (&witness.before.mesh, witness.ground.mesh.largest_coordinate());
    let Some(seen) = Seen::new(mesh, cut, largest) else { return };
    for link in 0..cut.formed.chain.links.len() {
        let configuration = cut.formed.chain.configuration(link);
        let met = Degeneracy::ALL.into_iter().filter(|&case| seen.is_met(link, case));
        met.for_each(|case| hits.note(name(&configuration, case)));
    }
}

/// A cut's chain on the mesh before it was merged.
struct Seen<'a> {
    mesh: &'a Mesh,
    cut: &'a Cut,
    plane: &'a CutPlane,
    near_picks: bool,
}

impl<'a> Seen<'a> {
    fn new(mesh: &'a Mesh, cut: &'a Cut, largest: f64) -> Option<Self> {
        let [a, b] = cut.picked?.map(|picked| picked.point.position);
        Some(Self { mesh, cut, plane: cut.plane.as_ref()?, near_picks: a.distance(b) <= NEARLY * largest })
    }

    fn is_met(&self, link: usize, case: Degeneracy) -> bool {
        let chain = &self.cut.formed.chain;
        let face = chain.links[link].face;
        let ends = [link, link + 1].map(|i| chain.points[i].at);
        let last = chain.points.len() - 1;
        let goes_on = |i: usize| i > 0 && i < last && matches!(chain.points[i].at, At::Node(_));
        match case {
            Degeneracy::Any => true,
            Degeneracy::ThroughNode => goes_on(link) || goes_on(link + 1),
            Degeneracy::AlongEdge => chain.is_along_edge(self.mesh, link),
            Degeneracy::Coplanar => self.faces_at(link).iter().any(|&f| self.is_coplanar(f)),
            Degeneracy::Seam => ends.iter().any(|&at| self.is_on_seam(at)),
            Degeneracy::Boundary => ends.iter().any(|&at| self.is_on_boundary(at)),
            Degeneracy::Gutter => self.mesh.face(face).surface == Surface::Gutter,
            Degeneracy::Sliver => is_sliver(self.mesh.triangle(face)),
            Degeneracy::NearPicks => self.near_picks,
        }
    }

    /// The link's face, and the one across where it runs along an edge.
    fn faces_at(&self, link: usize) -> Vec<FaceId> {
        let chain = &self.cut.formed.chain;
        let face = chain.links[link].face;
        let [a, b] = [link, link + 1].map(|i| chain.points[i].at);
        let edge = crate::engine::wound::chain::common_edge(self.mesh, face, a, b);
        let across = edge.and_then(|e| self.mesh.edge(e).other_face(face).some());
        std::iter::once(face).chain(across).collect()
    }

    fn is_coplanar(&self, face: FaceId) -> bool {
        self.mesh.face(face).nodes.iter().all(|&n| self.plane.side(self.mesh.position(n)).is_eq())
    }

    /// On a seam of the skin: the rim of a gutter is one of the texture as well, and has a column of its own.
    fn is_on_seam(&self, at: At) -> bool {
        let is_skin = |f: FaceId| f == FaceId::NONE || self.mesh.face(f).surface == Surface::Skin;
        let is_seam = |e: &crate::mesh::Edge| self.mesh.is_seam(e) && e.faces.into_iter().all(is_skin);
        match at {
            At::Node(n) => self.edges_around(n).any(|e| is_seam(&e)),
            At::Edge(e) => is_seam(&self.mesh.edge(e)),
            At::Face(_) => false,
        }
    }

    fn is_on_boundary(&self, at: At) -> bool {
        match at {
            At::Node(n) => self.mesh.is_boundary_node(n),
            At::Edge(e) => self.mesh.edge(e).is_boundary(),
            At::Face(_) => false,
        }
    }

    fn edges_around(&self, node: NodeId) -> impl Iterator<Item = crate::mesh::Edge> {
        let edges = self.mesh.fan(node).flat_map(|(f, _)| self.mesh.face(f).edges);
        edges.map(|e| self.mesh.edge(e)).filter(move |e| e.nodes.contains(&node))
    }
}

fn is_sliver([a, b, c]: [glam::DVec3; 3]) -> bool {
    let sides = [a.distance(b), b.distance(c), c.distance(a)];
    let longest = sides.into_iter().fold(0.0, f64::max);
    // Height is area over side.
    longest * longest >= SLIVER * (b - a).cross(c - a).length()
}

/// Draws so many inputs of the target `fusion`, and says what they reach. No oracle looks at them.
pub fn sweep(seed: u64, inputs: usize) -> Result<Hits, Box<Finding>> {
    let mut hits = Hits::default();
    for part in 0..inputs as u64 {
        let mut random = Random::of(seed, part, "matrix");
        let bytes: Vec<u8> = (0..fusion::BYTES).map(|_| random.any() as u8).collect();
        hits.add(&attempt(|| fusion::look(&bytes, Look::Cells))?);
    }
    Ok(hits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_that_can_be_reached_is_and_no_other() {
        let matrix = Matrix::of(&sweep(1, 4_000).expect("no finding"));
        assert_eq!(matrix.empty(), Vec::<&Cell>::new());
        assert_eq!(matrix.wrong(), Vec::<&Cell>::new());
        let [counts, reasons] = &matrix.tables()[..] else { panic!("two tables") };
        assert_eq!((counts.rows.len(), counts.columns.len(), reasons.rows.len()), (9, 10, 4));
    }
}

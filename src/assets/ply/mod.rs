//! PLY (Stanford polygon file), ASCII and binary of both byte orders.
//!
//! Read: of element `vertex` the properties x, y, z and, where there are any, texture coordinates (s, t; u, v; texture_u,
//! texture_v; texture_s, texture_t); of element `face` the list `vertex_indices` (or `vertex_index`) and the list `texcoord` of two numbers a corner, which comes
//! before the vertices' own. Everything else is stepped over. Other carriers of faces (`tristrips`) are refused.
//!
//! A count in the header promises nothing: no more is allocated than the bytes that are left can hold.

mod body;
mod header;

use glam::{DVec3, Vec2};

use super::error::{Fault, FaultKind, Place};
use super::soup::{NO_UV, Polygons, Soup, Unit};
use body::{Body, Row};
use header::{Element, Header};

/// Pairs of names under which texture coordinates are found, the usual ones first.
const UV_NAMES: [[&str; 2]; 4] =
    [["s", "t"], ["u", "v"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];

/// Reads a PLY file.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, Fault> {
    let (header, start, line) = header::parse(bytes)?;
    let mut body = Body::new(bytes, start, line, header.encoding);
    let mut found = Found::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => found.read_vertices(&mut body, element)?,
            "face" => found.read_faces(&mut body, element)?,
            "tristrips" => {
                return Err(Fault::whole(
                    FaultKind::Unsupported,
                    "faces as triangle strips are not supported",
                ));
            }
            _ => body.rows(element, |_, _| Ok(()))?,
        }
    }
    found.finish(&header)
}

#[derive(Default)]
struct Found {
    positions: Vec<DVec3>,
    /// One for each node, or none at all.
    node_uvs: Vec<Vec2>,
    /// Those of the faces' corners.
    corner_uvs: Vec<Vec2>,
    polygons: Polygons,
}

impl Found {
    fn read_vertices(&mut self, body: &mut Body<'_>, element: &Element) -> Result<(), Fault> {
        let [x, y, z] = ["x", "y", "z"].map(|name| element.scalar(name));
        let (Some(x), Some(y), Some(z)) = (x, y, z) else {
            return Err(Fault::whole(FaultKind::Syntax, "element vertex has no x, y and z"));
        };
        let uv = UV_NAMES.iter().find_map(|[u, v]| element.scalar(u).zip(element.scalar(v)));
        self.positions.reserve(body.plausible(element));
        body.rows(element, |row, _| {
            self.positions.push(DVec3::new(row.scalar(x), row.scalar(y), row.scalar(z)) + DVec3::ZERO);
            if let Some((u, v)) = uv {
                self.node_uvs.push(Vec2::new(row.scalar(u) as f32, row.scalar(v) as f32) + Vec2::ZERO);
            }
            Ok(())
        })
    }

    fn read_faces(&mut self, body: &mut Body<'_>, element: &Element) -> Result<(), Fault> {
        let Some(nodes) = element.list("vertex_indices").or_else(|| element.list("vertex_index")) else {
            return Err(Fault::whole(FaultKind::Syntax, "element face has no list vertex_indices"));
        };
        let uvs = element.list("texcoord");
        let mut number = 0;
        body.rows(element, |row, _| {
            self.face(row, number, nodes, uvs)
                .map_err(|(kind, detail)| Fault::new(Place::Face(number.into()), kind, detail))?;
            number = number.saturating_add(1);
            Ok(())
        })
    }

    fn face(
        &mut self,
        row: &Row,
        number: u32,
        nodes: usize,
        uvs: Option<usize>,
    ) -> Result<(), (FaultKind, String)> {
        let (corners, uvs) = (row.list(nodes), uvs.map_or(&[][..], |i| row.list(i)));
        if corners.len() < 3 {
            return Err((
                FaultKind::Syntax,
                format!("a face needs three corners, this one has {}", corners.len()),
            ));
        }
        let own = !uvs.is_empty();
        if own && uvs.len() != 2 * corners.len() {
            let detail = format!("{} numbers in texcoord for {} corners", uvs.len(), corners.len());
            return Err((FaultKind::Syntax, detail));
        }
        let pairs = uvs.as_chunks::<2>().0;
        for (at, &corner) in corners.iter().enumerate() {
            let uv = if own { self.corner_uvs.len() as u32 } else { NO_UV };
            self.polygons.corners.push([index(corner)?, uv]);
            self.corner_uvs.extend(pairs.get(at).map(|p| Vec2::new(p[0] as f32, p[1] as f32) + Vec2::ZERO));
        }
        self.polygons.close(number);
        Ok(())
    }

    fn finish(mut self, header: &Header) -> Result<Soup, Fault> {
        if header.elements.iter().all(|e| e.name != "vertex") {
            return Err(Fault::whole(FaultKind::Syntax, "there is no element vertex"));
        }
        if !self.node_uvs.is_empty() && self.corner_uvs.is_empty() {
            self.polygons.corners.iter_mut().for_each(|c| c[1] = c[0]);
            self.corner_uvs = self.node_uvs;
        }
        Soup::new(self.positions, self.corner_uvs, &self.polygons, Unit::Face)
    }
}

/// A corner's number as a node.
fn index(value: f64) -> Result<u32, (FaultKind, String)> {
    let whole = value >= 0.0 && value < f64::from(u32::MAX) && value.trunc() == value;
    if whole {
        Ok(value as u32)
    } else {
        Err((FaultKind::Index, format!("{value} is not the number of a node")))
    }
}

#[cfg(test)]
mod tests;

//! Wavefront OBJ, as written in the 1990s and as written since.
//!
//! Read: `v` (three numbers; a weight or a colour after them is ignored), `vt`, and `f` with polygons of any size, in all four forms
//! of a corner (`7`, `7/2`, `7//5`, `7/2/5`), with indices from the front or, negative, from the end so far. Comments, CRLF,
//! tabs and lines continued by `\` are fine. Every number is read to the nearest float, so that a file written by [`super::export`] comes back
//! bit for bit. Groups, objects, materials, smoothing, lines and points are passed over, and so are the file's normals: [`crate::mesh::Mesh::build`]
//! averages its own, which follow every cut.
//!
//! One pass over the bytes, with a cursor that knows its line; polygons are cut up afterwards, since OBJ lets a face stand before its nodes.

mod cursor;

use glam::{DVec3, Vec2};

use super::Note;
use super::error::{Fault, FaultKind};
use super::soup::{NO_UV, Polygons, Soup, Unit};
use crate::report::quoted;
use cursor::Cursor;

/// Statements that say nothing about nodes, texture coordinates or faces.
const PASSED_OVER: &[&[u8]] = &[
    b"vn",
    b"vp",
    b"g",
    b"o",
    b"s",
    b"usemtl",
    b"mtllib",
    b"l",
    b"p",
    b"mg",
    b"lod",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"usemap",
    b"maplib",
    b"shadow_obj",
    b"trace_obj",
];

/// Reads an OBJ file.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, Fault> {
    let mut reader = Reader::new(bytes);
    while let Some(keyword) = reader.cursor.keyword() {
        reader.statement(keyword)?;
    }
    let mut soup = Soup::new(reader.positions, reader.uvs, &reader.polygons, Unit::Line)?;
    soup.notes.extend(reader.unknown);
    Ok(soup)
}

struct Reader<'a> {
    cursor: Cursor<'a>,
    positions: Vec<DVec3>,
    uvs: Vec<Vec2>,
    polygons: Polygons,
    unknown: Option<Note>,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        // A node takes some 30 bytes, a face as many, and there are twice as many faces.
        let guess = bytes.len() / 128;
        let polygons =
            Polygons { corners: Vec::with_capacity(6 * guess), ends: Vec::with_capacity(2 * guess) };
        let (positions, uvs) = (Vec::with_capacity(guess), Vec::new());
        Self { cursor: Cursor::new(bytes), positions, uvs, polygons, unknown: None }
    }

    fn statement(&mut self, keyword: &[u8]) -> Result<(), Fault> {
        match keyword {
            b"v" => self.node()?,
            b"vt" => self.texture_coordinate()?,
            b"f" => self.face()?,
            _ => {
                if !PASSED_OVER.contains(&keyword) {
                    self.note_unknown(keyword);
                }
                self.cursor.skip_statement();
            }
        }
        Ok(())
    }

    fn node(&mut self) -> Result<(), Fault> {
        let [x, y, z] = [self.cursor.number()?, self.cursor.number()?, self.cursor.number()?];
        // Adding +0 turns −0 into 0.
        self.positions.push(DVec3::new(x, y, z) + DVec3::ZERO);
        self.rest_of_numbers(5)
    }

    fn texture_coordinate(&mut self) -> Result<(), Fault> {
        let u: f32 = self.cursor.number()?;
        let v: f32 = if self.cursor.at_end() { 0.0 } else { self.cursor.number()? };
        self.uvs.push(Vec2::new(u, v) + Vec2::ZERO);
        self.rest_of_numbers(1)
    }

    /// Weight and colour: they must be numbers, and no more than so many.
    fn rest_of_numbers(&mut self, most: usize) -> Result<(), Fault> {
        for _ in 0..most {
            if self.cursor.at_end() {
                break;
            }
            self.cursor.number::<f64>()?;
        }
        self.cursor.end()
    }

    fn face(&mut self) -> Result<(), Fault> {
        let (line, first) = (self.cursor.line, self.polygons.corners.len());
        while !self.cursor.at_end() {
            let corner = self.corner()?;
            self.polygons.corners.push(corner);
        }
        let corners = self.polygons.corners.len() - first;
        if corners < 3 {
            let detail = format!("a face needs three corners, this one has {corners}");
            return Err(Fault::line(line, FaultKind::Syntax, detail));
        }
        self.polygons.close(u32::try_from(line).unwrap_or(u32::MAX));
        self.cursor.end()
    }

    fn corner(&mut self) -> Result<[u32; 2], Fault> {
        let node = self.cursor.integer()?;
        let node = self.resolve(node, self.positions.len())?;
        let mut uv = NO_UV;
        if self.cursor.take(b'/') {
            if !self.cursor.at_slash_or_blank() {
                let index = self.cursor.integer()?;
                uv = self.resolve(index, self.uvs.len())?;
            }
            if self.cursor.take(b'/') && !self.cursor.at_slash_or_blank() {
                self.cursor.integer()?;
            }
        }
        self.cursor.end_of_word()?;
        Ok([node, uv])
    }

    /// From an index as written, 1 for the first and −1 for the last so far, to one from 0.
    fn resolve(&self, index: i64, so_far: usize) -> Result<u32, Fault> {
        let zero_based = if index < 0 { so_far as i64 + index } else { index - 1 };
        u32::try_from(zero_based).ok().filter(|&i| i != NO_UV).ok_or_else(|| {
            let detail =
                format!("index {index} names nothing, there are {so_far} so far and they count from 1");
            Fault::line(self.cursor.line, FaultKind::Index, detail)
        })
    }

    fn note_unknown(&mut self, keyword: &[u8]) {
        let line = self.cursor.line;
        let note = self.unknown.get_or_insert_with(|| {
            let word = String::from_utf8_lossy(&keyword[..keyword.len().min(20)]);
            Note::new(
                "statement-unknown",
                0,
                format!("statements passed over, the first at line {line}: {}", quoted(word)),
            )
        });
        note.count += 1;
    }
}

#[cfg(test)]
mod tests;

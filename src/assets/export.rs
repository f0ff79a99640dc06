//! Meshes written out, with texture coordinates.
//!
//! Numbers are written so that reading them gives the same floats: the shortest decimal in OBJ, the bits in PLY. −0 becomes 0, as it
//! does when reading. Nodes and faces keep their order, so their numbers are their ids.
//!
//! - OBJ has `v` for each node, `vt` for each vertex; where the surface changes, `g` and `usemtl` (`skin`, `gutter`) split the faces.
//! - PLY (binary, little-endian) has an element `vertex` for each node and lists `texcoord` on the faces, so that seams
//!   survive without nodes being doubled, and a property `surface` (0 skin, 1 gutter). What it cannot say is that nodes at one place are two, as on
//!   the sides of a cut that stayed closed: whoever reads it welds them.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::error::{AssetError, Fault, FaultKind};
use super::source::Format;
use crate::mesh::{Face, Mesh, Surface};

/// Writes a mesh to a file, in the format that its name ends in.
pub fn save(mesh: &Mesh, path: &Path) -> Result<(), AssetError> {
    let write: fn(&Mesh, &mut BufWriter<File>) -> io::Result<()> = match Format::of(path) {
        Some(Format::Obj) => write_obj,
        Some(Format::Ply) => write_ply,
        _ => {
            let detail = "meshes are written as .obj or .ply";
            return Err(Fault::whole(FaultKind::Unsupported, detail).in_file(path));
        }
    };
    let done = File::create(path).map(BufWriter::new).and_then(|mut out| {
        write(mesh, &mut out)?;
        out.flush()
    });
    done.map_err(|error| AssetError::io(path, &error))
}

/// Writes a mesh as OBJ.
pub fn write_obj(mesh: &Mesh, out: &mut impl Write) -> io::Result<()> {
    for p in mesh.positions() {
        let [x, y, z] = p.to_array().map(|v| v + 0.0);
        writeln!(out, "v {x:?} {y:?} {z:?}")?;
    }
    if mesh.is_textured() {
        for v in mesh.vertices() {
            writeln!(out, "vt {:?} {:?}", v.uv.x + 0.0, v.uv.y + 0.0)?;
        }
    }
    let mut surface = None;
    for face in mesh.faces() {
        if surface.replace(face.surface) != Some(face.surface) {
            let name = surface_name(face.surface);
            writeln!(out, "g {name}\nusemtl {name}")?;
        }
        write_obj_face(face, mesh.is_textured(), out)?;
    }
    Ok(())
}

fn surface_name(surface: Surface) -> &'static str {
    match surface {
        Surface::Skin => "skin",
        Surface::Gutter => "gutter",
    }
}

fn write_obj_face(face: &Face, textured: bool, out: &mut impl Write) -> io::Result<()> {
    let ([a, b, c], [u, v, w]) = (face.nodes.map(|n| n.at() + 1), face.vertices.map(|v| v.at() + 1));
    if textured { writeln!(out, "f {a}/{u} {b}/{v} {c}/{w}") } else { writeln!(out, "f {a} {b} {c}") }
}

/// Writes a mesh as binary PLY.
pub fn write_ply(mesh: &Mesh, out: &mut impl Write) -> io::Result<()> {
    write_ply_header(mesh, out)?;
    for p in mesh.positions() {
        p.to_array().iter().try_for_each(|v| out.write_all(&(v + 0.0).to_le_bytes()))?;
    }
    for face in mesh.faces() {
        out.write_all(&[3])?;
        face.nodes.iter().try_for_each(|n| out.write_all(&n.0.to_le_bytes()))?;
        if mesh.is_textured() {
            out.write_all(&[6])?;
            let uvs = face.vertices.iter().flat_map(|&v| mesh.vertex(v).uv.to_array());
            uvs.into_iter().try_for_each(|v| out.write_all(&(v + 0.0).to_le_bytes()))?;
        }
        out.write_all(&[face.surface as u8])?;
    }
    Ok(())
}

fn write_ply_header(mesh: &Mesh, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {}", mesh.node_count())?;
    writeln!(out, "property double x\nproperty double y\nproperty double z")?;
    writeln!(out, "element face {}\nproperty list uchar uint vertex_indices", mesh.face_count())?;
    if mesh.is_textured() {
        writeln!(out, "property list uchar float texcoord")?;
    }
    writeln!(out, "property uchar surface\nend_header")
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec2};

    use super::*;
    use crate::assets::repair;
    use crate::assets::weld::Rule;
    use crate::assets::{obj, ply};
    use crate::mesh::IndexedMesh;

    /// A tetrahedron with awkward coordinates, a seam and a gutter.
    fn sample(textured: bool) -> Mesh {
        let third = 1.0 / 3.0;
        let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let uvs =
            vec![Vec2::new(0.1, 0.2), Vec2::new(1.0e-30, 0.7), Vec2::new(0.3, 1.0e30), Vec2::new(0.9, 0.9)];
        let mut face_uvs = faces.clone();
        face_uvs[3] = [3, 3, 0];
        let mesh = IndexedMesh {
            positions: vec![
                DVec3::ZERO,
                DVec3::new(third, 1e-300, -0.0),
                DVec3::new(0.1, 1.0 + f64::EPSILON, 4.9e-324),
                DVec3::new(0.2, 0.3, 1e22),
            ],
            faces,
            uvs: if textured { uvs } else { Vec::new() },
            face_uvs: if textured { face_uvs } else { Vec::new() },
            surfaces: vec![Surface::Skin, Surface::Gutter, Surface::Gutter, Surface::Skin],
        };
        Mesh::build(&mesh).expect("a tetrahedron")
    }

    fn bits(mesh: &Mesh) -> Vec<[u64; 3]> {
        mesh.positions().iter().map(|p| p.to_array().map(|v| (v + 0.0).to_bits())).collect()
    }

    fn corner_uvs(mesh: &Mesh) -> Vec<[Vec2; 3]> {
        mesh.faces().iter().map(|f| f.vertices.map(|v| mesh.vertex(v).uv)).collect()
    }

    #[test]
    fn obj_and_ply_come_back_bit_for_bit() {
        for textured in [false, true] {
            let mesh = sample(textured);
            let (mut as_obj, mut as_ply) = (Vec::new(), Vec::new());
            write_obj(&mesh, &mut as_obj).expect("to memory");
            write_ply(&mesh, &mut as_ply).expect("to memory");
            let soups = [(obj::read(&as_obj), Rule::Own), (ply::read(&as_ply), Rule::Position)];
            for (soup, rule) in soups {
                let (back, notes) = repair::build(soup.expect("readable"), rule).expect("a mesh");
                assert_eq!((bits(&back), notes), (bits(&mesh), Vec::new()));
                assert_eq!(corner_uvs(&back), corner_uvs(&mesh));
                let nodes = |m: &Mesh| m.faces().iter().map(|f| f.nodes).collect::<Vec<_>>();
                assert_eq!((nodes(&back), back.edges()), (nodes(&mesh), mesh.edges()));
            }
        }
    }

    #[test]
    fn obj_splits_the_faces_by_surface() {
        let mut text = Vec::new();
        write_obj(&sample(false), &mut text).expect("to memory");
        let text = String::from_utf8(text).expect("text");
        let marks: Vec<_> = text.lines().filter(|l| l.starts_with("usemtl") || l.starts_with('f')).collect();
        assert_eq!(
            marks,
            ["usemtl skin", "f 1 3 2", "usemtl gutter", "f 1 2 4", "f 2 3 4", "usemtl skin", "f 3 1 4"]
        );
    }
}

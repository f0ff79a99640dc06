//! The bytes of a mesh file, all of them: a glTF may keep its buffers in files of their own.

use std::path::{Path, PathBuf};

use super::error::{AssetError, Fault, FaultKind};
use super::files::read_file;
use super::repair;
use super::soup::Soup;
use super::weld::Rule;
use super::{Note, obj, ply};
use crate::mesh::Mesh;

/// A format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    Ply,
    Gltf,
}

impl Format {
    /// By the end of a file's name.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let end = path.extension()?.to_str()?.to_ascii_lowercase();
        match end.as_str() {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }
}

/// Whether a file is a mesh, by its name.
pub fn is_mesh(path: &Path) -> bool {
    Format::of(path).is_some()
}

/// A mesh file in memory.
#[derive(Debug)]
pub(super) struct Source {
    path: PathBuf,
    pub(super) format: Format,
    bytes: Vec<u8>,
    /// What the buffers of a glTF hold, by index.
    buffers: Vec<Vec<u8>>,
}

impl Source {
    /// Reads a file, and those that it names.
    pub(super) fn read(path: &Path) -> Result<Self, AssetError> {
        let format = Format::of(path).ok_or_else(|| {
            Fault::whole(FaultKind::Unsupported, "a mesh file ends in .obj, .ply, .gltf or .glb")
                .in_file(path)
        })?;
        let bytes = read_file(path)?;
        let buffers = if format == Format::Gltf { read_buffers(path, &bytes)? } else { Vec::new() };
        Ok(Self { path: path.to_path_buf(), format, bytes, buffers })
    }

    /// blake3 of the file; of a glTF with buffers, of these as well, each with its length in front.
    pub(super) fn hash(&self) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&self.bytes);
        for buffer in &self.buffers {
            hasher.update(&(buffer.len() as u64).to_le_bytes());
            hasher.update(buffer);
        }
        *hasher.finalize().as_bytes()
    }

    /// Makes the mesh, and says what was changed on the way.
    pub(super) fn build(self) -> Result<(Mesh, Vec<Note>), AssetError> {
        let rule = if self.format == Format::Obj { Rule::Own } else { Rule::Position };
        let soup = self.parse().map_err(|fault| fault.in_file(&self.path))?;
        let Self { path, bytes, buffers, .. } = self;
        drop((bytes, buffers));
        repair::build(soup, rule).map_err(|fault| fault.in_file(&path))
    }

    fn parse(&self) -> Result<Soup, Fault> {
        match self.format {
            Format::Obj => obj::read(&self.bytes),
            Format::Ply => ply::read(&self.bytes),
            Format::Gltf => parse_gltf(&self.bytes, &self.buffers),
        }
    }
}

/// The buffers that a glTF names. Their paths are relative to it and may lead anywhere that the user may read.
#[cfg(feature = "gltf")]
fn read_buffers(path: &Path, bytes: &[u8]) -> Result<Vec<Vec<u8>>, AssetError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let uris = super::gltf::buffer_uris(bytes).map_err(|fault| fault.in_file(path))?;
    let load = |uri: super::gltf::Uri| match uri {
        super::gltf::Uri::Data(data) => Ok(data),
        super::gltf::Uri::File(name) => read_file(&folder.join(name)),
    };
    uris.into_iter().map(load).collect()
}

#[cfg(not(feature = "gltf"))]
fn read_buffers(path: &Path, _: &[u8]) -> Result<Vec<Vec<u8>>, AssetError> {
    Err(without_gltf().in_file(path))
}

#[cfg(feature = "gltf")]
fn parse_gltf(bytes: &[u8], buffers: &[Vec<u8>]) -> Result<Soup, Fault> {
    super::gltf::read(bytes, buffers)
}

#[cfg(not(feature = "gltf"))]
fn parse_gltf(_: &[u8], _: &[Vec<u8>]) -> Result<Soup, Fault> {
    Err(without_gltf())
}

#[cfg(not(feature = "gltf"))]
fn without_gltf() -> Fault {
    Fault::whole(FaultKind::Unsupported, "this program was built without the feature `gltf`")
}

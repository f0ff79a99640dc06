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
        let format = format_of(path)?;
        Self::with_files(path, format, read_file(path)?, read_file)
    }

    /// The same of bytes that are no file: those of others cannot be had.
    pub(super) fn of_bytes(name: &Path, bytes: Vec<u8>) -> Result<Self, AssetError> {
        let none = |other: &Path| {
            let detail = format!("it names the file {}, and none is opened", other.display());
            Err(Fault::whole(FaultKind::Unsupported, detail).in_file(name))
        };
        Self::with_files(name, format_of(name)?, bytes, none)
    }

    fn with_files(
        path: &Path,
        format: Format,
        bytes: Vec<u8>,
        load: impl Fn(&Path) -> Result<Vec<u8>, AssetError>,
    ) -> Result<Self, AssetError> {
        let buffers = if format == Format::Gltf { read_buffers(path, &bytes, load)? } else { Vec::new() };
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

/// The mesh in a file's bytes, repaired where need be, with what was changed. Its format is that of the name; nothing is opened, so a glTF that
/// names other files is refused.
pub fn read_mesh(name: &Path, bytes: &[u8]) -> Result<(Mesh, Vec<Note>), AssetError> {
    Source::of_bytes(name, bytes.to_vec())?.build()
}

fn format_of(path: &Path) -> Result<Format, AssetError> {
    let detail = "a mesh file ends in .obj, .ply, .gltf or .glb";
    Format::of(path).ok_or_else(|| Fault::whole(FaultKind::Unsupported, detail).in_file(path))
}

/// The buffers that a glTF names. Their paths are relative to it and may lead anywhere that the user may read.
#[cfg(feature = "gltf")]
fn read_buffers(
    path: &Path,
    bytes: &[u8],
    load: impl Fn(&Path) -> Result<Vec<u8>, AssetError>,
) -> Result<Vec<Vec<u8>>, AssetError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let uris = super::gltf::buffer_uris(bytes).map_err(|fault| fault.in_file(path))?;
    let bytes_of = |uri: super::gltf::Uri| match uri {
        super::gltf::Uri::Data(data) => Ok(data),
        super::gltf::Uri::File(name) => load(&folder.join(name)),
    };
    uris.into_iter().map(bytes_of).collect()
}

#[cfg(not(feature = "gltf"))]
fn read_buffers(
    path: &Path,
    _: &[u8],
    _: impl Fn(&Path) -> Result<Vec<u8>, AssetError>,
) -> Result<Vec<Vec<u8>>, AssetError> {
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

//! Finished meshes kept in the user's cache folder, so that a large file is read and built once.
//!
//! One file a mesh, named by blake3 of the format version, the kind of file and the file's content: a changed file has another name, so
//! nothing can be stale. Layout, little-endian: magic, version, the notes as JSON with their length, the columns of the mesh
//! ([`Mesh::write_raw`]), and blake3 of all that. What is damaged in any way is not there, and is written again. Writing
//! goes through a file of its own that is then renamed, so that two programs or threads cannot spoil each other's work; that it fails (a read-only
//! folder, a full disk) is no error. Verdicts are never kept, only meshes.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use etcetera::BaseStrategy as _;

use super::Note;
use crate::mesh::Mesh;

const MAGIC: &[u8; 8] = b"lancetM\n";
/// Counts up whenever reading, welding, repair, building or the layout changes what a file becomes.
const VERSION: u32 = 1;
const CHECKSUM: u64 = 32;
/// Notes are a few lines; more is damage.
const MOST_NOTE_BYTES: u32 = 1 << 20;
const BUFFER: usize = 1 << 18;
/// Numbers the drafts of this program, whose threads may write the same mesh.
static DRAFTS: AtomicU64 = AtomicU64::new(0);

/// Where finished meshes are kept, if anywhere.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CacheOptions {
    /// The folder; `None` for no cache.
    pub folder: Option<PathBuf>,
}

impl CacheOptions {
    /// No cache.
    pub fn off() -> Self {
        Self::default()
    }

    /// In a folder.
    pub fn at(folder: impl Into<PathBuf>) -> Self {
        Self { folder: Some(folder.into()) }
    }

    /// In the folder that the environment variable `LANCET_CACHE_DIR` names (empty: no cache), else in the user's cache folder.
    pub fn from_environment() -> Self {
        let users = || etcetera::choose_base_strategy().ok().map(|b| b.cache_dir().join("lancet"));
        Self::chosen(std::env::var_os("LANCET_CACHE_DIR"), users)
    }

    fn chosen(variable: Option<OsString>, users: impl FnOnce() -> Option<PathBuf>) -> Self {
        match variable {
            Some(folder) if folder.is_empty() => Self::off(),
            Some(folder) => Self::at(folder),
            None => Self { folder: users() },
        }
    }

    /// The mesh of that name, if it is there and whole.
    pub(super) fn load(&self, key: &str) -> Option<(Mesh, Vec<Note>)> {
        read(&self.folder.as_ref()?.join(key)).ok()
    }

    /// Keeps a mesh, if that is possible.
    pub(super) fn store(&self, key: &str, mesh: &Mesh, notes: &[Note]) {
        let Some(folder) = &self.folder else { return };
        let number = DRAFTS.fetch_add(1, Ordering::Relaxed);
        let draft = folder.join(format!("{key}.{}-{number}.draft", std::process::id()));
        let written = fs::create_dir_all(folder)
            .and_then(|()| write(&draft, mesh, notes))
            .and_then(|()| fs::rename(&draft, folder.join(key)));
        if written.is_err() {
            // Nothing more can be done about a draft that cannot be removed.
            fs::remove_file(&draft).ok();
        }
    }
}

/// The name under which the mesh of a file with this content is kept.
pub(super) fn key(format: u8, content: &[u8; 32]) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(MAGIC).update(&VERSION.to_le_bytes()).update(&[format]).update(content);
    format!("{}.mesh", hasher.finalize().to_hex())
}

fn write(path: &Path, mesh: &Mesh, notes: &[Note]) -> io::Result<()> {
    let mut out = HashingWriter {
        inner: BufWriter::with_capacity(BUFFER, File::create(path)?),
        hasher: blake3::Hasher::new(),
    };
    let notes = serde_json::to_vec(notes)?;
    out.write_all(MAGIC)?;
    out.write_all(&VERSION.to_le_bytes())?;
    out.write_all(&(notes.len() as u32).to_le_bytes())?;
    out.write_all(&notes)?;
    mesh.write_raw(&mut out)?;
    let HashingWriter { mut inner, hasher } = out;
    inner.write_all(hasher.finalize().as_bytes())?;
    inner.flush()
}

fn read(path: &Path) -> io::Result<(Mesh, Vec<Note>)> {
    let file = File::open(path)?;
    let body = file.metadata()?.len().saturating_sub(CHECKSUM);
    let mut file = BufReader::with_capacity(BUFFER, file);
    let mut input = HashingReader { inner: (&mut file).take(body), hasher: blake3::Hasher::new() };
    if read_array(&mut input)? != *MAGIC || u32::from_le_bytes(read_array(&mut input)?) != VERSION {
        return Err(damaged());
    }
    let length = u32::from_le_bytes(read_array(&mut input)?);
    if length > MOST_NOTE_BYTES {
        return Err(damaged());
    }
    let mut notes = vec![0; length as usize];
    input.read_exact(&mut notes)?;
    let left = input.inner.limit();
    let raw = Mesh::read_raw(&mut input, left)?;
    let (left, hash) = (input.inner.limit(), input.hasher.finalize());
    // The hash is compared before anything is believed, the indices' ranges after it.
    if left != 0 || read_array(&mut file)? != *hash.as_bytes() {
        return Err(damaged());
    }
    Ok((raw.validate().map_err(|_| damaged())?, serde_json::from_slice(&notes)?))
}

fn damaged() -> io::Error {
    io::ErrorKind::InvalidData.into()
}

fn read_array<const N: usize>(input: &mut impl Read) -> io::Result<[u8; N]> {
    let mut array = [0; N];
    input.read_exact(&mut array)?;
    Ok(array)
}

struct HashingWriter<W> {
    inner: W,
    hasher: blake3::Hasher,
}

impl<W: Write> Write for HashingWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.hasher.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

struct HashingReader<R> {
    inner: R,
    hasher: blake3::Hasher,
}

impl<R: Read> Read for HashingReader<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.inner.read(bytes)?;
        self.hasher.update(&bytes[..read]);
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_folder_is_the_variables_or_the_users() {
        let chosen = |variable: Option<&str>| {
            CacheOptions::chosen(variable.map(OsString::from), || Some("user".into())).folder
        };
        assert_eq!(chosen(Some("x")), Some("x".into()));
        assert_eq!(chosen(Some("")), None);
        assert_eq!(chosen(None), Some("user".into()));
    }

    #[test]
    fn format_and_content_make_the_name() {
        let content = [7; 32];
        assert_eq!(key(0, &content), key(0, &content));
        assert_ne!(key(0, &content), key(1, &content));
        assert_ne!(key(0, &content), key(0, &[8; 32]));
    }
}

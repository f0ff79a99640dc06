//! The maps of a scene: where they come from, and what they are where the scene has none.
//!
//! | map | from | else |
//! | --- | --- | --- |
//! | colour | `maps.color`, its alpha from `maps.scattering` if that is given | made by code for a built-in mesh; else the skin's albedo, scattering in full: 1024² for a mesh with texture coordinates, else one texel |
//! | normal, occlusion, specular | `maps.normal`, … | made by code for `builtin:bust`; else one texel: flat, open, the skin's own |
//!
//! Opening a scene reads the files, for their hashes, and keeps paths and sizes; [`MapSources::load`] reads them again and decodes. A file that changed in
//! between is refused. Maps made by code are made once in a process and shared.

mod decode;
mod irradiance;
mod png;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

pub use png::{read_png, write_png};

use super::builtin::{self, MapKind};
use super::error::{AssetError, Fault, FaultKind, Place};
use super::files::read_file;
use super::scene::{MapFiles, MapHash};
use crate::canvas::image::{Image, Maps};
use crate::canvas::look::Skin;

/// A side of the maps that are not read from files.
const DEFAULT_SIDE: u32 = 1024;
const FLAT: [u8; 4] = [128, 128, 255, 255];
const OPEN: [u8; 4] = [255; 4];

/// Which image a file is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Role {
    Color,
    Scattering,
    Normal,
    Occlusion,
    Specular,
    Irradiance,
}

impl Role {
    /// Its field in the scene.
    fn field(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Scattering => "scattering",
            Self::Normal => "normal",
            Self::Occlusion => "occlusion",
            Self::Specular => "specular",
            Self::Irradiance => "irradiance",
        }
    }
}

/// A map's file as it was when the scene was opened.
#[derive(Clone, Debug, PartialEq)]
struct MapFile {
    role: Role,
    path: PathBuf,
    size: [u32; 2],
    hash: [u8; 32],
}

/// What the maps are that no file is named for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Base {
    /// Made by code.
    Made(MapKind),
    /// One colour over an atlas.
    Even,
    /// There are no texture coordinates: one texel.
    Texel,
}

/// Where the maps of a scene come from.
#[derive(Clone, Debug, PartialEq)]
pub struct MapSources {
    base: Base,
    skin: Skin,
    side: u32,
    files: Vec<MapFile>,
}

impl MapSources {
    /// The maps of a mesh: a built-in one by its name, or one with or without texture coordinates.
    pub(super) fn new(builtin: Option<&str>, is_textured: bool, skin: &Skin) -> Self {
        let base = match builtin.and_then(MapKind::of) {
            Some(kind) => Base::Made(kind),
            None if is_textured => Base::Even,
            None => Base::Texel,
        };
        Self { base, skin: skin.clone(), side: DEFAULT_SIDE, files: Vec::new() }
    }

    /// With the files that a scene in this folder names.
    pub(super) fn with_files(mut self, named: &MapFiles, folder: &Path) -> Result<Self, AssetError> {
        let MapFiles { color, scattering, normal, occlusion, specular, irradiance } = named;
        for (role, name) in [
            (Role::Color, color),
            (Role::Scattering, scattering),
            (Role::Normal, normal),
            (Role::Occlusion, occlusion),
            (Role::Specular, specular),
            (Role::Irradiance, irradiance),
        ] {
            if let Some(name) = name {
                self.files.push(MapFile::open(role, folder.join(name))?);
            }
        }
        self.check_scattering()?;
        Ok(self)
    }

    /// With the maps that are not read from files made at this size, where they have one: a power of two is usual.
    #[must_use]
    pub fn with_side(mut self, side: u32) -> Self {
        self.side = side.clamp(1, 1 << 14);
        self
    }

    /// Width and height of the colour map, and so of everything that is painted.
    pub fn color_size(&self) -> [u32; 2] {
        let given = self.file(Role::Color).or(self.file(Role::Scattering).filter(|_| self.is_plain()));
        match (given, self.base) {
            (Some(file), _) => file.size,
            (None, Base::Texel) => [1; 2],
            (None, _) => [self.side; 2],
        }
    }

    /// Reads and makes the maps.
    pub fn load(&self) -> Result<Arc<Maps>, AssetError> {
        let Base::Made(kind) = self.base else { return self.overlay(self.defaults()).map(Arc::new) };
        let made = shared(kind, self.side, self.specular_texel());
        if self.files.iter().all(|file| file.role == Role::Irradiance) {
            return Ok(made);
        }
        self.overlay(Maps::clone(&made)).map(Arc::new)
    }

    /// blake3 of every file that the scene names.
    pub(super) fn hashes(&self) -> Vec<MapHash> {
        self.files.iter().map(|file| (file.role.field(), file.hash)).collect()
    }

    /// The surroundings' irradiance, where the scene names a picture of them.
    pub(super) fn irradiance(&self) -> Result<Option<[[f32; 3]; 9]>, AssetError> {
        let picture = self.file(Role::Irradiance).map(MapFile::load).transpose()?;
        Ok(picture.map(|picture| irradiance::irradiance(&picture)))
    }

    fn file(&self, role: Role) -> Option<&MapFile> {
        self.files.iter().find(|file| file.role == role)
    }

    /// Whether the colour map is one colour, so that it can have any size.
    fn is_plain(&self) -> bool {
        !matches!(self.base, Base::Made(_))
    }

    fn check_scattering(&self) -> Result<(), AssetError> {
        let Some(file) = self.file(Role::Scattering) else { return Ok(()) };
        let (size, [width, height]) = (file.size, self.color_size());
        if size == [width, height] {
            return Ok(());
        }
        let detail = format!("is {} x {}, but the colour map {width} x {height}", size[0], size[1]);
        Err(Fault::new(Place::Field("maps.scattering".into()), FaultKind::Unsupported, detail)
            .in_file(&file.path))
    }

    fn defaults(&self) -> Maps {
        let [r, g, b] = self.skin.albedo.map(to_byte);
        Maps {
            color: Image::filled(self.color_size(), [r, g, b, 255]),
            normal: Image::filled([1; 2], FLAT),
            occlusion: Image::filled([1; 2], OPEN),
            specular: Image::filled([1; 2], self.specular_texel()),
        }
    }

    fn specular_texel(&self) -> [u8; 4] {
        [to_byte(self.skin.intensity), to_byte(self.skin.roughness), 0, 255]
    }

    /// Puts what is read from files in the place of what is not.
    fn overlay(&self, mut maps: Maps) -> Result<Maps, AssetError> {
        for file in &self.files {
            match file.role {
                Role::Color => maps.color = file.load()?,
                Role::Normal => maps.normal = file.load()?,
                Role::Occlusion => maps.occlusion = file.load()?,
                Role::Specular => maps.specular = file.load()?,
                Role::Scattering => {
                    let strength = file.load()?;
                    let pairs = maps.color.texels.iter_mut().zip(&strength.texels);
                    pairs.for_each(|(color, strength)| color[3] = strength[0]);
                }
                Role::Irradiance => {}
            }
        }
        Ok(maps)
    }
}

impl MapFile {
    fn open(role: Role, path: PathBuf) -> Result<Self, AssetError> {
        let bytes = read_file(&path)?;
        let size = decode::size(&bytes).map_err(|fault| fault.in_file(&path))?;
        Ok(Self { role, size, hash: *blake3::hash(&bytes).as_bytes(), path })
    }

    fn load(&self) -> Result<Image, AssetError> {
        let bytes = read_file(&self.path)?;
        if blake3::hash(&bytes) != self.hash {
            let fault = Fault::whole(FaultKind::Io, "has changed since the scene was opened");
            return Err(fault.in_file(&self.path));
        }
        decode::decode(&bytes).map_err(|fault| fault.in_file(&self.path))
    }
}

fn to_byte(v: f32) -> u8 {
    (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// Maps made by code, by what they are of, their size, and the texel of what is not made.
type Made = ((MapKind, u32, [u8; 4]), Arc<Maps>);
static MADE: Mutex<Vec<Made>> = Mutex::new(Vec::new());

/// The maps of a built-in mesh. No lock is held while they are made: who waits for one could be a thread that is needed for the work.
fn shared(kind: MapKind, side: u32, specular: [u8; 4]) -> Arc<Maps> {
    let key = (kind, side, specular);
    let kept = || MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let find = |made: &[Made]| made.iter().find(|(k, _)| *k == key).map(|(_, maps)| Arc::clone(maps));
    if let Some(maps) = find(&kept()) {
        return maps;
    }
    let painted = builtin::paint(kind, side);
    let one = |texel| Image::filled([1; 2], texel);
    let maps = Arc::new(Maps {
        color: painted.color,
        normal: painted.normal.unwrap_or_else(|| one(FLAT)),
        occlusion: painted.occlusion.unwrap_or_else(|| one(OPEN)),
        specular: painted.specular.unwrap_or_else(|| one(specular)),
    });
    let mut made = kept();
    // Another thread may have made the same in the meantime.
    find(&made).unwrap_or_else(|| {
        made.push((key, Arc::clone(&maps)));
        maps
    })
}

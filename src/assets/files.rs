//! Reading, writing and finding files: the only place of the house that touches the file system.
//!
//! A file is written whole or not at all: under another name beside its place first, then renamed.

use std::cmp::Reverse;
use std::ffi::OsString;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf, absolute};

use super::error::{AssetError, Fault, FaultKind};
use super::outputs::note_read;
use crate::recording::SceneRef;

/// The bytes of a file; refuses what is none, such as a device without an end.
pub fn read_file(path: &Path) -> Result<Vec<u8>, AssetError> {
    let metadata = fs::metadata(path).map_err(|e| AssetError::io(path, &e))?;
    if !metadata.is_file() {
        return Err(Fault::whole(FaultKind::Io, "is not a file").in_file(path));
    }
    let bytes = fs::read(path).map_err(|e| AssetError::io(path, &e))?;
    note_read(path);
    Ok(bytes)
}

/// Writes a file, and the folders that it lies in. What stood there before stays until the new bytes are all written.
///
/// A link is followed; a pipe or a device is written into, as it is.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), AssetError> {
    match fs::metadata(path) {
        Ok(there) if !there.is_file() && !there.is_dir() => {
            let into = OpenOptions::new().write(true).open(path);
            into.and_then(|mut file| file.write_all(bytes)).map_err(|e| AssetError::io(path, &e))
        }
        Ok(_) if path.is_symlink() => {
            let real = fs::canonicalize(path).map_err(|e| AssetError::io(path, &e))?;
            replace_file(&real, bytes)
        }
        _ => replace_file(path, bytes),
    }
}

fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), AssetError> {
    let mut name = path.file_name().map_or_else(OsString::new, OsString::from);
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let written =
        make_folder(path).and_then(|()| fs::write(&part, bytes)).and_then(|()| fs::rename(&part, path));
    written.map_err(|e| {
        // Best effort: the error to report is the first one.
        let _ = fs::remove_file(&part);
        AssetError::io(path, &e)
    })
}

fn make_folder(path: &Path) -> io::Result<()> {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).map_or(Ok(()), fs::create_dir_all)
}

/// Removes a file. One that is not there is removed already.
pub fn remove_file(path: &Path) -> Result<(), AssetError> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(AssetError::io(path, &e)),
        _ => Ok(()),
    }
}

/// Gives a file another name. Of several programs that do so at once with one file exactly one is told that it did; to the others it is not there.
pub fn take_file(from: &Path, to: &Path) -> Result<bool, AssetError> {
    match fs::rename(from, to) {
        Ok(()) => Ok(true),
        Err(e) if e.kind() == io::ErrorKind::NotFound && !from.exists() => Ok(false),
        Err(e) => Err(AssetError::io(from, &e)),
    }
}

/// The path of a folder without links and `..`, so that paths relative to it lead where they seem to. It is made if it is not there.
pub fn real_folder(folder: &Path) -> Result<PathBuf, AssetError> {
    let real = fs::create_dir_all(folder).and_then(|()| fs::canonicalize(folder));
    real.map_err(|e| AssetError::io(folder, &e))
}

/// A scene that a file in `folder` names, as a file at `path` has to name it.
pub fn moved(scene: &SceneRef, folder: &Path, path: &Path) -> Result<SceneRef, AssetError> {
    let real = |folder: &Path| {
        let here = folder.as_os_str().is_empty();
        let whole = absolute(if here { Path::new(".") } else { folder });
        whole.map(|whole| without_links(&whole)).map_err(|e| AssetError::io(folder, &e))
    };
    Ok(scene.moved(&real(folder)?, &real(path.parent().unwrap_or(Path::new("")))?))
}

/// An absolute path without the links in it, as far as it exists: `..` leads elsewhere from a link than from where it seems to be.
fn without_links(path: &Path) -> PathBuf {
    let there = path.ancestors().find_map(|above| Some((above, fs::canonicalize(above).ok()?)));
    there.map_or_else(|| path.into(), |(above, real)| real.join(path.strip_prefix(above).unwrap_or(path)))
}

/// The files of a folder, without those in folders in it, whatever was written last first; none where there is no such folder.
pub fn newest_files(folder: &Path) -> Result<Vec<PathBuf>, AssetError> {
    let changed = |path: &PathBuf| fs::metadata(path).and_then(|file| file.modified()).ok();
    let mut files = list_files(folder)?;
    files.retain(|path| path.parent() == Some(folder));
    files.sort_by_cached_key(|path| Reverse(changed(path)));
    Ok(files)
}

/// Whether a path is a file.
pub fn is_file(path: &Path) -> bool {
    path.is_file()
}

/// Whether two paths lead to one file, there or not.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| fs::canonicalize(path).or_else(|_| absolute(path)).ok();
    real(a).zip(real(b)).is_some_and(|(a, b)| a == b)
}

/// Whether a path is a folder.
pub fn is_folder(path: &Path) -> bool {
    path.is_dir()
}

/// All files in a folder and the folders in it, sorted by path; none where there is no such folder. Links to folders are not followed.
pub fn list_files(folder: &Path) -> Result<Vec<PathBuf>, AssetError> {
    let mut files = Vec::new();
    if folder.is_dir() {
        collect(folder, &mut files)?;
    }
    files.sort();
    Ok(files)
}

/// What lies in a folder, sorted by name, and whether it is a folder itself.
pub fn list_folder(folder: &Path) -> Result<Vec<(PathBuf, bool)>, AssetError> {
    let failed = |e: io::Error| AssetError::io(folder, &e);
    let entries = fs::read_dir(folder).map_err(failed)?;
    let entries = entries.map(|entry| entry.map(|entry| entry.path()).map_err(failed));
    let mut paths = entries.collect::<Result<Vec<_>, _>>()?;
    paths.sort();
    let with_kind = |path: PathBuf| {
        let is_folder = path.is_dir();
        (path, is_folder)
    };
    Ok(paths.into_iter().map(with_kind).collect())
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), AssetError> {
    let failed = |e: io::Error| AssetError::io(folder, &e);
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if entry.file_type().map_err(failed)?.is_dir() {
            collect(&entry.path(), files)?;
        } else {
            files.push(entry.path());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_written_with_their_folders_and_listed_in_order() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        for name in ["b.txt", "a/d/z.txt", "a/c.txt"] {
            write_file(&at(name), name.as_bytes()).expect("written");
        }
        write_file(&at("b.txt"), b"again").expect("written over");
        assert_eq!(read_file(&at("b.txt")).expect("read"), b"again");
        let listed = list_files(folder.path()).expect("listed");
        assert_eq!(listed, [at("a/c.txt"), at("a/d/z.txt"), at("b.txt")], "and no part is left over");
        assert!(list_files(&at("nowhere")).expect("none").is_empty());
        assert_eq!(list_folder(folder.path()).expect("listed"), [(at("a"), true), (at("b.txt"), false)]);
        assert!(list_folder(&at("nowhere")).is_err());
    }

    #[test]
    fn the_newest_files_come_first_and_are_removed_once_or_twice() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        for (seconds, name) in [(3, "c"), (1, "a"), (2, "b"), (4, "below/d")] {
            write_file(&at(name), b"x").expect("written");
            let file = fs::File::options().write(true).open(at(name)).expect("it is there");
            let time = std::time::UNIX_EPOCH + std::time::Duration::from_secs(seconds);
            file.set_modified(time).expect("a time");
        }
        assert_eq!(newest_files(folder.path()).expect("listed"), [at("c"), at("b"), at("a")]);
        (0..2).for_each(|_| remove_file(&at("b")).expect("removed"));
        assert_eq!(newest_files(folder.path()).expect("listed"), [at("c"), at("a")]);
        assert!(remove_file(&at("below")).is_err(), "a folder is no file");
        assert!(newest_files(&at("nowhere")).expect("none").is_empty());
    }

    #[test]
    fn a_file_is_taken_once_whoever_else_wants_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        write_file(&at("draft"), b"x").expect("written");
        let takers: Vec<PathBuf> = (0..8).map(|taker| at(&format!("of-{taker}"))).collect();
        let take = &|to: &PathBuf| take_file(&at("draft"), to).expect("no other error");
        let taken: Vec<bool> = std::thread::scope(|scope| {
            let takers: Vec<_> = takers.iter().map(|to| scope.spawn(move || take(to))).collect();
            takers.into_iter().map(|taker| taker.join().expect("no panic")).collect()
        });
        assert_eq!(taken.iter().filter(|taken| **taken).count(), 1);
        let there: Vec<bool> = takers.iter().map(|path| is_file(path)).collect();
        assert_eq!(there, taken);
        write_file(&at("other"), b"y").expect("written");
        assert!(take_file(&at("other"), &at("no/folder/x")).is_err() && is_file(&at("other")));
    }

    #[test]
    fn a_scene_is_found_from_wherever_a_recording_is_moved() {
        let scene = SceneRef::Mesh("../meshes/head.obj".into());
        let moved = |from: &str, to: &str| moved(&scene, Path::new(from), Path::new(to)).expect("a folder");
        assert_eq!(moved("/a/cuts", "/a/new/x.lancet"), scene);
        assert_eq!(moved("/a/cuts", "/b/x.lancet"), SceneRef::Mesh("../a/meshes/head.obj".into()));
        assert_eq!(moved("", "x.lancet"), scene, "here is here");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_followed_and_stays_one() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        write_file(&at("far/real"), b"old").expect("written");
        std::os::unix::fs::symlink("far/real", at("link")).expect("a link");
        write_file(&at("link"), b"new").expect("written");
        assert!(at("link").is_symlink());
        assert_eq!(read_file(&at("far/real")).expect("read"), b"new");
        std::os::unix::fs::symlink("far", at("near")).expect("a link");
        let seen = moved(&SceneRef::Mesh("head.obj".into()), folder.path(), &at("near/x.lancet"));
        assert_eq!(seen.expect("a folder"), SceneRef::Mesh("../head.obj".into()));
        write_file(&at("far/further/y"), b"").expect("written");
        std::os::unix::fs::symlink("far/further", at("further")).expect("a link");
        let seen = moved(&SceneRef::Mesh("head.obj".into()), folder.path(), &at("further/x.lancet"));
        assert_eq!(seen.expect("a folder"), SceneRef::Mesh("../../head.obj".into()));
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_is_written_into_and_stays_one() {
        use std::os::unix::fs::FileTypeExt;

        let folder = tempfile::tempdir().expect("a folder");
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo runs");
        assert!(made.success());
        let read = std::thread::scope(|scope| {
            let reader = scope.spawn(|| fs::read(&pipe).expect("read"));
            write_file(&pipe, b"through").expect("written");
            reader.join().expect("no panic")
        });
        assert_eq!(read, b"through");
        assert!(fs::metadata(&pipe).expect("there").file_type().is_fifo());
    }

    #[cfg(unix)]
    #[test]
    fn a_real_folder_has_no_links_and_is_there() {
        let folder = tempfile::tempdir().expect("a folder");
        let real = real_folder(&folder.path().join("far/away")).expect("made");
        assert!(real.is_dir());
        let link = folder.path().join("link");
        std::os::unix::fs::symlink(&real, &link).expect("a link");
        assert_eq!(real_folder(&link).expect("there"), real);
        write_file(&folder.path().join("file"), b"x").expect("written");
        assert!(real_folder(&folder.path().join("file")).is_err());
    }

    #[test]
    fn errors_name_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let missing = folder.path().join("missing");
        let error = read_file(&missing).expect_err("it is not there");
        assert!(error.to_string().contains("missing"));
        write_file(&missing, b"x").expect("written");
        assert!(write_file(&missing.join("under-a-file"), b"x").is_err());
    }
}

//! Where goldens lie, and what a recording is called.
//!
//! `X/recordings/wound/a.lancet` is called `wound/a`, and its goldens lie in `X/golden/wound/a/`; a recording outside of any
//! `recordings` folder goes by its path, and has them beside it in `FILE.golden/`. The run's two files begin with an underscore, which
//! no checkpoint's name does. `X/golden/gates.json` belongs to them all.

use std::path::{Component, Path, PathBuf};

/// The text of a run.
pub(super) const RUN_TEXT: &str = "_run.txt";
/// The values of a run.
pub(super) const RUN_VALUES: &str = "_run.bin";
/// What adapters may differ by.
const GATES: &str = "gates.json";
/// The ending of recordings.
pub(super) const RECORDING: &str = "lancet";

/// The file of a checkpoint's text.
pub(super) fn checkpoint_text(name: &str) -> String {
    format!("{name}.txt")
}

/// The file of a checkpoint's picture.
pub(super) fn checkpoint_picture(name: &str) -> String {
    format!("{name}.png")
}

/// The file of the gates that hold for a recording: beside the goldens of all recordings, or else beside the recording.
pub(super) fn gates(recording: &Path) -> PathBuf {
    let folder = match split(recording) {
        Some((above, _)) => above.join("golden"),
        None => recording.parent().unwrap_or(Path::new("")).into(),
    };
    folder.join(GATES)
}

/// The folder above the innermost `recordings`, and the path under it.
fn split(path: &Path) -> Option<(PathBuf, PathBuf)> {
    // Within `recordings`, a path need not name it.
    split_named(path).or_else(|| split_named(&std::path::absolute(path).ok()?))
}

fn split_named(path: &Path) -> Option<(PathBuf, PathBuf)> {
    let parts: Vec<Component<'_>> = path.components().collect();
    let at = parts.iter().rposition(|part| part.as_os_str() == "recordings")?;
    Some((parts[..at].iter().collect(), parts[at + 1..].iter().collect()))
}

/// What a recording is called in reports, with `/` between folders.
pub(super) fn name(recording: &Path) -> String {
    let Some((_, under)) = split(recording) else { return recording.display().to_string() };
    let under = under.with_extension("");
    under.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// The folder of a recording's goldens.
pub(super) fn goldens(recording: &Path) -> PathBuf {
    if let Some((above, under)) = split(recording) {
        return above.join("golden").join(under.with_extension(""));
    }
    let mut beside = recording.as_os_str().to_owned();
    beside.push(".golden");
    beside.into()
}

/// The folder of the goldens of all recordings in a folder, where it is its own.
pub(super) fn goldens_of_folder(folder: &Path) -> Option<PathBuf> {
    let (above, under) = split(folder)?;
    Some(above.join("golden").join(under))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goldens_mirror_the_recordings() {
        let recording = Path::new("/x/recordings/wound/thesis-large-VI.lancet");
        assert_eq!(name(recording), "wound/thesis-large-VI");
        assert_eq!(goldens(recording), Path::new("/x/golden/wound/thesis-large-VI"));
        assert_eq!(goldens_of_folder(Path::new("/x/recordings")), Some("/x/golden".into()));
        assert_eq!(gates(recording), Path::new("/x/golden/gates.json"));
        assert_eq!(goldens(Path::new("recordings/a.lancet")), Path::new("golden/a"));
        assert_eq!(goldens_of_folder(Path::new("/x/recordings/wound")), Some("/x/golden/wound".into()));
        let nested = Path::new("/x/recordings/old/recordings/a.lancet");
        assert_eq!(goldens(nested), Path::new("/x/recordings/old/golden/a"));
    }

    #[test]
    fn elsewhere_they_lie_beside() {
        let recording = Path::new("/tmp/a.lancet");
        assert_eq!(
            (name(recording), goldens(recording)),
            ("/tmp/a.lancet".into(), "/tmp/a.lancet.golden".into())
        );
        assert_eq!(goldens_of_folder(Path::new("/tmp")), None);
        assert_eq!(gates(recording), Path::new("/tmp/gates.json"));
    }
}

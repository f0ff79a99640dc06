//! What can be opened: recordings that were not saved, those that were found, the scenes that a new one can be made on, and any path that is typed.
//!
//! ```text
//! ┌ open a recording, or begin one ──────────────────┐
//! │ / bus█                                           │
//! │ bust-4711.lancet              not saved, 12 event│
//! │ recordings/wound/bust.lancet                     │
//! │ builtin:bust   a head on its neck     a new one  │
//! │ bus                                    this path │  or a new one, where a scene was typed
//! └ enter open · tab complete a path · esc close ────┘
//! ```

use std::cmp::Reverse;
use std::path::{Path, PathBuf};

use ratatui::text::Line;

use super::menu::{Pen, Row, blanks, marked};
use crate::assets::{self, builtin};
use crate::recording::SceneRef;
use crate::report::printable;
use crate::tui::fuzzy::{self, Found};
use crate::tui::model::Model;
use crate::tui::record::Draft;
use crate::tui::theme::Role;

/// Cells of the column of scenes.
const SCENES: usize = 20;

/// Something to open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::tui) enum Entry {
    /// A recording that was not saved.
    Draft(Draft),
    /// A recording.
    File(PathBuf),
    /// A scene to begin one on: its name, and what it is.
    Scene(&'static str, &'static str),
    /// What was typed.
    Typed(String),
}

impl Entry {
    /// What it is found by.
    fn name(&self) -> String {
        match self {
            Self::Draft(draft) => printable(draft.path.file_name().unwrap_or_default().to_string_lossy()),
            Self::File(path) => printable(path.display()),
            Self::Scene(name, _) => format!("builtin:{name}"),
            Self::Typed(path) => path.clone(),
        }
    }
}

/// What is found by what was typed, the best first, each with its letters.
pub(in crate::tui) fn entries(model: &Model, files: &[PathBuf], typed: &str) -> Vec<(Entry, Found)> {
    let drafts = model.kept.drafts.iter().cloned().map(Entry::Draft);
    let files = files.iter().cloned().map(Entry::File);
    let scenes = builtin::list().iter().map(|scene| Entry::Scene(scene.name, scene.about));
    let all = drafts.chain(files).chain(scenes);
    let found = all.filter_map(|entry| fuzzy::find(typed, &entry.name()).map(|found| (entry, found)));
    let mut found: Vec<_> = found.collect();
    found.sort_by_key(|(_, found)| Reverse(found.score));
    let typed = typed.trim();
    let own = (Entry::Typed(typed.into()), Found::default());
    match typed {
        "" => {}
        path if is_path(path) => found.insert(0, own),
        _ => found.push(own),
    }
    found
}

/// Whether a text looks like a path rather than like some letters of a name.
fn is_path(typed: &str) -> bool {
    let end = Path::new(typed).extension().and_then(|end| end.to_str());
    typed.starts_with(['/', '.', '~'])
        || matches!(end, Some("lancet" | "json"))
        || assets::is_mesh(Path::new(typed))
}

/// Whether what was typed is a scene by its looks; a scene's description looks like a script.
fn is_scene(typed: &str) -> bool {
    SceneRef::parse_builtin(typed).is_some() || assets::is_mesh(Path::new(typed))
}

pub(super) fn rows(pen: Pen<'_>, files: &[PathBuf]) -> Vec<Row> {
    entries(pen.model, files, pen.typed).iter().map(|(entry, found)| row(entry, found, pen)).collect()
}

fn row(entry: &Entry, found: &Found, pen: Pen<'_>) -> Row {
    let name = entry.name();
    let mut left = marked(&name, &found.at, Role::Text, pen.theme);
    let (kind, role, about) = match entry {
        Entry::Draft(draft) => draft_words(draft),
        Entry::File(_) => (String::new(), Role::Faint, format!("open {name}")),
        Entry::Scene(_, about) => {
            left.push(blanks(&name, SCENES));
            left.extend(marked(about, &[], Role::Faint, pen.theme));
            ("a new one".into(), Role::Faint, format!("begin a new recording on {name}: {about}"))
        }
        Entry::Typed(typed) if is_scene(typed) => {
            ("a new one".into(), Role::Faint, format!("begin a new recording on {name}"))
        }
        Entry::Typed(_) => ("this path".into(), Role::Faint, format!("open the file {name}")),
    };
    Row { left: Line::from(left), right: Line::styled(kind, pen.theme.style(role)), about: vec![about] }
}

fn draft_words(draft: &Draft) -> (String, Role, String) {
    match &draft.content {
        Ok((scene, events)) => {
            let about = format!("take up again what was recorded on {} and not saved", printable(scene));
            (format!("not saved, {events} events"), Role::Warn, about)
        }
        Err(error) => ("not readable".into(), Role::Bad, printable(error)),
    }
}

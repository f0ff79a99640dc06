//! The user's settings: `lancet/config.toml` in the config folder of the system (`~/.config` on Linux), or a file named by a flag; [`EXAMPLE`] is one.
//!
//! No file is no setting. A wrong one is refused as a whole, with file, line, column and cause: a setting that is silently
//! passed over would look like one that does not work. Which actions there are is passed in, with where their keys count: there no two
//! can be given the same one. One that was another action's by default is that one's no longer.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use etcetera::BaseStrategy as _;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::image::protocol::ImageProtocol;
use super::key::Key;
use super::theme::{self, Base, Choice, Role};
use crate::assets::{self, AssetError};

/// Every kind of setting.
pub const EXAMPLE: &str = r##"mouse = true                 # false leaves the mouse to the terminal, which then selects text
image-protocol = "auto"      # kitty, sixel, iterm2, halfblocks

[theme]
base = "auto"                # dark, light
accent = "#56b4e9"           # a role's colour,
selected = "bold white on blue"      # or its whole style

[keys]
quit = ["q", "ctrl-x"]       # these keys and no others
search = "/"
palette = []                 # no key at all
"##;

/// The user's settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Whether mouse events are asked for.
    pub mouse: bool,
    /// How pictures are shown.
    pub image_protocol: ImageProtocol,
    /// What the screen looks like.
    pub theme: Choice,
    /// Actions whose keys are other than usual, with all their keys.
    pub keys: Vec<(String, Vec<Key>)>,
}

impl Default for Config {
    fn default() -> Self {
        Self { mouse: true, image_protocol: ImageProtocol::Auto, theme: Choice::default(), keys: Vec::new() }
    }
}

/// An action that can be given keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Known {
    /// Its name.
    pub name: &'static str,
    /// Where its keys count: with those of the same number.
    pub scope: usize,
}

/// What is wrong with a file of settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConfigError {
    /// It cannot be read.
    File(AssetError),
    /// It cannot be understood.
    Content {
        /// The file.
        file: PathBuf,
        /// Where in it, from 1.
        line: usize,
        /// In characters, from 1.
        column: usize,
        /// What is wrong there.
        cause: String,
    },
}

impl fmt::Display for ConfigError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(error) => error.fmt(f),
            Self::Content { file, line, column, cause } => {
                write!(f, "{}:{line}:{column}: {cause}", file.display())
            }
        }
    }
}

impl std::error::Error for ConfigError {}

impl Config {
    /// The file that is read when none is named; `None` where the system has no place for it.
    pub fn usual_file() -> Option<PathBuf> {
        let folders = etcetera::choose_base_strategy().ok()?;
        Some(folders.config_dir().join("lancet").join("config.toml"))
    }

    /// The settings of a file that was named, or else of the usual one, if it is there.
    pub fn load(named: Option<&Path>, actions: &[Known]) -> Result<Self, ConfigError> {
        // Something else of this name, such as a folder, is not overlooked.
        let usual = || Self::usual_file().filter(|file| assets::is_file(file) || assets::is_folder(file));
        let Some(file) = named.map(Path::to_path_buf).or_else(usual) else { return Ok(Self::default()) };
        let bytes = assets::read_file(&file).map_err(ConfigError::File)?;
        Self::parse(&bytes, &file, actions)
    }

    /// Reads settings; the file's name is for errors.
    pub fn parse(bytes: &[u8], file: &Path, actions: &[Known]) -> Result<Self, ConfigError> {
        let (text, broken) = match std::str::from_utf8(bytes) {
            Ok(text) => (text, None),
            Err(error) => {
                let valid = error.valid_up_to();
                let text = std::str::from_utf8(&bytes[..valid]).unwrap_or_default();
                (text, Some(Fault { at: valid, cause: "this is not UTF-8".into() }))
            }
        };
        let parsed = broken.map_or_else(|| settings(text, actions), Err);
        parsed.map_err(|fault| fault.in_file(file, text))
    }
}

/// What is wrong, and at which byte.
struct Fault {
    at: usize,
    cause: String,
}

impl Fault {
    fn at(span: Range<usize>, cause: impl fmt::Display) -> Self {
        Self { at: span.start, cause: cause.to_string() }
    }

    fn in_file(self, file: &Path, text: &str) -> ConfigError {
        let before = text.get(..self.at).unwrap_or(text);
        let line = before.rsplit('\n').next().unwrap_or_default();
        ConfigError::Content {
            file: file.to_path_buf(),
            line: before.matches('\n').count() + 1,
            column: line.chars().count() + 1,
            cause: self.cause,
        }
    }
}

type Value<'a> = Spanned<DeValue<'a>>;

/// The entries of a table in the order of the file, so that the first fault in it is told.
fn entries<'t, 'a>(table: &'t DeTable<'a>) -> Vec<(&'t str, Range<usize>, &'t Value<'a>)> {
    let mut entries: Vec<_> =
        table.iter().map(|(key, value)| (key.get_ref().as_ref(), key.span(), value)).collect();
    entries.sort_by_key(|(_, span, _)| span.start);
    entries
}

fn settings(text: &str, actions: &[Known]) -> Result<Config, Fault> {
    let table =
        DeTable::parse(text).map_err(|error| Fault::at(error.span().unwrap_or(0..0), error.message()))?;
    let mut config = Config::default();
    for (name, span, value) in entries(table.get_ref()) {
        match name {
            "mouse" => {
                config.mouse = value.get_ref().as_bool().ok_or_else(|| wants("true or false", value))?
            }
            "image-protocol" => {
                let named = ImageProtocol::ALL.map(|protocol| (protocol.name(), protocol));
                config.image_protocol = one_of(value, &named)?;
            }
            "theme" => config.theme = choice(table_of(value)?)?,
            "keys" => config.keys = keys(table_of(value)?, actions)?,
            _ => return Err(unknown("setting", name, span, &["mouse", "image-protocol", "theme", "keys"])),
        }
    }
    Ok(config)
}

const BASES: [(&str, Option<Base>); 3] =
    [("auto", None), ("dark", Some(Base::Dark)), ("light", Some(Base::Light))];

fn choice(table: &DeTable<'_>) -> Result<Choice, Fault> {
    let mut choice = Choice::default();
    for (name, span, value) in entries(table) {
        match (name, Role::named(name)) {
            ("base", _) => choice.base = one_of(value, &BASES)?,
            (_, Some(role)) => {
                let style = theme::style(text_of(value)?).map_err(|error| Fault::at(value.span(), error))?;
                choice.roles.push((role, style));
            }
            _ => {
                let names: Vec<&str> = ["base"].into_iter().chain(Role::all().map(Role::name)).collect();
                return Err(unknown("role", name, span, &names));
            }
        }
    }
    Ok(choice)
}

type Bindings = Vec<(String, Vec<Key>)>;

fn keys(table: &DeTable<'_>, actions: &[Known]) -> Result<Bindings, Fault> {
    let mut bound: Bindings = Vec::new();
    for (name, span, value) in entries(table) {
        let Some(action) = actions.iter().find(|action| action.name == name) else {
            let names: Vec<&str> = actions.iter().map(|action| action.name).collect();
            return Err(unknown("action", name, span, &names));
        };
        let values = value.get_ref().as_array().map_or(std::slice::from_ref(value), |array| array.as_ref());
        let mut keys = Vec::new();
        for value in values {
            let key = key(value)?;
            require_free(key, value, *action, &bound, actions)?;
            keys.push(key);
        }
        bound.push((name.to_owned(), keys));
    }
    Ok(bound)
}

/// Refuses a key that another action of the same scope was given further above.
fn require_free(
    key: Key,
    value: &Value<'_>,
    action: Known,
    bound: &Bindings,
    actions: &[Known],
) -> Result<(), Fault> {
    let beside = |name: &str| actions.iter().any(|other| other.name == name && other.scope == action.scope);
    match bound.iter().find(|(name, keys)| keys.contains(&key) && beside(name)) {
        Some((other, _)) => Err(Fault::at(
            value.span(),
            format_args!("`{key}` cannot be a key of both `{other}` and `{}`", action.name),
        )),
        None => Ok(()),
    }
}

fn key(value: &Value<'_>) -> Result<Key, Fault> {
    let text = value
        .get_ref()
        .as_str()
        .ok_or_else(|| wants("a key such as \"ctrl-p\", or a list of keys", value))?;
    text.parse().map_err(|error| Fault::at(value.span(), error))
}

fn table_of<'t, 'a>(value: &'t Value<'a>) -> Result<&'t DeTable<'a>, Fault> {
    value.get_ref().as_table().ok_or_else(|| wants("a table", value))
}

fn text_of<'t>(value: &'t Value<'_>) -> Result<&'t str, Fault> {
    value.get_ref().as_str().ok_or_else(|| wants("a text in quotes", value))
}

fn one_of<T: Copy>(value: &Value<'_>, named: &[(&str, T)]) -> Result<T, Fault> {
    let text = text_of(value)?;
    let names: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
    let found = named.iter().find(|(name, _)| *name == text).map(|(_, known)| *known);
    found.ok_or_else(|| unknown("value", text, value.span(), &names))
}

fn wants(what: &str, value: &Value<'_>) -> Fault {
    Fault::at(value.span(), format_args!("this takes {what}, not a TOML {}", value.get_ref().type_str()))
}

fn unknown(kind: &str, name: &str, span: Range<usize>, known: &[&str]) -> Fault {
    let meant = nearest(name, known).map(|known| format!("did you mean `{known}`? "));
    let meant = meant.unwrap_or_default();
    Fault::at(span, format_args!("there is no {kind} `{name}`; {meant}there are: {}", known.join(", ")))
}

/// The known name that was most likely meant: at most a third of its letters are wrong.
fn nearest<'k>(name: &str, known: &[&'k str]) -> Option<&'k str> {
    let by_distance = known.iter().map(|known| (distance(name, known), *known)).min()?;
    (by_distance.0 <= by_distance.1.chars().count().div_ceil(3)).then_some(by_distance.1)
}

/// How many letters must be added, dropped or changed (Levenshtein), row by row.
fn distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = i;
        row[0] = i + 1;
        for (j, y) in b.chars().enumerate() {
            let changed = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests;

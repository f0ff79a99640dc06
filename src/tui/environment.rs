//! What the environment says: about the terminal, and where what is not saved is kept. This is the only file of the front end that asks it; everybody else is told, so that
//! tests choose it, and nothing but looks and that place can depend on it.

use std::ffi::OsString;
use std::path::PathBuf;

use etcetera::BaseStrategy as _;

use super::record::Drafts;

/// What the environment says of the terminal. A variable that is empty counts as unset.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Environment {
    /// `NO_COLOR` (no-color.org): anything but empty asks for no colour.
    pub no_color: String,
    /// `TERM`: the terminal's kind.
    pub term: String,
    /// `COLORTERM`: `truecolor` or `24bit` where it shows any colour.
    pub colorterm: String,
    /// `COLORFGBG`: the numbers of the text's and the background's colours, such as `15;0`.
    pub colorfgbg: String,
    /// `TERM_PROGRAM`: the terminal's name, where it says it.
    pub program: String,
    /// Whether `KITTY_WINDOW_ID` is set.
    pub kitty: bool,
    /// Whether `WEZTERM_PANE` or `WEZTERM_EXECUTABLE` is set.
    pub wezterm: bool,
    /// Whether `TMUX`, `STY` or `ZELLIJ` is set: a multiplexer stands between.
    pub multiplexer: bool,
}

impl Environment {
    /// The program's own.
    pub fn read() -> Self {
        Self::of(|name| std::env::var_os(name).map(|value| value.to_string_lossy().into()))
    }

    /// What variables tell, by whoever can read them.
    pub fn of(read: impl Fn(&str) -> Option<String>) -> Self {
        let text = |name: &str| read(name).unwrap_or_default();
        let any = |names: &[&str]| names.iter().any(|name| !text(name).is_empty());
        Self {
            no_color: text("NO_COLOR"),
            term: text("TERM"),
            colorterm: text("COLORTERM"),
            colorfgbg: text("COLORFGBG"),
            program: text("TERM_PROGRAM"),
            kitty: any(&["KITTY_WINDOW_ID"]),
            wezterm: any(&["WEZTERM_PANE", "WEZTERM_EXECUTABLE"]),
            multiplexer: any(&["TMUX", "STY", "ZELLIJ"]),
        }
    }

    /// Whether the terminal cannot place text at all, so that there is no screen to draw.
    pub fn is_dumb(&self) -> bool {
        self.term == "dumb"
    }
}

impl Drafts {
    /// In the folder that `LANCET_STATE_DIR` names (empty: nowhere), else in the user's folder for what programs keep between two runs.
    pub fn from_environment() -> Self {
        Self::chosen(std::env::var_os("LANCET_STATE_DIR"), users_folder)
    }

    fn chosen(variable: Option<OsString>, users: impl FnOnce() -> Option<PathBuf>) -> Self {
        let folder = match variable {
            Some(folder) if folder.is_empty() => None,
            Some(folder) => Some(folder.into()),
            None => users(),
        };
        folder.map_or_else(Self::default, |folder: PathBuf| Self::at(folder.join("drafts")))
    }
}

/// Not every system has a folder for states; then it is the one for data.
fn users_folder() -> Option<PathBuf> {
    let users = etcetera::choose_base_strategy().ok()?;
    Some(users.state_dir().unwrap_or_else(|| users.data_dir()).join("lancet"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drafts_lie_where_the_variable_says_or_with_the_user() {
        let chosen =
            |variable: Option<&str>| Drafts::chosen(variable.map(OsString::from), || Some("user".into()));
        assert_eq!(chosen(Some("x")), Drafts::at("x/drafts"));
        assert_eq!(chosen(Some("")), Drafts::default());
        assert_eq!(chosen(None), Drafts::at("user/drafts"));
    }
}

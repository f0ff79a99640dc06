//! What the environment says about the terminal. This is the only file of the front end that asks it; everybody else is told, so that
//! tests choose it, and nothing but looks can depend on it.

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

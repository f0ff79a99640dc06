//! What the environment says about the terminal. This is the only file of the front end that asks it; everybody else is told, so that
//! tests choose it, and nothing but looks can depend on it.

/// The variables that decide how the screen looks; empty where unset.
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
}

impl Environment {
    /// The program's own.
    pub fn read() -> Self {
        let read =
            |name: &str| std::env::var_os(name).map_or_else(String::new, |v| v.to_string_lossy().into());
        Self {
            no_color: read("NO_COLOR"),
            term: read("TERM"),
            colorterm: read("COLORTERM"),
            colorfgbg: read("COLORFGBG"),
        }
    }

    /// Whether the terminal cannot place text at all, so that there is no screen to draw.
    pub fn is_dumb(&self) -> bool {
        self.term == "dumb"
    }
}

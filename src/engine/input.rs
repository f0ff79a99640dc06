//! What a person does by hand, before it is an event of any engine: front ends record with it, and know no engine by name.

use super::Event;
use crate::canvas::frame::Orbit;

/// Something done by hand.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// Looked from elsewhere.
    Look(Orbit),
    /// Chose a mode, by its name.
    Mode(String),
    /// Pointed at a pixel position of the recorded view, from the top left.
    Point([f64; 2]),
    /// Took the last edit back.
    Undo,
    /// Did it again.
    Redo,
    /// Named a place to come back to, and to take a picture of.
    Checkpoint(String),
    /// Typed an event as it stands in a script.
    Script(String),
}

impl Input {
    /// The event that it is for an engine. An error says why it is none.
    pub fn event<E: Event>(&self) -> Result<E, String> {
        match self {
            Self::Script(text) => serde_json::from_str(text).map_err(|error| error.to_string()),
            other => E::by_hand(other).ok_or_else(|| format!("this engine has no {}", other.name())),
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Self::Look(_) => "camera",
            Self::Mode(_) => "such mode",
            Self::Point(_) => "pointing",
            Self::Undo => "undo",
            Self::Redo => "redo",
            Self::Checkpoint(_) => "checkpoints",
            Self::Script(_) => "script",
        }
    }
}

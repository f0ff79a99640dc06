//! Values that have a form of their own, each read from what stands after its flag.

use std::ffi::OsString;
use std::path::PathBuf;
use std::str::FromStr;

/// Where an answer goes: a file, or `-` for standard output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum Target {
    Stdout,
    File(PathBuf),
}

impl From<OsString> for Target {
    fn from(typed: OsString) -> Self {
        if typed == "-" { Self::Stdout } else { Self::File(typed.into()) }
    }
}

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct Size(pub(in crate::cli) [u32; 2]);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        sides.map(Self).ok_or_else(|| format!("`{text}` is not WxH, such as 1280x720"))
    }
}

/// Before the first event.
const START: &str = "start";

/// A setting by its name, and its value as JSON.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::cli) struct Setting {
    pub(in crate::cli) name: String,
    pub(in crate::cli) value: serde_json::Value,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is not NAME=VALUE, such as shadows=false");
        let (name, value) = text.split_once('=').ok_or_else(wrong)?;
        Ok(Self { name: name.into(), value: serde_json::from_str(value).map_err(|_| wrong())? })
    }
}

/// Where a replay stops: after so many events, or within the next one after a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) struct Until {
    pub(in crate::cli) events: usize,
    pub(in crate::cli) stage: Option<String>,
}

impl Until {
    /// The last event that it names; none before the first.
    pub(in crate::cli) fn event(&self) -> Option<usize> {
        if self.stage.is_some() { Some(self.events) } else { self.events.checked_sub(1) }
    }
}

impl FromStr for Until {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == START {
            return Ok(Self { events: 0, stage: None });
        }
        let (event, stage) = text.split_once('.').map_or((text, None), |(event, stage)| (event, Some(stage)));
        let wrong = || format!("not EVENT, EVENT.STAGE or {START}, such as 4 or 4.MC");
        let event: usize = event.parse().map_err(|_| wrong())?;
        let whole = event.checked_add(1).ok_or_else(wrong)?;
        Ok(Self { events: if stage.is_some() { event } else { whole }, stage: stage.map(str::to_owned) })
    }
}

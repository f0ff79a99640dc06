//! The picture of a replay's end: the frame with what was asked for drawn over it, or a map.

use super::args::{Map, Replay};
use super::failure::Failure;
use super::{orbit, pixels};
use crate::canvas::image::Image;
use crate::render::overlay::{self, Drawing};
use crate::replay::{self, Shot};
use crate::report::{Overlay, RunReport, printable};

/// The overlays that are no report's, by name.
const OURS: [(&str, Drawing<'static>); 2] = [("wire", Drawing::Wire), ("charts", Drawing::Charts)];

/// The frame, or a map, as it is in the end with what is drawn over it.
pub(super) fn of(
    typed: &Replay,
    report: &RunReport,
    replay: &mut dyn replay::Replay,
) -> Result<Image, Failure> {
    let last = report.events.iter().rev().find(|event| event.has_overlays());
    let mut drawings = drawings(&typed.overlay, last.map_or(&[], |event| &event.overlays))?;
    if !typed.select.is_empty() {
        require_elements(&typed.select, replay)?;
        drawings.push(Drawing::Marked(&typed.select));
    }
    match typed.map {
        Some(map) => over_map(map, &drawings, replay),
        None => over_frame(typed, &drawings, replay),
    }
}

fn over_frame(
    typed: &Replay,
    drawings: &[Drawing<'_>],
    replay: &mut dyn replay::Replay,
) -> Result<Image, Failure> {
    let shot = Shot { orbit: orbit::of(typed.viewpoint, replay)?, limit: None };
    let (mut frame, view) = replay.shoot(&shot).ok_or_else(|| pixels::missing(replay))?;
    if let Some(mesh) = replay.mesh() {
        overlay::draw(&mut frame.image, &view, mesh, drawings);
    }
    Ok(frame.image)
}

fn over_map(map: Map, drawings: &[Drawing<'_>], replay: &mut dyn replay::Replay) -> Result<Image, Failure> {
    let mut image = replay.map(pixels::map_id(map)).ok_or_else(|| pixels::missing(replay))?;
    if drawings.is_empty() {
        return Ok(image);
    }
    if let Some(name) = drawings.iter().find_map(in_space) {
        return Err(Failure::new(format_args!(
            "--overlay {name}: it lies in space, and a map shows faces alone"
        )));
    }
    let mesh = replay.mesh().filter(|mesh| mesh.is_textured());
    let mesh =
        mesh.ok_or_else(|| Failure::new("without texture coordinates nothing can be drawn over a map"))?;
    overlay::draw_uv(&mut image, mesh, drawings);
    Ok(image)
}

/// The name of what has no place in a map.
fn in_space<'a>(drawing: &Drawing<'a>) -> Option<&'a str> {
    match drawing {
        Drawing::Shown(overlay @ (Overlay::Line { .. } | Overlay::Points { .. })) => Some(overlay.name()),
        _ => None,
    }
}

/// An element that is not there cannot be marked.
fn require_elements(ids: &[String], replay: &dyn replay::Replay) -> Result<(), Failure> {
    let mesh = replay.mesh().ok_or_else(|| Failure::new("this engine has no elements to mark"))?;
    match overlay::missing(mesh, ids) {
        Some(id) => Err(Failure::new(format_args!(
            "--select {}: there is no such element; faces are f0 and so on, edges e0, nodes n0, vertices v0",
            printable(id)
        ))),
        None => Ok(()),
    }
}

/// What some names stand for, of what an event has to show.
fn drawings<'a>(names: &[String], shown: &'a [Overlay]) -> Result<Vec<Drawing<'a>>, Failure> {
    let mut drawings = Vec::new();
    for name in names {
        let before = drawings.len();
        drawings.extend(OURS.iter().filter(|(ours, _)| ours == name).map(|(_, drawing)| *drawing));
        drawings.extend(shown.iter().filter(|overlay| goes_by(overlay, name)).map(Drawing::Shown));
        if drawings.len() == before {
            return Err(unknown(name, shown));
        }
    }
    Ok(drawings)
}

/// Whether an overlay is called so, or its group is, in the plural too: `configurations` are all whose first word is `configuration`.
fn goes_by(overlay: &Overlay, name: &str) -> bool {
    let group = overlay.group();
    overlay.name() == name || group == name || name.strip_suffix('s').is_some_and(|one| one == group)
}

fn unknown(name: &str, shown: &[Overlay]) -> Failure {
    let mut names: Vec<&str> = OURS.iter().map(|(ours, _)| *ours).collect();
    for group in shown.iter().map(Overlay::group) {
        if !names.contains(&group) {
            names.push(group);
        }
    }
    let (name, names) = (printable(name), names.join(", "));
    Failure::new(format_args!("there is no overlay `{name}` of the last cut; there are {names}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown() -> Vec<Overlay> {
        let faces = |name: &str| Overlay::Faces { name: name.into(), faces: vec![1] };
        vec![faces("line"), faces("kind A"), faces("kind B")]
    }

    fn drawn(names: &[&str]) -> Result<Vec<String>, String> {
        let (shown, names) = (shown(), names.iter().map(ToString::to_string).collect::<Vec<_>>());
        let name = |drawing: &Drawing<'_>| match drawing {
            Drawing::Shown(overlay) => overlay.name().to_owned(),
            ours => format!("{ours:?}"),
        };
        let drawn = drawings(&names, &shown).map_err(|failure| failure.to_string())?;
        Ok(drawn.iter().map(name).collect())
    }

    #[test]
    fn overlays_go_by_their_names_and_by_their_groups() {
        assert_eq!(drawn(&["line", "wire"]).unwrap(), ["line", "Wire"]);
        assert_eq!(drawn(&["kind B"]).unwrap(), ["kind B"]);
        assert_eq!(drawn(&["kind"]).unwrap(), ["kind A", "kind B"]);
        assert_eq!(drawn(&["kinds"]).unwrap(), ["kind A", "kind B"]);
        assert!(drawn(&[]).unwrap().is_empty());
    }

    #[test]
    fn a_name_that_nothing_goes_by_is_an_error_that_says_what_there_is() {
        let error = drawn(&["line", "B"]).unwrap_err();
        assert_eq!(error, "there is no overlay `B` of the last cut; there are wire, charts, line, kind");
    }
}

//! Takes a picture of where a replay is, and draws over it what the screen wants to see.

use crate::canvas::image::Image;
use crate::render::overlay::{self, Drawing};
use crate::replay::{self, Replay};
use crate::report::{EventReport, Overlay};
use crate::tui::shot::{Drawn, Shot, Subject, Tint};

/// Takes it. An error says why there is none.
pub(super) fn take(
    replay: &mut dyn Replay,
    shown: Option<EventReport>,
    shot: &Shot,
) -> Result<Image, String> {
    let overlays = shown.map_or_else(Vec::new, |report| report.overlays);
    let drawings = drawings(&shot.drawn, &overlays);
    let missing = |replay: &dyn Replay| {
        replay.failure().map_or("this engine has no picture".into(), ToString::to_string)
    };
    match shot.subject {
        Subject::Map(map) => replay.map(map).ok_or_else(|| missing(replay)),
        Subject::Frame => {
            let wanted = replay::Shot { orbit: shot.orbit, limit: Some(shot.limit) };
            let (mut frame, view) = replay.shoot(&wanted).ok_or_else(|| missing(replay))?;
            if let Some(mesh) = replay.mesh() {
                overlay::draw(&mut frame.image, &view, mesh, &drawings);
            }
            Ok(frame.image)
        }
    }
}

/// The groups of sets of faces that a report has: the words before the first space of their names.
pub(in crate::tui) fn groups(overlays: &[Overlay]) -> Vec<&str> {
    let faces = overlays.iter().filter(|overlay| matches!(overlay, Overlay::Faces { .. }));
    let mut groups: Vec<&str> = Vec::new();
    for group in faces.map(|overlay| overlay.group()) {
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    groups
}

fn drawings<'a>(drawn: &'a Drawn, overlays: &'a [Overlay]) -> Vec<Drawing<'a>> {
    let mut drawings = Vec::new();
    match drawn.tint {
        Tint::None => {}
        Tint::Charts => drawings.push(Drawing::Charts),
        Tint::Group(at) => {
            let group = groups(overlays).get(at).copied();
            let faces = overlays.iter().filter(|o| matches!(o, Overlay::Faces { .. }));
            drawings.extend(faces.filter(|o| Some(o.group()) == group).map(Drawing::Shown));
        }
    }
    if drawn.wire {
        drawings.push(Drawing::Wire);
    }
    if drawn.lines {
        let lines = overlays.iter().filter(|o| !matches!(o, Overlay::Faces { .. }));
        drawings.extend(lines.map(Drawing::Shown));
    }
    if !drawn.marked.is_empty() {
        drawings.push(Drawing::Marked(&drawn.marked));
    }
    drawings
}

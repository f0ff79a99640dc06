//! What can be done to a session, and the events that can be recorded in one.
//!
//! Numbers are reduced to what there is where they are used, so that a deed still means something when those before it are left out.

use lancet::replay::Input;
use proptest::prelude::*;

/// Side of the recorded view, pixels.
pub(crate) const SIDE: u32 = 100;

/// Something to do.
#[derive(Clone, Debug)]
pub(crate) enum Deed {
    /// Add events at the end.
    Record(Vec<Input>),
    /// Add what is no event.
    RecordNonsense,
    /// Drop all events but the first few.
    Truncate(usize),
    /// Run the next few.
    Step(usize),
    /// Take a few back.
    Back(usize),
    /// Go to an event.
    Seek(usize),
    /// The same, but stop after so many events on the way.
    SeekAndStop(usize, usize),
    /// Stop within an event, after a stage.
    Hold(usize, &'static str),
    /// Let go of what is held.
    Release,
    /// Run all.
    Finish,
}

/// All stages there are, and none.
const STAGES: [&str; 7] = ["FC", "GP", "PP", "MC", "CI", "SD", "no such stage"];

pub(crate) fn any_deed() -> impl Strategy<Value = Deed> {
    let place = || 0..160usize;
    prop_oneof![
        4 => prop::collection::vec(any_event(), 1..6).prop_map(Deed::Record),
        1 => Just(Deed::RecordNonsense),
        2 => place().prop_map(Deed::Truncate),
        2 => (1..5usize).prop_map(Deed::Step),
        2 => (1..5usize).prop_map(Deed::Back),
        4 => place().prop_map(Deed::Seek),
        1 => (place(), 0..6usize).prop_map(|(to, after)| Deed::SeekAndStop(to, after)),
        4 => (place(), prop::sample::select(STAGES.to_vec())).prop_map(|(at, stage)| Deed::Hold(at, stage)),
        1 => Just(Deed::Release),
        2 => Just(Deed::Finish),
    ]
}

/// An event. Checkpoints get their names when they are recorded: each has one of its own.
pub(crate) fn any_event() -> impl Strategy<Value = Input> {
    prop_oneof![
        6 => (any_pick(), any_pick()).prop_map(|(from, to)| script(format!(r#"{{"cut": {{"from": {from}, "to": {to}}}}}"#))),
        4 => any_pixel().prop_map(Input::Point),
        4 => Just(Input::Undo),
        3 => Just(Input::Redo),
        2 => prop::sample::select(vec!["carve", "merge", "patch"]).prop_map(|mode| Input::Mode(mode.into())),
        2 => (any_pixel(), prop::sample::select(vec![3, 4, 6]))
            .prop_map(|([x, y], into)| script(format!(r#"{{"subdivide": {{"at": [{x}, {y}], "into": {into}}}}}"#))),
        1 => any_view().prop_map(script),
        1 => any_setting().prop_map(script),
        1 => Just(Input::Checkpoint(String::new())),
    ]
}

fn script(event: String) -> Input {
    Input::Script(event)
}

fn any_view() -> impl Strategy<Value = String> {
    // Mostly from in front, where everything is seen.
    let azimuth = prop_oneof![-0.5..0.5f64, -7.0..7.0f64];
    let angles = (azimuth, 0.5..2.6f64);
    angles.prop_map(|(azimuth, zenith)| {
        format!(r#"{{"camera": {{"azimuth": {azimuth}, "zenith": {zenith}}}}}"#)
    })
}

fn any_setting() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<bool>().prop_map(|on| format!(r#"{{"set": {{"shadows": {on}}}}}"#)),
        prop::sample::select(vec![0, 4, 1000]).prop_map(|px| format!(r#"{{"set": {{"snap_px": {px}}}}}"#)),
        (0..100u8).prop_map(|i| format!(r#"{{"set": {{"ambient": {i}, "scattering": false}}}}"#)),
    ]
}

/// A place in the view: where the model is, or anywhere, beside it and outside of the view too.
fn any_pixel() -> impl Strategy<Value = [f64; 2]> {
    let side = f64::from(SIDE);
    let inside = || 0.2 * side..0.8 * side;
    prop_oneof![
        6 => [inside(), inside()],
        // In the middle of the view symmetric models have a node, or an edge.
        1 => Just([side / 2.0; 2]),
        1 => [-5.0..side + 5.0, -5.0..side + 5.0],
    ]
}

/// A pick of every kind; some name what is not there.
fn any_pick() -> impl Strategy<Value = String> {
    let share = || prop_oneof![2 => 0.0..=1.0f64, 1 => Just(0.0), 1 => Just(0.5), 1 => Just(1.0)];
    prop_oneof![
        3 => any_pixel().prop_map(|[x, y]| format!(r#"{{"pixel": [{x}, {y}]}}"#)),
        1 => (0..30u32).prop_map(|node| format!(r#"{{"node": {node}}}"#)),
        1 => (0..60u32, share()).prop_map(|(edge, t)| format!(r#"{{"edge": [{edge}, {t}]}}"#)),
        2 => (0..40u32, share(), share()).prop_map(|(face, u, v)| {
            let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            format!(r#"{{"face": [{face}, {u}, {v}]}}"#)
        }),
    ]
}

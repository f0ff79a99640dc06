//! What can be done: one table, from which come the keys, the help, the palette, the hints of the status line and the commands that do the same.
//!
//! A row's command is what does the same, with the same data as JSON, from a shell; `command` fills in what stands in braces: the recording, the
//! place, what is drawn. What only moves about on the screen has none.

use serde::Deserialize;

/// Something that can be done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(in crate::tui) enum Action {
    NextEvent,
    PreviousEvent,
    NextStage,
    PreviousStage,
    NextCut,
    PreviousCut,
    NextCheckpoint,
    PreviousCheckpoint,
    First,
    Last,
    GoTo,
    FirstFinding,
    NextDivergence,
    Play,
    Faster,
    Slower,
    RunOn,
    Stops,
    Cancel,
    Check,
    Compare,
    CompareWith,
    Up,
    Down,
    PageUp,
    PageDown,
    Top,
    Bottom,
    Select,
    SelectNothing,
    Copy,
    CopyCommand,
    NextTable,
    FocusNext,
    FocusPrevious,
    FocusTimeline,
    FocusStages,
    FocusMesh,
    FocusPicture,
    FocusTables,
    FocusChecks,
    FocusDifferences,
    Maximise,
    Wire,
    Lines,
    Tint,
    Subject,
    Split,
    SplitLeft,
    SplitRight,
    OrbitLeft,
    OrbitRight,
    OrbitUp,
    OrbitDown,
    Nearer,
    Farther,
    ZoomIn,
    ZoomOut,
    PanLeft,
    PanRight,
    PanUp,
    PanDown,
    ResetView,
    SaveFrame,
    Record,
    RecordNew,
    Point,
    CrossLeft,
    CrossRight,
    CrossUp,
    CrossDown,
    NudgeLeft,
    NudgeRight,
    NudgeUp,
    NudgeDown,
    Mode,
    Undo,
    Redo,
    Checkpoint,
    Event,
    Drop,
    Save,
    Open,
    Help,
    Palette,
    Search,
    NextMatch,
    PreviousMatch,
    Suspend,
    Redraw,
    Quit,
    Leave,
}

/// Where an action's keys count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tui) enum Scope {
    /// Everywhere.
    Always,
    /// While a pane with rows is focused.
    List,
    /// While the picture is focused.
    Picture,
    /// While a recording is being made.
    Recording,
}

/// A row of the table.
#[derive(Debug, PartialEq, Eq)]
pub(in crate::tui) struct Row {
    /// What is done.
    pub(in crate::tui) action: Action,
    /// Its name in the palette and in the configuration.
    pub(in crate::tui) name: &'static str,
    /// What it does, for people.
    pub(in crate::tui) does: &'static str,
    /// Its keys, unless the configuration has others.
    pub(in crate::tui) keys: &'static [&'static str],
    /// Where they count.
    pub(in crate::tui) scope: Scope,
    /// The command that does the same.
    pub(in crate::tui) command: Option<&'static str>,
}

macro_rules! actions {
    ($($action:ident $name:literal $scope:ident [$($key:literal),*] $does:literal $(=> $command:literal)?;)*) => {
        &[$(Row {
            action: Action::$action,
            name: $name,
            does: $does,
            keys: &[$($key),*],
            scope: Scope::$scope,
            command: actions!(@ $($command)?),
        }),*]
    };
    (@ $command:literal) => { Some($command) };
    (@) => { None };
}

/// All of them, in the order of the help.
pub(in crate::tui) const ACTIONS: &[Row] = actions! {
    NextEvent "next-event" Always ["l", "right"] "Step one event on" => "replay {rec} --until {place} --pixels --json -";
    PreviousEvent "previous-event" Always ["h", "left"] "Step one event back" => "replay {rec} --until {place} --pixels --json -";
    NextStage "next-stage" Always ["s", "shift-right"] "Step one stage on" => "replay {rec} --until {place} --pixels --json -";
    PreviousStage "previous-stage" Always ["S", "shift-left"] "Step one stage back" => "replay {rec} --until {place} --pixels --json -";
    NextCut "next-cut" Always ["c"] "Go to the next cut" => "replay {rec} --until {place} --pixels --json -";
    PreviousCut "previous-cut" Always ["C"] "Go to the cut before" => "replay {rec} --until {place} --pixels --json -";
    NextCheckpoint "next-checkpoint" Always ["]"] "Go to the next checkpoint" => "replay {rec} --until {place} --pixels --json -";
    PreviousCheckpoint "previous-checkpoint" Always ["["] "Go to the checkpoint before" => "replay {rec} --until {place} --pixels --json -";
    First "first" Always ["home"] "Go to before the first event" => "replay {rec} --until {place} --pixels --json -";
    Last "last" Always ["end"] "Go to after the last event" => "replay {rec} --pixels --json -";
    GoTo "go-to" Always ["#"] "Go to an event by its number, or to a stage of it, such as 4.2" => "replay {rec} --until {place} --pixels --json -";
    FirstFinding "first-finding" Always ["f"] "Go to the first broken invariant" => "replay {rec} --stop-at finding --pixels --json -";
    NextDivergence "next-divergence" Always ["d"] "Go to the next divergence from what it is compared with" => "{compare} --json -";
    Play "play" Always ["space"] "Play on at a pace, or pause" => "replay {rec} --pixels --json -";
    Faster "faster" Always [">"] "Play faster";
    Slower "slower" Always ["<"] "Play slower";
    RunOn "run-on" Always ["R"] "Run on to where one of the breakpoints holds, or to the end" => "replay {rec} {stops} --pixels --json -";
    Stops "breakpoints" Always ["b"] "Set, look at and drop breakpoints" => "replay {rec} {stops} --pixels --json -";
    Cancel "cancel" Always ["esc"] "Stop what is going on; close what is open";
    Check "check" Always ["v"] "Look at the invariants of the whole state, here" => "replay {rec} --until {place} --paranoid --pixels --json -";
    Compare "compare" Always ["="] "Compare the run with its goldens" => "verify {rec} --json -";
    CompareWith "compare-with" Always ["+"] "Compare the run with another run's JSON" => "diff {json} {rec} --json -";
    Up "up" List ["k", "up"] "Go one row up";
    Down "down" List ["j", "down"] "Go one row down";
    PageUp "page-up" List ["pgup", "ctrl-u"] "Go a page up";
    PageDown "page-down" List ["pgdn", "ctrl-d"] "Go a page down";
    Top "top" List ["g"] "Go to the first row";
    Bottom "bottom" List ["G"] "Go to the last row";
    Select "select" List ["enter"] "Select what the row is about, everywhere" => "replay {rec} --until {place} --frame {png} {select}";
    SelectNothing "select-nothing" Always ["x"] "Select nothing";
    Copy "copy" Always ["y"] "Copy what is selected" => "replay {rec} --until {place} --pixels --json -";
    CopyCommand "copy-command" Always ["Y"] "Copy the command that shows the same as this screen" => "replay {rec} --until {place} --json - --frame {png} {shown}";
    NextTable "next-table" Always ["t"] "Show the next table" => "replay {rec} --until {place} --pixels --json -";
    FocusNext "focus-next" Always ["tab"] "Go to the next pane";
    FocusPrevious "focus-previous" Always ["shift-tab"] "Go to the pane before";
    FocusTimeline "focus-timeline" Always ["1"] "Go to the timeline";
    FocusStages "focus-stages" Always ["2"] "Go to the stages";
    FocusMesh "focus-mesh" Always ["3"] "Go to the mesh";
    FocusPicture "focus-picture" Always ["4"] "Go to the picture";
    FocusTables "focus-tables" Always ["5"] "Go to the tables";
    FocusChecks "focus-checks" Always ["6"] "Go to the invariants";
    FocusDifferences "focus-differences" Always ["7"] "Go to the differences";
    Maximise "maximise" Always ["z"] "Show the focused pane alone, or all again";
    Wire "wire" Always ["w"] "Draw the mesh's edges over the picture" => "replay {rec} --until {place} --frame {png} --overlay wire";
    Lines "lines" Always ["i"] "Draw the line and the picks over the picture" => "replay {rec} --until {place} --frame {png} {lines}";
    Tint "tint" Always ["o"] "Colour the faces by chart, or by what the report groups them by" => "replay {rec} --until {place} --frame {png} {tint}";
    Subject "subject" Always ["m"] "Show the next map, or the frame again" => "replay {rec} --until {place} --frame {png} {map}";
    Split "golden" Always ["M"] "Show the golden picture, the difference, or the frame again" => "verify {rec} --html {dir}";
    SplitLeft "split-left" Picture ["{"] "Move the slider between golden and actual to the left";
    SplitRight "split-right" Picture ["}"] "Move the slider between golden and actual to the right";
    OrbitLeft "orbit-left" Picture ["left", "H"] "Look from further left" => "replay {rec} --until {place} --frame {png} --azimuth {azimuth}";
    OrbitRight "orbit-right" Picture ["right", "L"] "Look from further right" => "replay {rec} --until {place} --frame {png} --azimuth {azimuth}";
    OrbitUp "orbit-up" Picture ["up", "K"] "Look from further up" => "replay {rec} --until {place} --frame {png} --zenith {zenith}";
    OrbitDown "orbit-down" Picture ["down", "J"] "Look from further down" => "replay {rec} --until {place} --frame {png} --zenith {zenith}";
    Nearer "nearer" Picture ["."] "Look from nearer" => "replay {rec} --until {place} --frame {png} --distance {distance}";
    Farther "farther" Picture [","] "Look from farther away" => "replay {rec} --until {place} --frame {png} --distance {distance}";
    ZoomIn "zoom-in" Picture ["pgup"] "Enlarge the picture";
    ZoomOut "zoom-out" Picture ["pgdn"] "Reduce the picture";
    PanLeft "pan-left" Picture ["alt-left"] "Move to the left in the enlarged picture";
    PanRight "pan-right" Picture ["alt-right"] "Move to the right in the enlarged picture";
    PanUp "pan-up" Picture ["alt-up"] "Move up in the enlarged picture";
    PanDown "pan-down" Picture ["alt-down"] "Move down in the enlarged picture";
    ResetView "reset-view" Always ["0"] "Look from where the recording does, at all of it" => "replay {rec} --until {place} --frame {png}";
    SaveFrame "save-picture" Always ["P"] "Write the picture as PNG" => "replay {rec} --until {place} --frame {png} {shown}";
    Record "record" Always ["r"] "Record on from here, in a copy; or stop recording" => "pack {script} -o {rec}";
    RecordNew "record-new" Always ["ctrl-n"] "Record anew, on a scene" => "pack {script} -o {rec}";
    Point "point" Recording ["enter"] "Point at the cross-hair: two points make a cut" => "pack {script} -o {rec}";
    CrossLeft "cross-left" Recording ["left"] "Move the cross-hair to the left";
    CrossRight "cross-right" Recording ["right"] "Move the cross-hair to the right";
    CrossUp "cross-up" Recording ["up"] "Move the cross-hair up";
    CrossDown "cross-down" Recording ["down"] "Move the cross-hair down";
    NudgeLeft "nudge-left" Recording ["shift-left"] "Move the cross-hair by a pixel of the recorded view to the left";
    NudgeRight "nudge-right" Recording ["shift-right"] "Move it by a pixel to the right";
    NudgeUp "nudge-up" Recording ["shift-up"] "Move it by a pixel up";
    NudgeDown "nudge-down" Recording ["shift-down"] "Move it by a pixel down";
    Mode "mode" Recording ["e"] "Choose the next mode" => "pack {script} -o {rec}";
    Undo "undo" Recording ["u"] "Undo the last edit" => "pack {script} -o {rec}";
    Redo "redo" Recording ["ctrl-r"] "Do it again" => "pack {script} -o {rec}";
    Checkpoint "checkpoint" Recording ["a"] "Set a checkpoint with a name" => "pack {script} -o {rec}";
    Event "event" Recording ["n"] "Type an event as it stands in a script" => "pack {script} -o {rec}";
    Drop "drop" Recording ["backspace"] "Drop the last event" => "pack {script} -o {rec}";
    Save "save" Always ["ctrl-s"] "Save the recording" => "pack {script} -o {rec}";
    Open "open" Always ["ctrl-o"] "Open a recording" => "info {rec} --json -";
    Help "help" Always ["?", "f1"] "Show all keys";
    Palette "palette" Always [":"] "Find an action by its name";
    Search "search" Always ["/"] "Search the timeline and the tables" => "replay {rec} --pixels --json -";
    NextMatch "next-match" Always ["n"] "Go to the next match";
    PreviousMatch "previous-match" Always ["N"] "Go to the match before";
    Suspend "suspend" Always ["ctrl-z"] "Go to the background";
    Redraw "redraw" Always ["ctrl-l"] "Draw the screen anew";
    Quit "quit" Always ["q"] "Leave; asks what becomes of a recording that is not saved";
    Leave "leave" Always ["ctrl-c"] "Leave at once; a recording that is not saved stays as a draft";
};

impl Action {
    /// Its row. The rows are in the order of the actions, which a test sees to.
    pub(in crate::tui) fn row(self) -> &'static Row {
        &ACTIONS[self as usize]
    }

    /// Whether its keys count whatever lies over the panes.
    pub(in crate::tui) fn passes_popups(self) -> bool {
        matches!(self, Self::Suspend | Self::Redraw | Self::Leave)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rows_are_in_the_order_of_the_actions_and_no_name_is_there_twice() {
        let mut names: Vec<&str> = ACTIONS.iter().map(|row| row.name).collect();
        assert!(ACTIONS.iter().enumerate().all(|(at, row)| row.action as usize == at));
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), ACTIONS.len());
    }
}

//! What a run is compared with, and how it differs: plain data, made by the worker and shown by panes.
//!
//! A comparison is of the recording's file with its goldens or with another run, and is made by a run of its own; what is on the screen goes on.
//! All that was found becomes one list, in the order of the run: what there is to say of the comparison as a whole comes first, and a checkpoint's
//! picture after what differs at its event.

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::report::printable;
use crate::tui::model::{Model, Place};
use crate::verify::{Compared, ComparedPicture, Diff, Divergence, Verdict};

/// What to compare with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum With {
    /// The recording's goldens.
    Goldens,
    /// Another run: the report of a replay, or a recording or a script, which is replayed.
    Run(PathBuf),
}

impl With {
    /// Its name, for people.
    pub(in crate::tui) fn name(&self) -> String {
        match self {
            Self::Goldens => "the goldens".into(),
            Self::Run(path) => printable(path.display()),
        }
    }
}

/// A comparison to be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::tui) struct Job {
    /// Tells it from others; 0 is none.
    pub(in crate::tui) number: u64,
    /// The recording's file.
    pub(in crate::tui) path: PathBuf,
    /// What it is compared with.
    pub(in crate::tui) with: With,
}

/// The comparison that is being made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::tui) struct Comparing {
    /// Which.
    pub(in crate::tui) job: Job,
    /// How many events have run.
    pub(in crate::tui) done: usize,
    /// Of how many; 0 where that is not known yet.
    pub(in crate::tui) of: usize,
    /// Whether to go to the next divergence once it is made.
    pub(in crate::tui) then_go: bool,
}

/// The comparisons of the whole time that the program runs.
#[derive(Clone, Debug, Default)]
pub(in crate::tui) struct Comparisons {
    /// How many were begun.
    pub(in crate::tui) begun: u64,
    /// What the first recording is to be compared with as soon as it is open.
    pub(in crate::tui) first: Option<With>,
    /// Why there is no comparison, where the last one could not be made.
    pub(in crate::tui) refused: Option<String>,
}

impl Comparisons {
    /// None yet, but one to begin with.
    pub(in crate::tui) fn first(with: Option<With>) -> Self {
        Self { first: with, ..Self::default() }
    }
}

/// Where in a run something differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::tui) enum At {
    /// Before the first event.
    Start,
    /// At an event.
    Event(usize),
    /// After the last one.
    End,
}

/// Something that there is to say.
#[derive(Clone, Debug)]
pub(in crate::tui) enum Row {
    /// Of the comparison as a whole: a golden that is missing, something that only one side knows.
    Problem(String),
    /// A value that differs.
    Value(Divergence),
    /// A checkpoint's picture, whether it differs or not: its place among the pictures.
    Picture(usize),
}

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::tui) struct Differences {
    /// What it is compared with.
    pub(in crate::tui) with: With,
    /// All that there is to say, in the order of the run.
    pub(in crate::tui) rows: Vec<Row>,
    /// The checkpoints' pictures beside their goldens.
    pub(in crate::tui) pictures: Vec<ComparedPicture>,
    /// How many values differ; of very many only the first have a row.
    pub(in crate::tui) differing: usize,
    /// How many invariants broke on the way.
    pub(in crate::tui) findings: usize,
    /// Whether nothing is wrong.
    pub(in crate::tui) verified: bool,
    /// The events at which something differs.
    events: BTreeSet<usize>,
}

impl Differences {
    /// Of a run from its goldens.
    pub(in crate::tui) fn from_goldens(compared: Compared) -> Self {
        let report = compared.report;
        let new = report.new.iter().map(|what| format!("the goldens do not know {what}"));
        let problems = report.error.into_iter().chain(report.goldens).chain(new);
        Self {
            findings: report.findings.len(),
            verified: report.verdict == Verdict::Verified,
            ..Self::new(With::Goldens, problems, report.divergences, report.differing, compared.pictures)
        }
    }

    /// Of a run from another one.
    pub(in crate::tui) fn from_run(with: With, diff: Diff) -> Self {
        let verified = diff.is_empty();
        let inputs = diff.inputs.map(|inputs| format!("the inputs differ first in {inputs}"));
        let new = diff.new.iter().map(|what| format!("the other run does not know {what}"));
        let problems = inputs.into_iter().chain(new);
        Self { verified, ..Self::new(with, problems, diff.divergences, diff.differing, Vec::new()) }
    }

    fn new(
        with: With,
        problems: impl Iterator<Item = String>,
        divergences: Vec<Divergence>,
        differing: usize,
        pictures: Vec<ComparedPicture>,
    ) -> Self {
        let shown = divergences.into_iter().map(Row::Value).chain((0..pictures.len()).map(Row::Picture));
        let mut rows: Vec<Row> = problems.map(Row::Problem).chain(shown).collect();
        let (verified, findings, events) = (false, 0, BTreeSet::new());
        let mut all = Self { with, rows: Vec::new(), pictures, differing, findings, verified, events };
        rows.sort_by_key(|row| all.at(row));
        let differ = rows.iter().filter(|row| !all.is_fine(row));
        all.events = differ.filter_map(|row| all.event(row)).collect();
        Self { rows, ..all }
    }

    /// Where a row is about; none of the comparison as a whole.
    pub(in crate::tui) fn at(&self, row: &Row) -> Option<At> {
        match row {
            Row::Problem(_) => None,
            Row::Picture(at) => self.pictures.get(*at).map(|picture| At::Event(picture.event)),
            // What is before the first event and what is after the last have no event; their names say which.
            Row::Value(value) => Some(match value.event {
                Some(event) => At::Event(event),
                None if value.what.starts_with("scene ") => At::Start,
                None => At::End,
            }),
        }
    }

    fn event(&self, row: &Row) -> Option<usize> {
        match self.at(row)? {
            At::Event(event) => Some(event),
            At::Start | At::End => None,
        }
    }

    /// Whether there is nothing wrong in a row.
    pub(in crate::tui) fn is_fine(&self, row: &Row) -> bool {
        match row {
            Row::Picture(at) => self.pictures.get(*at).is_some_and(|picture| picture.report.is_fine()),
            Row::Problem(_) | Row::Value(_) => false,
        }
    }

    /// Whether something differs at an event.
    pub(in crate::tui) fn has(&self, event: usize) -> bool {
        self.events.contains(&event)
    }

    /// The elements that a row is about: one, or both ends of a block of them.
    pub(in crate::tui) fn ids(&self, row: &Row) -> Vec<String> {
        let Row::Value(Divergence { element: Some(element), .. }) = row else { return Vec::new() };
        element.split("..").filter(|id| is_id(id)).map(str::to_owned).collect()
    }
}

/// What it came to, on a line.
pub(in crate::tui) fn verdict(differences: &Differences) -> String {
    let Differences { rows, pictures, differing, findings, verified, with, .. } = differences;
    let beyond = pictures.iter().filter(|picture| !picture.report.is_fine()).count();
    let problems = rows.iter().filter(|row| matches!(row, Row::Problem(_))).count();
    if *verified {
        let pictures = match pictures.len() {
            0 => String::new(),
            count => format!(", {count} pictures too"),
        };
        return format!("the same as {}{pictures}", with.name());
    }
    let counted = [
        (*differing, "values differ"),
        (beyond, "pictures differ"),
        (*findings, "invariants broke"),
        (problems, "problems"),
    ];
    let parts = counted.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
    format!("not as {}: {}", with.name(), parts.collect::<Vec<_>>().join(", "))
}

/// Whether a word names an element, as `n120` does.
fn is_id(word: &str) -> bool {
    let digits = word.trim_start_matches(|letter: char| letter.is_ascii_lowercase());
    digits.len() < word.len() && !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit())
}

/// The first value that differs at an event.
pub(in crate::tui) fn marks(model: &Model, event: usize) -> Option<&Divergence> {
    let rows = &model.differences.as_ref()?.rows;
    rows.iter().find_map(|row| match row {
        Row::Value(value) if value.event == Some(event) => Some(value),
        _ => None,
    })
}

/// The picture of the checkpoint at a place, beside its golden.
pub(in crate::tui) fn picture(model: &Model, place: Place) -> Option<&ComparedPicture> {
    let event = place.event().filter(|_| place.stage.is_none())?;
    model.differences.as_ref()?.pictures.iter().find(|picture| picture.event == event)
}

/// The place at which a row can be looked at: after its stage, where the stages of its event are known, else after its event.
pub(in crate::tui) fn place(model: &Model, row: usize) -> Option<Place> {
    let differences = model.differences.as_ref()?;
    let row = differences.rows.get(row)?;
    Some(match differences.at(row)? {
        At::Start => Place::START,
        At::End => Place::after(model.len()),
        At::Event(event) => match row {
            Row::Value(Divergence { stage: Some(stage), .. }) => after_stage(model, event, stage),
            _ => Place::after(event + 1),
        },
    })
}

/// After the last stage the event is over.
fn after_stage(model: &Model, event: usize, stage: &str) -> Place {
    let stages = model.report(event).map_or(&[][..], |report| &report.stages);
    let ran = |row: &usize| stages[*row].skipped.is_none();
    let row = (0..stages.len()).filter(ran).find(|row| stages[*row].id == stage);
    let last = (0..stages.len()).rfind(ran);
    match row.filter(|_| row != last) {
        Some(row) => Place { events: event, stage: Some(row) },
        None => Place::after(event + 1),
    }
}

#[cfg(test)]
pub(in crate::tui) mod tests;

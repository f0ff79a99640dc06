//! The ladders as tables: what happened on every rung, and where each program's usable range ends.

use schemars::JsonSchema;
use serde::Serialize;

use super::ladders::{LADDERS, Ladder};
use super::plot;
use super::rung::{Found, Ours, Rung, Theirs};
use crate::measure::figure::table;
use crate::measure::stability::Options;
use crate::measure::stability::report::StabilityFinding;
use crate::report::Table;

/// The rungs next to the scene as it is on which nothing failed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Until {
    /// Not even on the scene as it is.
    Nowhere,
    /// On every rung.
    All,
    /// From one rung to another.
    Within(f64, f64),
}

/// One ladder.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LadderReport {
    /// What is changed.
    pub name: String,
    /// What the number of a rung counts.
    pub unit: String,
    /// Its rungs.
    pub rungs: Vec<Rung>,
    /// Where no invariant broke, and every line was the exact one.
    pub ours: Until,
    /// The rung from which on cuts are refused because they are below the resolution of the coordinates.
    pub below_resolution_from: Option<f64>,
    /// Where the plain program in f32 failed in no cut.
    pub plain_f32: Until,
    /// The same in f64.
    pub plain_f64: Until,
}

/// Every ladder.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct RangesReport {
    /// Cuts of a rung that were asked for.
    pub per_rung: usize,
    /// All cuts.
    pub cuts: usize,
    /// One after another.
    pub ladders: Vec<LadderReport>,
    #[serde(skip)]
    pub(in crate::measure::stability) findings: Vec<StabilityFinding>,
}

impl RangesReport {
    pub(super) fn join(options: &Options, rungs: impl Iterator<Item = (usize, (Rung, Vec<Found>))>) -> Self {
        let mut report = Self { per_rung: options.per_rung, ..Self::default() };
        let mut by_ladder: Vec<Vec<Rung>> = vec![Vec::new(); LADDERS.len()];
        for (number, (ladder, (rung, found))) in rungs.enumerate() {
            report.cuts += rung.cuts;
            by_ladder[ladder].push(rung);
            let finding = |f: Found| StabilityFinding::of(&f.kind, options.seed, number, &f.scene, &f.broken);
            report.findings.extend(found.into_iter().map(finding));
        }
        report.ladders =
            LADDERS.iter().zip(by_ladder).map(|(ladder, rungs)| LadderReport::new(ladder, rungs)).collect();
        report
    }

    /// The report for people: the ranges, then every ladder.
    pub fn tables(&self) -> Vec<Table> {
        if self.ladders.is_empty() {
            return Vec::new();
        }
        let title = format!("Usable ranges: {} cuts on every rung", self.per_rung);
        let columns = [
            "what grows, and what a rung counts",
            "engine holds",
            "refuses below-resolution from",
            "f64 with ε holds",
            "f32 with ε holds",
        ];
        let ranges = table(&title, &columns, self.ladders.iter().map(LadderReport::range));
        std::iter::once(ranges).chain(self.ladders.iter().map(LadderReport::table)).collect()
    }
}

impl LadderReport {
    /// A picture of it, as an SVG document, and the name of its file.
    pub fn plot(&self) -> (String, String) {
        (format!("stability-{}.svg", self.name.replace(' ', "-")), plot::svg(self))
    }

    pub(super) fn new(ladder: &Ladder, rungs: Vec<Rung>) -> Self {
        let below = |ours: &Ours| ours.refused.contains_key("below-resolution");
        let refusing = outward(&rungs).find(|rung| below(&rung.ours)).map(|rung| rung.value);
        Self {
            name: ladder.name.into(),
            unit: ladder.unit.into(),
            ours: Until::of(&rungs, |rung| rung.ours.findings == 0),
            below_resolution_from: refusing,
            plain_f32: Until::of(&rungs, |rung| rung.plain_f32.holds()),
            plain_f64: Until::of(&rungs, |rung| rung.plain_f64.holds()),
            rungs,
        }
    }

    fn range(&self) -> Vec<String> {
        vec![
            format!("{}: {}", self.name, self.unit),
            self.ours.text(),
            self.below_resolution_from.map_or_else(|| "never".into(), number),
            self.plain_f64.text(),
            self.plain_f32.text(),
        ]
    }

    fn table(&self) -> Table {
        let title = format!("{}: {}", capitalised(&self.name), self.unit);
        let columns = [
            "rung",
            "cuts",
            "applied",
            "refused",
            "below-resolution",
            "findings",
            "f64 with ε lost",
            "wrong",
            "f32 with ε lost",
            "wrong",
        ];
        table(&title, &columns, self.rungs.iter().map(Rung::cells))
    }
}

impl Until {
    pub(super) fn of(rungs: &[Rung], holds: impl Fn(&Rung) -> bool) -> Self {
        let start = start(rungs);
        let down = rungs[..start].iter().rev().take_while(|rung| holds(rung)).count();
        let up = rungs[start..].iter().take_while(|rung| holds(rung)).count();
        match (up, down + up == rungs.len()) {
            (0, _) => Self::Nowhere,
            (_, true) => Self::All,
            _ => Self::Within(rungs[start - down].value, rungs[start + up - 1].value),
        }
    }

    /// In words.
    pub fn text(self) -> String {
        match self {
            Self::Nowhere => "nowhere".into(),
            Self::All => "everywhere".into(),
            Self::Within(from, to) if from == to => format!("at {} only", number(from)),
            Self::Within(from, to) => format!("{} to {}", number(from), number(to)),
        }
    }
}

/// The rung on which the scene is as it is: the one that scales by 1, or the first.
fn start(rungs: &[Rung]) -> usize {
    rungs.iter().position(|rung| rung.value == 1.0 && rungs[0].value != 0.0).unwrap_or(0)
}

/// The rungs from the scene as it is outwards.
fn outward(rungs: &[Rung]) -> impl Iterator<Item = &Rung> {
    let (down, up) = rungs.split_at(start(rungs).min(rungs.len()));
    up.iter().chain(down.iter().rev())
}

impl Rung {
    fn cells(&self) -> Vec<String> {
        let below = self.ours.refused.get("below-resolution").copied().unwrap_or(0);
        let theirs = |t: &Theirs| [seen(t.lost()), seen(t.wrong())];
        let mut cells = vec![
            number(self.value),
            self.cuts.to_string(),
            self.ours.applied.to_string(),
            seen(self.ours.refused.values().sum()),
            seen(below),
            seen(self.ours.findings),
        ];
        cells.extend([&self.plain_f64, &self.plain_f32].into_iter().flat_map(theirs));
        cells
    }
}

/// A count; a dot for none, so that it is seen where something begins.
fn seen(count: usize) -> String {
    if count == 0 { "·".into() } else { count.to_string() }
}

/// A rung's number: powers of ten as such.
pub(super) fn number(value: f64) -> String {
    let short = format!("{value:e}");
    if short.starts_with("1e") && !(1.0..100.0).contains(&value) { short } else { value.to_string() }
}

pub(super) fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

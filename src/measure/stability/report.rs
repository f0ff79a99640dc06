//! What the cuts came to, all parts together.

use std::collections::BTreeMap;
use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use super::Options;
use super::cuts::Kind;
use super::part::{Broken, Part, Tally};
use super::ranges::RangesReport;
use super::reproduce::{self, Reproduction};
use super::scenes::Prepared;
use crate::assets::AssetError;
use crate::measure::figure::table;
use crate::report::{Check, Table};

/// How the cuts of one scene, or of one kind, ended.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Sum {
    /// The scene or the kind.
    pub name: String,
    /// How many cuts.
    pub cuts: usize,
    /// Those with surface under both picks.
    pub two_hits: usize,
    /// Those that were applied.
    pub applied: usize,
    /// Two hits between random pixels.
    pub random_two_hits: usize,
    /// Those of them that were applied.
    pub random_applied: usize,
    /// Those that were rejected, by reason.
    pub rejected: BTreeMap<String, usize>,
}

/// A broken invariant, or a panic.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StabilityFinding {
    /// The scene.
    pub scene: String,
    /// The part of the run.
    pub part: usize,
    /// The cut within the part.
    pub cut: usize,
    /// The stage, or `state`, `rollback`, `panic`.
    pub stage: String,
    /// The invariant, with what is wrong.
    pub check: Check,
    /// A script that leads there.
    pub script: String,
    #[serde(skip)]
    reproduction: Reproduction,
}

/// What all cuts came to.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StabilityReport {
    /// What the cuts were drawn from.
    pub seed: u64,
    /// How many were asked for. A part that breaks something makes fewer.
    pub asked: usize,
    /// How many were made.
    pub cuts: usize,
    /// How many were applied.
    pub applied: usize,
    /// How many were rejected, by reason.
    pub rejected: BTreeMap<String, usize>,
    /// Applied after an end of the line was moved to a node.
    pub snapped: usize,
    /// Applied with a narrower opening than planned.
    pub narrowed: usize,
    /// Applied with a shallower gutter than planned.
    pub shallowed: usize,
    /// By scene.
    pub scenes: Vec<Sum>,
    /// By kind of cut.
    pub kinds: Vec<Sum>,
    /// How far one can go.
    pub ranges: RangesReport,
    /// What broke, in the random cuts and on the ladders.
    pub findings: Vec<StabilityFinding>,
}

impl StabilityReport {
    pub(super) fn join(
        options: &Options,
        scenes: &[Prepared],
        parts: Vec<Part>,
        mut ranges: RangesReport,
    ) -> Self {
        let on_ladders = std::mem::take(&mut ranges.findings);
        let all = sum(&parts, |_, _| true);
        let scene = |(i, scene): (usize, &Prepared)| {
            let here = |part: &Part| part.number % scenes.len() == i;
            let random = sum(&parts, |part, kind| here(part) && kind == Kind::Random);
            Sum::new(&scene.name, &sum(&parts, |part, _| here(part)), &random)
        };
        let kind = |wanted: Kind| {
            let random = sum(&parts, |_, kind| kind == wanted && kind == Kind::Random);
            Sum::new(wanted.title(), &sum(&parts, |_, kind| kind == wanted), &random)
        };
        Self {
            seed: options.seed,
            asked: options.cuts,
            cuts: all.cuts,
            applied: all.applied,
            snapped: all.snapped,
            narrowed: all.narrowed,
            shallowed: all.shallowed,
            scenes: scenes.iter().enumerate().map(scene).collect(),
            kinds: Kind::ALL.into_iter().map(kind).collect(),
            findings: parts
                .iter()
                .flat_map(|part| findings(options.seed, scenes, part))
                .chain(on_ladders)
                .collect(),
            ranges,
            rejected: all.rejected,
        }
    }

    /// What became of the cuts, all of them and by kind.
    fn outcomes(&self) -> Table {
        let columns: Vec<&str> =
            ["outcome", "cuts"].into_iter().chain(self.kinds.iter().map(|kind| kind.name.as_str())).collect();
        let whole =
            [("  snapped", self.snapped), ("  narrowed", self.narrowed), ("  shallowed", self.shallowed)];
        let whole = whole.map(|(name, count)| vec![name.to_owned(), count.to_string()]);
        let by_kind = |name: String, all: usize, of: &dyn Fn(&Sum) -> usize| {
            let kinds = self.kinds.iter().map(|kind| of(kind).to_string());
            [name, all.to_string()].into_iter().chain(kinds).collect()
        };
        let rejected = self.rejected.iter().map(|(reason, all)| {
            by_kind(format!("rejected: {reason}"), *all, &|sum| {
                sum.rejected.get(reason).copied().unwrap_or(0)
            })
        });
        let applied = by_kind("applied".into(), self.applied, &|sum| sum.applied);
        table("Outcomes", &columns, [applied].into_iter().chain(whole).chain(rejected))
    }

    /// How many cuts were made, on the ladders too.
    pub fn all_cuts(&self) -> usize {
        self.cuts + self.ranges.cuts
    }

    /// Writes the scripts of all findings into a folder.
    pub fn save_findings(&self, folder: &Path) -> Result<(), AssetError> {
        self.findings.iter().try_for_each(|finding| finding.reproduction.save(folder))
    }

    /// The report for people, but for the findings.
    pub fn tables(&self) -> Vec<Table> {
        let sums = |title: &str, what: &str, sums: &[Sum]| {
            let columns = [what, "cuts", "two hits", "applied", "%", "random two hits", "applied", "%"];
            table(title, &columns, sums.iter().map(Sum::cells))
        };
        let title = format!("{} cuts, seed {}", self.cuts, self.seed);
        let mut tables =
            vec![sums(&title, "scene", &self.scenes), sums("By kind", "kind", &self.kinds), self.outcomes()];
        tables.extend(self.ranges.tables());
        tables
    }
}

/// The tally of all cuts that are wanted.
fn sum(parts: &[Part], wanted: impl Fn(&Part, Kind) -> bool) -> Tally {
    let mut sum = Tally::default();
    for part in parts {
        part.tallies.iter().filter(|(kind, _)| wanted(part, **kind)).for_each(|(_, tally)| sum.add(tally));
    }
    sum
}

fn findings(seed: u64, scenes: &[Prepared], part: &Part) -> Vec<StabilityFinding> {
    let scene = &scenes[part.number % scenes.len()];
    let finding = |broken| StabilityFinding::of("stability", seed, part.number, scene, broken);
    part.broken.iter().map(finding).collect()
}

impl StabilityFinding {
    pub(super) fn of(kind: &str, seed: u64, part: usize, scene: &Prepared, broken: &Broken) -> Self {
        let reproduction = reproduce::of(kind, seed, part, scene, broken);
        Self {
            scene: scene.name.clone(),
            part,
            cut: broken.cut,
            stage: broken.stage.clone(),
            check: broken.check.clone(),
            script: reproduction.script.clone(),
            reproduction,
        }
    }

    /// File name of its script.
    pub fn file(&self) -> &str {
        &self.reproduction.name
    }
}

impl Sum {
    fn new(name: &str, all: &Tally, random: &Tally) -> Self {
        Self {
            name: name.into(),
            cuts: all.cuts,
            two_hits: all.two_hits,
            applied: all.applied,
            random_two_hits: random.two_hits,
            random_applied: random.applied,
            rejected: all.rejected.clone(),
        }
    }

    fn cells(&self) -> Vec<String> {
        let share = |part: usize, of: usize| match of {
            0 => String::new(),
            _ => format!("{:.2}", 100.0 * part as f64 / of as f64),
        };
        vec![
            self.name.clone(),
            self.cuts.to_string(),
            self.two_hits.to_string(),
            self.applied.to_string(),
            share(self.applied, self.two_hits),
            self.random_two_hits.to_string(),
            self.random_applied.to_string(),
            share(self.random_applied, self.random_two_hits),
        ]
    }
}

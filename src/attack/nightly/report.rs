//! What a night has to say.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;

use crate::report::{Row, Table};

/// How a part ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Nothing was found.
    Passed,
    /// Something was.
    Failed,
    /// It could not run.
    Unable,
}

impl Verdict {
    /// A word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Failed => "failed",
            Self::Unable => "unable",
        }
    }
}

/// Something that broke.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NightFinding {
    /// What is wrong.
    pub detail: String,
    /// What leads to it: a recording or a script where there is one, else an input of the target.
    pub file: Option<PathBuf>,
}

/// A part of the night.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Part {
    /// Such as `verify` or `fuzz pick`.
    pub name: String,
    /// How long it took.
    pub seconds: f64,
    /// How it ended.
    pub verdict: Verdict,
    /// How many recordings, cuts or inputs.
    pub count: u64,
    /// What there is to say beside that.
    pub detail: String,
    /// What was found.
    pub findings: Vec<NightFinding>,
}

impl Part {
    /// A part that ran; it failed if it found something.
    pub(super) fn ran(count: u64, detail: impl Into<String>, findings: Vec<NightFinding>) -> Self {
        let verdict = if findings.is_empty() { Verdict::Passed } else { Verdict::Failed };
        Self { name: String::new(), seconds: 0.0, verdict, count, detail: detail.into(), findings }
    }

    /// A part that could not run.
    pub(super) fn unable(why: impl Into<String>) -> Self {
        Self { verdict: Verdict::Unable, ..Self::ran(0, why, Vec::new()) }
    }
}

/// The report of a night.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NightReport {
    /// Version of this report.
    pub schema: u32,
    /// What all chance came from.
    pub seed: u64,
    /// How long it took.
    pub seconds: f64,
    /// The parts, in order.
    pub parts: Vec<Part>,
    /// What the corpora reach, and how often, as `TARGET: WHAT`.
    pub reached: BTreeMap<String, u64>,
}

impl NightReport {
    pub(super) fn new(seed: u64) -> Self {
        Self { schema: 1, seed, seconds: 0.0, parts: Vec::new(), reached: BTreeMap::new() }
    }

    /// 0 nothing was found, 1 something was, 2 a part could not run.
    pub fn exit_code(&self) -> u8 {
        let any = |verdict| self.parts.iter().any(|part| part.verdict == verdict);
        if any(Verdict::Unable) { 2 } else { u8::from(any(Verdict::Failed)) }
    }

    /// For people: the parts, then what was reached.
    pub fn tables(&self) -> Vec<Table> {
        let part = |part: &Part| {
            let seconds = format!("{:.1}", part.seconds);
            let (count, verdict) = (part.count.to_string(), part.verdict.word().to_owned());
            vec![part.name.clone(), seconds, count, part.findings.len().to_string(), verdict]
        };
        let parts = table(
            &format!("The night of seed {}", self.seed),
            &["part", "seconds", "runs", "findings", "verdict"],
            self.parts.iter().map(part),
        );
        let reached = self.reached.iter().map(|(name, count)| vec![name.clone(), count.to_string()]);
        vec![parts, table("What the corpora reach", &["what", "inputs"], reached)]
    }
}

fn table(title: &str, columns: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Table {
    Table {
        title: title.into(),
        columns: columns.iter().map(|&column| column.to_owned()).collect(),
        rows: rows.map(|cells| Row { ids: Vec::new(), cells }).collect(),
    }
}

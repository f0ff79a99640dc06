//! How far an adapter is from the goldens: measured over recordings, and written down in the file of gates.
//!
//! The entry of the adapter takes the worst distance that was found over the recordings given, each measure on its own. It is not written if the
//! gate that follows would let a planted defect pass in any of the goldens, or a golden is missing or damaged: what is not known cannot be
//! measured.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bless::BlessOptions;
use super::golden::{Found, Stored};
use super::image::{Distance, Known, Metric, Skin, measure, prove};
use super::one::{Failure, Open, open_file, run, unwatched};
use super::suite::{Recordings, find, in_parallel, read_gates};
use super::{Progress, facts, home};
use crate::assets;
use crate::canvas::{Adapter, Kind, Studio};
use crate::replay::Options;

/// What measuring an adapter came to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GaugeReport {
    /// The entry's pattern of names.
    pub adapter: String,
    /// The file of gates.
    pub file: String,
    /// How many pictures were compared.
    pub images: usize,
    /// What the entry said before; none if there was no such entry.
    pub before: Option<Distance>,
    /// The worst distance of any picture.
    pub measured: Distance,
    /// By measure: the picture that is worst by it, as `RECORDING CHECKPOINT`.
    pub worst: Vec<(Metric, String)>,
    /// Why nothing was written.
    pub errors: Vec<String>,
}

impl GaugeReport {
    /// 0 the gates hold, 2 they could not be measured, or would let a defect pass.
    pub fn exit_code(&self) -> u8 {
        if self.errors.is_empty() { 0 } else { 2 }
    }

    fn refused(why: impl Into<String>) -> Self {
        Self { errors: vec![why.into()], ..Self::default() }
    }
}

/// Measures how far the options' studio is from the goldens of recordings, and writes the entry of its adapter.
pub fn gauge(paths: &[PathBuf], options: &BlessOptions, progress: &dyn Progress) -> GaugeReport {
    gauge_with(paths, options, progress, &open_file)
}

pub(super) fn gauge_with(
    paths: &[PathBuf],
    options: &BlessOptions,
    progress: &dyn Progress,
    open: &Open<'_>,
) -> GaugeReport {
    let Some(studio) = options.studio.as_deref() else {
        return GaugeReport::refused("nobody was asked to render");
    };
    if studio.adapter().kind == Kind::Reference {
        return GaugeReport::refused("the CPU reference is exact: it has no gate");
    }
    if facts::one_line(&options.reason).is_empty() {
        return GaugeReport::refused("a gate needs a reason for being as it is");
    }
    let found = find(paths, options.filter.as_deref());
    let file = match file(&found) {
        Ok(file) => file,
        Err(why) => {
            return GaugeReport { errors: [found.errors, vec![why]].concat(), ..GaugeReport::default() };
        }
    };
    let look = |_: usize, path: &Path| Look::at(path, studio, open);
    let mut whole = Look { errors: found.errors, ..Look::default() };
    in_parallel(&found.recordings, options.jobs, progress, &look).into_iter().for_each(|one| whole.add(one));
    enter(whole, &file, studio.adapter(), options)
}

/// The one file of gates that the recordings go by.
fn file(found: &Recordings) -> Result<PathBuf, String> {
    let mut files: Vec<PathBuf> = found.recordings.iter().map(|recording| home::gates(recording)).collect();
    files.dedup();
    match files.as_slice() {
        [file] => Ok(file.clone()),
        [] => Err("there is no recording to measure with".into()),
        [a, b, ..] => Err(format!("the recordings go by several files: {} and {}", a.display(), b.display())),
    }
}

/// What some recordings' pictures are like, compared with their goldens.
#[derive(Default)]
struct Look {
    /// By measure, the worst of them and whose it is; none where all are equal.
    worst: Vec<(Metric, f64, String)>,
    measured: Distance,
    /// The goldens' files, and the colour behind the model.
    goldens: Vec<(PathBuf, [u8; 4])>,
    errors: Vec<String>,
}

impl Look {
    fn at(path: &Path, studio: &dyn Studio, open: &Open<'_>) -> Self {
        match run(path, &Options::default(), Some(studio), open, &unwatched) {
            Ok(found) => Self::of(path, &found),
            Err(Failure::BadInput(why) | Failure::Panic(why)) => {
                Self { errors: vec![format!("{}: {why}", home::name(path))], ..Self::default() }
            }
        }
    }

    fn of(path: &Path, found: &Found) -> Self {
        let folder = home::goldens(path);
        let stored = Stored::read(&folder, found);
        let mut look = Self { errors: stored.problems, ..Self::default() };
        for (name, golden) in &stored.pictures {
            let Some(frame) = found.frame(name) else { continue };
            let skin = Skin::of(&golden.image, frame.background);
            let distance = measure(&golden.image, &frame.frame.image, &skin).distance;
            let whose = format!("{} {name}", home::name(path));
            look.take(Metric::ALL.into_iter().map(|metric| (metric, distance.get(metric), whose.clone())));
            look.measured = look.measured.max(&distance);
            look.goldens.push((folder.join(home::checkpoint_picture(name)), frame.background));
        }
        look
    }

    /// Keeps what is worse by its measure than what is known.
    fn take(&mut self, distances: impl Iterator<Item = (Metric, f64, String)>) {
        for (metric, value, whose) in distances {
            match self.worst.iter_mut().find(|(known, ..)| *known == metric) {
                Some(known) if value > known.1 => *known = (metric, value, whose),
                None if value > 0.0 => self.worst.push((metric, value, whose)),
                _ => {}
            }
        }
    }

    fn add(&mut self, other: Self) {
        self.take(other.worst.into_iter());
        self.measured = self.measured.max(&other.measured);
        self.goldens.extend(other.goldens);
        self.errors.extend(other.errors);
    }

    /// The goldens in which a gate would let a planted defect pass.
    fn insensitive(&self, gate: &Distance) -> Vec<String> {
        let missed = |(file, background): &(PathBuf, [u8; 4])| -> Result<Vec<String>, String> {
            let png = assets::read_file(file).map_err(|error| error.to_string())?;
            let golden = assets::read_png(&png).map_err(|fault| format!("{}: {fault}", file.display()))?;
            let proof = prove(&golden, &Skin::of(&golden, *background), gate);
            let line = |defect| format!("{}: insensitive: a planted {defect} would pass", file.display());
            Ok(proof.missed().map(line).collect())
        };
        self.goldens.iter().flat_map(|golden| missed(golden).unwrap_or_else(|why| vec![why])).collect()
    }
}

/// Writes an adapter's entry, if it is one that can be.
fn enter(look: Look, file: &Path, adapter: &Adapter, options: &BlessOptions) -> GaugeReport {
    let mut report = GaugeReport {
        file: file.display().to_string(),
        images: look.goldens.len(),
        measured: look.measured,
        worst: look.worst.iter().map(|(metric, _, whose)| (*metric, whose.clone())).collect(),
        ..GaugeReport::default()
    };
    report.errors.clone_from(&look.errors);
    if look.goldens.is_empty() {
        report.errors.push("there is no picture to measure with".into());
    }
    let mut gates = match read_gates(file) {
        Ok(gates) => gates,
        Err(why) => return GaugeReport { errors: [report.errors, vec![why]].concat(), ..report },
    };
    let known = gates.entry(adapter);
    report.before = known.map(|known| known.measured);
    report.adapter = known.map_or_else(|| pattern(&adapter.name), |known| known.adapter.clone());
    let reason = facts::one_line(&options.reason);
    let entry = Known { adapter: report.adapter.clone(), reason, measured: look.measured };
    match entry.gate() {
        Ok(gate) => report.errors.extend(look.insensitive(&gate)),
        Err(error) => report.errors.push(error.to_string()),
    }
    if report.errors.is_empty() && !options.dry_run {
        gates.put(entry);
        report.errors.extend(assets::write_file(file, &gates.text()).err().map(|error| error.to_string()));
    }
    report
}

/// The pattern of an adapter that is new: its name, without what stands in brackets, which are versions.
fn pattern(name: &str) -> String {
    name.split_once(" (").map_or_else(|| name.to_owned(), |(name, _)| format!("{name}*"))
}

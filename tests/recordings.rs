//! Every shipped recording does what its name and `outcomes.txt` say, and breaks no invariant.
//!
//! A line of the table is a recording's name and what becomes of its events in order: `none`, `pending`, `cancelled`, `applied` or
//! `rejected:REASON`; `applied*3` stands for three in a row.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use lancet::engine::wound::WoundEvent;
use lancet::recording::{self, AnyRecording};
use lancet::replay::{self, Options};
use lancet::report::{Counter, EventReport, Outcome, RunReport};

/// Lam 2016, Table 6.2: the faces that the eighteen cuts cross.
const TABLE_6_2: [(&str, [(&str, u64); 6]); 3] = [
    ("small", [("I", 4), ("II", 6), ("III", 6), ("IV", 9), ("V", 8), ("VI", 8)]),
    ("medium", [("I", 9), ("II", 11), ("III", 11), ("IV", 17), ("V", 19), ("VI", 18)]),
    ("large", [("I", 22), ("II", 24), ("III", 25), ("IV", 30), ("V", 39), ("VI", 46)]),
];

/// How far the bust's count may be from the thesis's head's: the heads are not the same.
const TOLERANCE: f64 = 0.2;

/// Where the two ends of a link can lie.
const CONFIGURATIONS: [&str; 9] = ["NN", "NE", "NF", "EN", "EE", "EF", "FN", "FE", "FF"];

#[test]
fn every_event_ends_as_the_table_says() {
    let table = table();
    let told: BTreeSet<&String> = table.keys().collect();
    let shipped: BTreeSet<&String> = runs().keys().collect();
    assert_eq!(told, shipped, "each recording has its line, and each line its recording");
    let differing: Vec<String> =
        runs().iter().filter_map(|(name, run)| difference(name, &run.events, &table[name])).collect();
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}

#[test]
fn no_invariant_breaks() {
    let findings: Vec<String> =
        runs().iter().flat_map(|(name, run)| run.findings().map(move |f| format!("{name}: {f:?}"))).collect();
    assert!(findings.is_empty(), "{}", findings.join("\n"));
    assert!(runs().values().all(|run| run.checks() > 0), "something was looked at");
}

#[test]
fn every_recording_has_a_checkpoint_at_its_end() {
    let without = |(_, run): &(&String, &RunReport)| run.events.last().is_none_or(|e| e.checkpoint.is_none());
    let names: Vec<&String> = runs().iter().filter(without).map(|(name, _)| name).collect();
    assert!(names.is_empty(), "{names:?}");
}

#[test]
fn the_eighteen_cuts_cross_as_many_faces_as_the_thesis_has_it() {
    for (size, counts) in TABLE_6_2 {
        for (place, published) in counts {
            let name = format!("thesis-{size}-{place}");
            let faces = cut_of(&name).counters.get("faces");
            let Some(&Counter::Count(faces)) = faces else { panic!("{name} counts no faces: {faces:?}") };
            let off = (faces as f64 / published as f64 - 1.0).abs();
            assert!(off <= TOLERANCE, "{name} crosses {faces} faces, {published} in the thesis");
        }
    }
}

#[test]
fn medium_and_small_cuts_are_a_half_and_a_quarter_of_the_large_one_around_the_same_middle() {
    for (place, _) in TABLE_6_2[0].1 {
        let [small, medium, large] = TABLE_6_2.map(|(size, _)| clicks(&format!("thesis-{size}-{place}")));
        for (shorter, share) in [(small, 0.25), (medium, 0.5)] {
            let [a, b] = large;
            let along = |t: f64| [0, 1].map(|i| a[i] + (b[i] - a[i]) * t);
            assert_eq!(shorter, [along(0.5 - 0.5 * share), along(0.5 + 0.5 * share)], "{place}, {share}");
        }
    }
}

#[test]
fn all_nine_configurations_occur_and_each_in_the_recording_named_after_it() {
    let occurring: BTreeSet<String> =
        runs().values().flat_map(|run| &run.events).flat_map(configurations).map(|(name, _)| name).collect();
    assert_eq!(occurring, CONFIGURATIONS.map(String::from).into());
    for name in CONFIGURATIONS {
        let found = configurations(cut_of(&format!("config-{name}")));
        assert_eq!(found, BTreeMap::from([(name.to_owned(), 1)]), "config-{name}");
    }
}

/// The runs of all recordings by name; replayed once, by as many threads as there are cores.
fn runs() -> &'static BTreeMap<String, RunReport> {
    static RUNS: OnceLock<BTreeMap<String, RunReport>> = OnceLock::new();
    RUNS.get_or_init(|| {
        let files = recordings();
        let (files, next) = (&files, &AtomicUsize::new(0));
        let worker = || {
            let mine = std::iter::from_fn(|| files.get(next.fetch_add(1, Ordering::Relaxed)));
            mine.map(|file| replayed(file)).collect::<Vec<_>>()
        };
        thread::scope(|scope| {
            let count = thread::available_parallelism().map_or(1, usize::from);
            let workers: Vec<_> = (0..count).map(|_| scope.spawn(worker)).collect();
            workers.into_iter().flat_map(|w| w.join().expect("no replay panics")).collect()
        })
    })
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("recordings/wound")
}

fn recordings() -> Vec<PathBuf> {
    // What was found by attacking is kept beside what was recorded on purpose.
    let folders = [folder(), folder().with_file_name("regressions")];
    let entries = folders.iter().flat_map(|folder| folder.read_dir().expect("a folder of recordings"));
    entries.map(|entry| entry.expect("an entry").path()).collect()
}

fn replayed(file: &Path) -> (String, RunReport) {
    let name = file.file_stem().and_then(|stem| stem.to_str()).expect("a name in UTF-8").to_owned();
    assert!(file.extension().is_some_and(|e| e == "lancet"), "{} is no recording", file.display());
    let options = Options { budget_bytes: 0, ..Options::default() };
    let mut replay =
        replay::open_file(file, options, None).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    replay.finish();
    let run = replay.run_report(&name);
    (name, run)
}

/// The words of each recording.
fn table() -> BTreeMap<String, Vec<String>> {
    let lines = include_str!("outcomes.txt").lines().filter(|line| !line.starts_with('#'));
    let entries: Vec<(String, Vec<String>)> = lines
        .map(|line| {
            let mut words = line.split_whitespace();
            let name = words.next().expect("a line begins with a name").to_owned();
            (name, words.flat_map(repeated).collect())
        })
        .collect();
    let (lines, table) = (entries.len(), BTreeMap::from_iter(entries));
    assert_eq!(table.len(), lines, "a recording has one line");
    table
}

fn repeated(word: &str) -> Vec<String> {
    let (word, times) = word.split_once('*').unwrap_or((word, "1"));
    vec![word.to_owned(); times.parse().expect("a number after the asterisk")]
}

fn word(event: &EventReport) -> String {
    match event.outcome {
        Outcome::None => "none".to_owned(),
        Outcome::Pending => "pending".to_owned(),
        Outcome::Cancelled => "cancelled".to_owned(),
        Outcome::Applied => "applied".to_owned(),
        Outcome::Rejected => format!("rejected:{}", event.reason.as_deref().unwrap_or("")),
    }
}

/// The first event that ends differently.
fn difference(name: &str, events: &[EventReport], told: &[String]) -> Option<String> {
    let found: Vec<String> = events.iter().map(word).collect();
    if found == told {
        return None;
    }
    let at = found.iter().zip(told).take_while(|(a, b)| a == b).count();
    let detail = events.get(at).and_then(|e| e.detail.clone()).unwrap_or_default();
    Some(format!("{name}, event {at}: {:?}, in the table {:?} {detail}", found.get(at), told.get(at)))
}

/// The one cut of a recording.
fn cut_of(name: &str) -> &'static EventReport {
    let run = runs().get(name).unwrap_or_else(|| panic!("there is no {name}"));
    let cuts: Vec<&EventReport> = run.events.iter().filter(|e| e.cut).collect();
    let [cut] = cuts[..] else { panic!("{name} has {} cuts", cuts.len()) };
    cut
}

/// The pixel positions of a recording's two clicks.
fn clicks(name: &str) -> [[f64; 2]; 2] {
    let bytes = std::fs::read(folder().join(format!("{name}.lancet"))).expect("it is there");
    let AnyRecording::Wound(recording) = recording::read(&bytes).expect("it is whole");
    let clicks = recording.events.iter().filter_map(|keyed| match keyed.event {
        WoundEvent::Click(at) => Some(at),
        _ => None,
    });
    clicks.collect::<Vec<_>>().try_into().expect("two clicks")
}

fn configurations(event: &EventReport) -> BTreeMap<String, u64> {
    match event.counters.get("configurations") {
        Some(Counter::ByName(counts)) => counts.clone(),
        _ => BTreeMap::new(),
    }
}

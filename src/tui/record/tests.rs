//! Recording by keys: what is recorded replays to the same, and drafts outlive what ends the program.

use std::path::{Path, PathBuf};

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Position;
use tempfile::TempDir;

use super::{Draft, Drafts, cross};
use crate::assets;
use crate::canvas::frame::Orbit;
use crate::render::{self, Choice};
use crate::replay::{self, Input, Options};
use crate::tui::config::Config;
use crate::tui::model::{Model, Pane, Place};
use crate::tui::run::Start;
use crate::tui::stage::Stage;
use crate::tui::theme::Theme;
use crate::tui::update::{self, record};
use crate::tui::worker::{Ask, Hand};

/// A square of two triangles, seen from the front.
const MESH: &[u8] = b"v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nf 1 2 3 4\n";
const SCRIPT: &[u8] =
    br#"{ "version": 1, "viewport": [100, 100], "scene": { "mesh": "square.obj" }, "events": [] }"#;

/// A folder with a scene and a script without events in a folder of its own, and a place for drafts.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().expect("a folder"));
        assets::write_file(&folder.at("scene/square.obj"), MESH).expect("a mesh");
        assets::write_file(&folder.script(), SCRIPT).expect("a script");
        folder
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn script(&self) -> PathBuf {
        self.at("scene/script.json")
    }

    /// The screen with a recording open, or with nothing.
    fn stage(&self, recording: Option<&Path>) -> Stage {
        let start = Start {
            recording: recording.map(Path::to_owned),
            renderer: Choice::Reference,
            compare: None,
            budget_bytes: 1 << 20,
            drafts: Drafts::at(self.at("drafts")),
            config: Config::default(),
        };
        Stage::open(&start, Theme::default(), [80, 24], true)
    }

    fn drafts(&self) -> Vec<PathBuf> {
        assets::list_files(&self.at("drafts")).expect("a folder")
    }
}

fn press(stage: &mut Stage, keys: &str) {
    stage.press(keys).expect("keys");
}

fn lines(stage: &mut Stage) -> Vec<String> {
    stage.model().opened.as_ref().map_or_else(Vec::new, |opened| opened.lines.clone())
}

fn said(stage: &mut Stage) -> String {
    stage.model().message.as_ref().map_or_else(String::new, |message| message.text.clone())
}

fn save(stage: &mut Stage, path: &Path) {
    record::save(stage.model(), &path.display().to_string()).expect("it can be saved");
    stage.settle();
    assert_eq!(stage.model().opened.as_ref().and_then(|opened| opened.path.clone()), Some(path.to_owned()));
}

/// Every report that the screen was told is what the file gives, replayed anew.
fn require_same(stage: &mut Stage, path: &Path) {
    let studio = render::studio(Choice::Reference).expect("a renderer");
    let options = Options { pictures: true, ..Options::default() };
    let mut replay = replay::open_file(path, options, Some(studio.as_ref())).expect("it opens");
    replay.finish();
    let model: &Model = stage.model();
    assert_eq!(model.reports.len(), replay.len());
    for (told, report) in model.reports.iter().zip(replay.run_report("").events) {
        assert!(told.without_times().stages == report.without_times().stages, "{told:?}\n{report:?}");
        assert_eq!(told.without_times(), report.without_times());
    }
}

#[test]
fn what_is_recorded_by_keys_replays_to_the_same() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r e e");
    let recorded = stage.model().standing.as_ref().and_then(|standing| standing.orbit).expect("a camera");
    for turn in 1..5 {
        let turned = Orbit { azimuth: recorded.azimuth + 0.05 * f64::from(turn), ..recorded };
        stage.model().picture.orbit = Some(turned);
        stage.settle();
    }
    press(&mut stage, "enter right right down enter u ctrl-r a enter");
    let words = ["mode", "mode", "camera", "click", "click", "undo", "redo", "checkpoint"];
    let lines = lines(&mut stage);
    assert_eq!(lines.len(), words.len(), "{lines:?}");
    assert!(lines.iter().zip(words).all(|(line, word)| line.contains(word)), "{lines:?}");
    assert_eq!(stage.model().reports[4].outcome, crate::report::Outcome::Applied);
    assert!(stage.model().picture.orbit.is_none(), "the recording looks from there by now");
    for name in ["elsewhere/cut.lancet", "elsewhere/cut.json"] {
        save(&mut stage, &folder.at(name));
        require_same(&mut stage, &folder.at(name));
    }
    assert_eq!(
        assets::read_file(&folder.script()).expect("read"),
        SCRIPT,
        "what was gone on from is as it was"
    );
}

#[test]
fn what_is_dropped_and_recorded_again_is_as_if_it_were_recorded_at_once() {
    let folder = Folder::new();
    let mut detour = folder.stage(Some(&folder.script()));
    press(&mut detour, "r enter right enter u backspace backspace down enter");
    let mut direct = folder.stage(Some(&folder.script()));
    press(&mut direct, "r enter right down enter");
    for (stage, name) in [(&mut detour, "detour.lancet"), (&mut direct, "direct.lancet")] {
        save(stage, &folder.at(name));
    }
    // What comes after the place where one goes on is dropped from a copy.
    let mut again = folder.stage(Some(&folder.at("direct.lancet")));
    press(&mut again, "home l r right down enter");
    save(&mut again, &folder.at("again.lancet"));
    let read = |name: &str| assets::read_file(&folder.at(name)).expect("read");
    for (stage, name) in
        [(&mut detour, "direct.lancet"), (&mut direct, "again.lancet"), (&mut again, "detour.lancet")]
    {
        assert_eq!(read("direct.lancet"), read(name));
        require_same(stage, &folder.at(name));
    }
}

#[test]
fn a_draft_outlives_the_program_and_is_gone_on_with() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r enter right enter");
    let recorded = lines(&mut stage);
    drop(stage);
    let mut stage = folder.stage(None);
    let drafts = stage.model().kept.drafts.clone();
    let [Draft { path, content: Ok((scene, 2)) }] = &drafts[..] else { panic!("{drafts:?}") };
    assert!(scene.ends_with("square.obj") && said(&mut stage).contains("not saved"), "{scene}");
    stage.model().ask(Ask::Open(path.clone()));
    stage.settle();
    assert_eq!((lines(&mut stage), stage.model().place), (recorded.clone(), Place::after(2)));
    assert!(stage.model().kept.unsaved && stage.model().recorder.is_some());
    press(&mut stage, "u");
    assert_eq!(lines(&mut stage).len(), 3);
    let [draft] = &folder.drafts()[..] else { panic!("one that is the newest: {:?}", folder.drafts()) };
    assert_eq!(replay::read(draft).expect("it is whole").event_lines(), lines(&mut stage));
    save(&mut stage, &folder.at("saved.lancet"));
    require_same(&mut stage, &folder.at("saved.lancet"));
    assert!(folder.drafts().is_empty() && !stage.model().kept.unsaved);
}

#[test]
fn a_draft_is_taken_up_by_one_program_alone() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r enter right enter");
    drop(stage);
    let [mut first, mut second] = [(); 2].map(|()| folder.stage(None));
    let path = folder.drafts().swap_remove(0);
    for stage in [&mut first, &mut second] {
        stage.model().popup = None;
        stage.model().ask(Ask::Open(path.clone()));
        stage.settle();
    }
    assert!(said(&mut second).contains("another program has taken this draft up"), "{}", said(&mut second));
    assert!(
        second.model().opened.is_none() && second.model().kept.drafts.iter().all(|draft| draft.path != path)
    );
    press(&mut first, "u");
    let [draft] = &folder.drafts()[..] else { panic!("{:?}", folder.drafts()) };
    assert_eq!(replay::read(draft).expect("it is whole").event_lines(), lines(&mut first));
    assert_eq!(lines(&mut first).len(), 3);
}

#[cfg(unix)]
#[test]
fn what_a_program_that_runs_is_writing_is_offered_to_nobody_else() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r enter right enter");
    drop(stage);
    // The same draft, of a program that is there for as long as we want.
    let mut program = std::process::Command::new("sleep").arg("600").spawn().expect("a program");
    let path = folder.at(&format!("drafts/square-{}.2.lancet", program.id()));
    assert!(assets::take_file(&folder.drafts().swap_remove(0), &path).expect("renamed"));
    let mut other = folder.stage(None);
    assert!(other.model().kept.drafts.is_empty());
    other.model().ask(Ask::Open(path.clone()));
    other.settle();
    assert!(said(&mut other).contains("which still runs"), "{}", said(&mut other));
    assert_eq!(folder.drafts(), std::slice::from_ref(&path));
    program.kill().and_then(|()| program.wait()).expect("it has ended");
    let mut next = folder.stage(None);
    assert_eq!(next.model().kept.drafts.iter().map(|draft| &draft.path).collect::<Vec<_>>(), [&path]);
}

#[test]
fn what_is_still_being_recorded_is_kept_though_another_program_takes_its_draft_up() {
    let folder = Folder::new();
    let mut writer = folder.stage(Some(&folder.script()));
    press(&mut writer, "r enter right enter");
    let mut other = folder.stage(None);
    let path = folder.drafts().swap_remove(0);
    other.model().ask(Ask::Open(path));
    other.settle();
    press(&mut other, "backspace backspace");
    assert!(folder.drafts().is_empty(), "the other one has thrown its own away");
    // Whether he opens something else, records on, or leaves.
    press(&mut writer, "u");
    let [draft] = &folder.drafts()[..] else { panic!("{:?}", folder.drafts()) };
    assert_eq!(replay::read(draft).expect("it is whole").event_lines(), lines(&mut writer));
    for leaves in [false, true] {
        folder.drafts().iter().for_each(|draft| assets::remove_file(draft).expect("removed"));
        if leaves {
            writer.leave().expect("it is kept");
            break;
        }
        record::begin(writer.model(), "builtin:grid").expect("a scene");
        writer.settle();
        let [draft] = &folder.drafts()[..] else { panic!("{:?}", folder.drafts()) };
        assert_eq!(replay::read(draft).expect("it is whole").event_count(), 3);
        press(&mut writer, "enter");
    }
    let [draft] = &folder.drafts()[..] else { panic!("{:?}", folder.drafts()) };
    assert_eq!(replay::read(draft).expect("it is whole").event_count(), 1);
}

#[test]
fn a_draft_that_cannot_be_read_stays_where_it_is() {
    let folder = Folder::new();
    assets::write_file(&folder.at("drafts/bad-1.lancet"), b"nonsense").expect("written");
    let mut stage = folder.stage(Some(&folder.at("drafts/bad-1.lancet")));
    assert!(
        stage.model().opened.is_none() && said(&mut stage).contains("bad-1.lancet"),
        "{}",
        said(&mut stage)
    );
    assert_eq!(folder.drafts(), [folder.at("drafts/bad-1.lancet")]);
}

#[test]
fn a_scene_in_place_of_a_recording_begins_one_on_it() {
    let folder = Folder::new();
    let described = folder.at("scene/scene.json");
    assets::write_file(&described, br#"{ "mesh": "square.obj" }"#).expect("written");
    for scene in ["builtin:grid".into(), described, folder.at("scene/square.obj")] {
        let mut stage = folder.stage(Some(&scene));
        assert!(stage.model().recorder.is_some(), "{}: {}", scene.display(), said(&mut stage));
        assert_eq!((lines(&mut stage).len(), stage.model().kept.unsaved), (0, false));
        let mut stage = folder.stage(None);
        for letter in scene.display().to_string().chars() {
            stage.take(Event::Key(KeyEvent::new(KeyCode::Char(letter), KeyModifiers::NONE)));
        }
        press(&mut stage, "enter");
        assert!(stage.model().recorder.is_some(), "{}: {}", scene.display(), said(&mut stage));
    }
    let mut stage = folder.stage(Some(Path::new("builtin:sphere:2")));
    assert!(said(&mut stage).contains("from 20 to"), "{}", said(&mut stage));
}

#[test]
fn a_recording_that_something_else_is_opened_over_stays_a_draft() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r enter");
    record::begin(stage.model(), &folder.at("scene/square.obj").display().to_string()).expect("a scene");
    stage.settle();
    assert_eq!((lines(&mut stage).len(), stage.model().focus), (0, Pane::Picture));
    assert_eq!(stage.model().kept.drafts.len(), 1);
    press(&mut stage, "enter enter");
    assert_eq!(folder.drafts().len(), 2, "the second one has a name of its own");
    press(&mut stage, "backspace backspace");
    assert_eq!(folder.drafts().len(), 1, "nothing is left of it");
    assert!(!stage.model().kept.unsaved);
}

#[test]
fn a_draft_that_cannot_be_written_is_said() {
    let folder = Folder::new();
    assets::write_file(&folder.at("drafts"), b"no folder").expect("written");
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r enter");
    assert!(said(&mut stage).starts_with("not kept as a draft: "), "{}", said(&mut stage));
    assert_eq!(lines(&mut stage).len(), 1, "it is recorded all the same");
}

#[test]
fn what_cannot_be_recorded_is_said_and_changes_nothing() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r");
    assert!(record::event(stage.model(), "{\"clock\": 3}").expect_err("no event").contains("clock"));
    assert!(record::checkpoint(stage.model(), "Not Plain").is_err());
    record::checkpoint(stage.model(), "plain").expect("a name");
    stage.settle();
    assert!(record::checkpoint(stage.model(), "plain").expect_err("taken").contains("already"));
    stage.model().ask(Ask::Record(Hand::Other(Input::Mode("none".into()))));
    stage.settle();
    assert!(stage.model().message.as_ref().is_some_and(|message| message.wrong));
    let nowhere = Some(Orbit { azimuth: f64::NAN, zenith: 1.0, distance: 1.0 });
    stage.model().ask(Ask::Record(Hand::Point { at: [f64::NAN; 2], from: nowhere }));
    stage.settle();
    assert_eq!(lines(&mut stage).len(), 1);
    press(&mut stage, "enter");
    save(&mut stage, &folder.at("x.lancet"));
    require_same(&mut stage, &folder.at("x.lancet"));
    press(&mut stage, "home enter");
    assert_eq!(lines(&mut stage).len(), 2, "nothing is recorded but at the end");
    assert!(said(&mut stage).contains("at the end"));
}

#[test]
fn a_file_that_is_not_its_own_has_to_be_named_twice() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r enter");
    let name = folder.script().display().to_string();
    let error = record::save(stage.model(), &name).expect_err("it is there");
    assert!(error.contains("name it again"), "{error}");
    stage.settle();
    assert_eq!(assets::read_file(&folder.script()).expect("read"), SCRIPT);
    assert!(record::save(stage.model(), "x.txt").expect_err("no form").contains(".lancet"));
    assert!(record::save(stage.model(), " ").is_err());
    let error = record::save(stage.model(), &folder.at("").display().to_string());
    assert!(error.is_err(), "a folder is no file");
    record::save(stage.model(), &name).expect("named again");
    stage.settle();
    require_same(&mut stage, &folder.script());
    press(&mut stage, "enter");
    save(&mut stage, &folder.script());
    require_same(&mut stage, &folder.script());
}

#[test]
fn where_one_points_is_what_the_status_line_shows_and_what_is_recorded() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r right shift-right up shift-down");
    let cross = stage.model().recorder.as_ref().expect("it records").cross;
    let shown = super::at(cross);
    press(&mut stage, "enter");
    let screen: String = stage.screen().content.iter().map(|cell| cell.symbol()).collect();
    assert!(screen.contains(&shown), "{shown}");
    assert_eq!(lines(&mut stage), [format!("{{\"click\":[{:?},{:?}]}}", cross[0], cross[1])]);
    assert!(screen.contains("waits"), "the first point waits");
    stage.model().picture.orbit = Some(Orbit { azimuth: 0.3, zenith: 1.5, distance: 9.0 });
    stage.settle();
    let screen: String = stage.screen().content.iter().map(|cell| cell.symbol()).collect();
    assert!(screen.contains("pointing drops"), "and is warned of");
}

#[test]
fn a_cell_of_the_picture_is_the_position_that_is_seen_in_it() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    press(&mut stage, "r");
    let area = crate::tui::view::areas(stage.model()).inner(Pane::Picture).expect("a picture");
    let mut clicked = 0;
    for cell in area.positions() {
        let before = lines(&mut stage).len();
        let Some(at) = cross::position(stage.model(), cell) else { continue };
        clicked += 1;
        if clicked % 50 == 1 {
            assert!(record::clicked(stage.model(), cell));
            stage.settle();
            assert_eq!(stage.model().recorder.as_ref().map(|recorder| recorder.cross), Some(at));
            assert_eq!(lines(&mut stage).len(), before + 1);
        }
    }
    assert!(clicked > 100, "{clicked} cells show the view");
    assert!(!record::clicked(stage.model(), Position { x: 0, y: 0 }), "not the title");
    // However far it goes, it stays in the view, and can be recorded.
    for keys in ["left ".repeat(200), "up ".repeat(200), "right down ".repeat(300)] {
        press(&mut stage, &keys);
        let cross = stage.model().recorder.as_ref().expect("it records").cross;
        assert!(cross.iter().all(|v| (0.0..100.0).contains(v)), "{cross:?}");
    }
    for size in [[1, 1], [0, 0], [3, 200]] {
        stage.model().size = size;
        press(&mut stage, "left down enter");
        stage.screen();
    }
}

#[test]
fn nothing_is_recorded_before_it_was_begun_or_after_it_was_ended() {
    let folder = Folder::new();
    let mut stage = folder.stage(Some(&folder.script()));
    update::act(stage.model(), crate::tui::action::Action::Point);
    stage.settle();
    press(&mut stage, "r enter esc 4 enter u");
    assert_eq!(lines(&mut stage).len(), 1);
    assert!(stage.model().kept.unsaved && stage.model().recorder.is_none());
}

//! The configuration: the example reads, every setting has its effect, and errors name their place.

use super::*;

const NAMES: [&str; 5] = ["quit", "search", "palette", "step-forward", "step-back"];

/// The last of them in a scope of its own.
const ACTIONS: [Known; 5] = [
    Known { name: NAMES[0], scope: 0 },
    Known { name: NAMES[1], scope: 0 },
    Known { name: NAMES[2], scope: 0 },
    Known { name: NAMES[3], scope: 0 },
    Known { name: NAMES[4], scope: 1 },
];

fn parse(text: &str) -> Result<Config, ConfigError> {
    Config::parse(text.as_bytes(), Path::new("my.toml"), &ACTIONS)
}

/// The error of a file, as it is shown.
fn refused(text: &str) -> String {
    parse(text).expect_err(text).to_string()
}

#[test]
fn the_example_reads_and_the_readme_has_it() {
    let config = parse(EXAMPLE).unwrap_or_else(|error| panic!("{error}"));
    let own = Config::parse(EXAMPLE.as_bytes(), Path::new("my.toml"), &crate::tui::actions());
    assert_eq!(own.as_ref(), Ok(&config), "its actions are there");
    assert!(include_str!("../../../README.md").contains(EXAMPLE));
    let key = |text: &str| text.parse::<Key>().expect("a key");
    let keys = [("quit", vec![key("q"), key("ctrl-x")]), ("search", vec![key("/")]), ("palette", vec![])];
    assert_eq!(config.keys, keys.map(|(name, keys)| (name.to_owned(), keys)));
    let style = |text: &str| theme::style(text).expect("a style");
    let roles = vec![(Role::Accent, style("#56b4e9")), (Role::Selected, style("bold white on blue"))];
    assert_eq!(config.theme, Choice { base: None, roles });
    assert!(config.mouse);
}

#[test]
fn every_setting_has_its_effect() {
    let config = parse("mouse = false\nimage-protocol = 'sixel'\ntheme.base = 'light'").expect("settings");
    assert!(!config.mouse);
    assert_eq!(config.image_protocol, ImageProtocol::Sixel);
    assert_eq!(config.theme.base, Some(Base::Light));
    assert_eq!(parse("# nothing\n"), Ok(Config::default()));
}

#[test]
fn errors_name_file_line_column_and_cause() {
    for (text, start) in [
        (
            "mouse = true\nmuose = 1",
            "my.toml:2:1: there is no setting `muose`; did you mean `mouse`? there are: ",
        ),
        ("mouse = 'yes'", "my.toml:1:9: this takes true or false, not a TOML string"),
        (
            "image-protocol = 'x'",
            "my.toml:1:18: there is no value `x`; there are: auto, kitty, sixel, iterm2, half",
        ),
        (
            "[theme]\nbase = 'drak'",
            "my.toml:2:8: there is no value `drak`; did you mean `dark`? there are: auto",
        ),
        (
            "[theme]\nselect = 'red'",
            "my.toml:2:1: there is no role `select`; did you mean `selected`? there are: ba",
        ),
        ("[theme]\nbad = 'rad'", "my.toml:2:7: `rad` is neither a colour"),
        ("theme = 3", "my.toml:1:9: this takes a table, not a TOML integer"),
        (
            "[keys]\nstep-forwards = 'n'",
            "my.toml:2:1: there is no action `step-forwards`; did you mean `step-forw",
        ),
        (
            "[keys]\nfly = 'n'",
            "my.toml:2:1: there is no action `fly`; there are: quit, search, palette, step-f",
        ),
        (
            "[keys]\nquit = ['q', 'ctlr-c']",
            "my.toml:2:14: `ctlr-c` is no key: a key is a character, f1 to f24, en",
        ),
        (
            "[keys]\nquit = 3",
            "my.toml:2:8: this takes a key such as \"ctrl-p\", or a list of keys, not a TOML integer",
        ),
    ] {
        let error = refused(text);
        assert!(error.starts_with(start), "{error}\nis not\n{start}");
    }
}

#[test]
fn a_key_that_is_given_away_twice_is_refused_unless_it_counts_in_two_places() {
    let text = "[keys]\nquit = ['x', 'ctrl-q']\nsearch = ['y', 'ctrl-Q']";
    assert_eq!(refused(text), "my.toml:3:16: `ctrl-q` cannot be a key of both `quit` and `search`");
    assert!(parse("[keys]\nquit = 'x'\nstep-back = 'x'").is_ok(), "two scopes");
    assert!(parse("[keys]\nquit = ['x', 'x']").is_ok(), "twice the same");
}

#[test]
fn grammar_is_checked_before_meaning_and_the_first_fault_is_told() {
    assert!(refused("mouse = \nmuose = 1").starts_with("my.toml:1:"), "{}", refused("mouse = \nmuose = 1"));
    assert!(refused("zebra = 1\nant = 1").starts_with("my.toml:1:1: there is no setting `zebra`"));
    assert!(refused("mouse = true\nmouse = false").starts_with("my.toml:2:1: "));
    let error = Config::parse(b"mouse = true\n# \xff", Path::new("my.toml"), &ACTIONS).expect_err("no text");
    assert_eq!(error.to_string(), "my.toml:2:3: this is not UTF-8");
    assert!(refused("é = 1").starts_with("my.toml:1:1: "));
}

#[test]
fn columns_count_characters() {
    assert!(refused("[keys]\n\"quit\" = ['é', 'éé']").starts_with("my.toml:2:16: `éé` is no key"));
}

#[test]
fn a_file_that_was_named_must_be_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("lancet.toml");
    let error = Config::load(Some(&file), &ACTIONS).expect_err("it is not there").to_string();
    assert!(error.contains("lancet.toml"), "{error}");
    assets::write_file(&file, b"mouse = false").expect("written");
    assert!(!Config::load(Some(&file), &ACTIONS).expect("settings").mouse);
}

#[test]
fn the_name_that_was_meant_is_near() {
    assert_eq!([distance("", "abc"), distance("kitten", "sitting"), distance("same", "same")], [3, 3, 0]);
    assert_eq!(nearest("qiut", &NAMES), Some("quit"));
    assert_eq!(nearest("nonsense", &NAMES), None);
    assert_eq!(nearest("x", &[]), None);
}

use super::*;

const ACTIONS: [&str; 5] = ["quit", "search", "palette", "step-forward", "step-back"];

fn parse(text: &str) -> Result<Config, ConfigError> {
    Config::parse(text.as_bytes(), Path::new("my.toml"), &ACTIONS)
}

/// The error of a file, as it is shown.
fn refused(text: &str) -> String {
    parse(text).expect_err(text).to_string()
}

#[test]
fn the_example_above_reads() {
    let source = include_str!("../config.rs");
    let example = source.lines().skip_while(|line| *line != "//! ```toml").skip(1);
    let example: Vec<&str> =
        example.take_while(|line| *line != "//! ```").filter_map(|line| line.strip_prefix("//!")).collect();
    let config = parse(&example.join("\n")).unwrap_or_else(|error| panic!("{error}"));
    let key = |text: &str| text.parse::<Key>().expect("a key");
    let keys = [("quit", vec![key("q"), key("ctrl-c")]), ("search", vec![key("/")]), ("palette", vec![])];
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
    assert_eq!(nearest("qiut", &ACTIONS), Some("quit"));
    assert_eq!(nearest("nonsense", &ACTIONS), None);
    assert_eq!(nearest("x", &[]), None);
}

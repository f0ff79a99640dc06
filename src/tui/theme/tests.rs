//! Every role can be read on its ground and told from the others.

use super::*;
use crate::tui::colour;

const BASES: [Base; 2] = [Base::Dark, Base::Light];

/// Relative luminance (WCAG 2.2).
fn luminance(rgb: Rgb) -> f64 {
    let linear = |c: u8| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
    };
    0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2])
}

/// Contrast ratio (WCAG 2.2), from 1 to 21.
fn contrast(a: Rgb, b: Rgb) -> f64 {
    let [a, b] = [luminance(a), luminance(b)];
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

fn shown(color: Option<Color>, other: Rgb) -> Rgb {
    color.and_then(colour::rgb).unwrap_or(other)
}

#[test]
fn the_table_is_in_order_and_every_style_in_it_reads() {
    for (i, (role, name, _, styles)) in TABLE.iter().enumerate() {
        assert_eq!(*role as usize, i, "{name}");
        assert_eq!(Role::named(name), Some(*role));
        assert!(styles.iter().all(|text| style(text).is_ok()), "{name}");
    }
    assert_eq!(Role::named("nothing"), None);
}

#[test]
fn every_role_is_readable_on_its_ground() {
    for base in BASES {
        let theme = Theme::new(base, Depth::Full);
        for role in Role::all().filter(|role| *role != Role::Track) {
            let style = theme.style(role);
            let ground = shown(style.bg, theme.ground());
            let ratio = contrast(shown(style.fg, theme.ink()), ground);
            // WCAG asks 4.5 of text and 3 of what is no text.
            let enough = if matches!(role, Role::Border | Role::Bar) { 3.0 } else { 4.5 };
            assert!(ratio >= enough, "{base:?} {}: {ratio:.2}", role.name());
        }
    }
}

/// What people see who lack red or green cones (Viénot, Brettel, Mollon 1999, in linear light, as rows).
const DICHROMATS: [[[f64; 3]; 3]; 2] = [
    [[0.11238, 0.88762, 0.0], [0.11238, 0.88762, 0.0], [0.00401, -0.00401, 1.0]],
    [[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]],
];

#[test]
fn good_bad_warnings_and_marks_are_told_apart_without_red_or_green() {
    let linear = |c: u8| libm::pow(f64::from(c) / 255.0, 2.2);
    for (base, eye) in BASES.iter().flat_map(|base| DICHROMATS.map(|eye| (*base, eye))) {
        let theme = Theme::new(base, Depth::Full);
        let seen = |role: Role| {
            let rgb = shown(theme.style(role).fg, theme.ink()).map(linear);
            eye.map(|row| {
                let sum: f64 = row.iter().zip(rgb).map(|(weight, c)| weight * c).sum();
                255.0 * libm::pow(sum.max(0.0), 1.0 / 2.2)
            })
        };
        let roles = [Role::Good, Role::Bad, Role::Accent];
        for (i, a) in roles.iter().enumerate() {
            for b in &roles[i + 1..] {
                let apart: f64 = seen(*a).iter().zip(seen(*b)).map(|(x, y)| (x - y) * (x - y)).sum();
                assert!(apart.sqrt() > 40.0, "{base:?}: {} and {}: {apart}", a.name(), b.name());
            }
        }
    }
}

#[test]
fn what_a_colour_says_a_mark_says_too() {
    let marks = [Role::Good, Role::Bad, Role::Warn, Role::Marked, Role::Selected].map(Role::mark);
    for (i, mark) in marks.iter().enumerate() {
        assert!(!mark.is_empty() && !marks[i + 1..].contains(mark), "{mark}");
    }
}

#[test]
fn without_colour_there_are_modifiers_alone() {
    for role in Role::all() {
        let style = Theme::new(Base::Dark, Depth::None).style(role);
        assert_eq!((style.fg, style.bg), (None, None), "{}", role.name());
    }
    let theme = Theme::new(Base::Light, Depth::None);
    let [selected, bad, text] = [Role::Selected, Role::Bad, Role::Text].map(|role| theme.style(role));
    assert!(selected != text && bad != text && selected != bad);
}

#[test]
fn sixteen_colours_are_named_ones() {
    for (base, role) in BASES.iter().flat_map(|base| Role::all().map(|role| (*base, role))) {
        let style = Theme::new(base, Depth::Sixteen).style(role);
        for color in [style.fg, style.bg].into_iter().flatten() {
            assert!(!matches!(color, Color::Rgb(..) | Color::Indexed(_)), "{}", role.name());
        }
    }
}

#[test]
fn the_ground_is_the_terminals_unless_chosen() {
    let terminal = |colorfgbg: &str| Environment { colorfgbg: colorfgbg.into(), ..Environment::default() };
    let said = ["", "15;0", "0;15", "0;default;7", "12;8", "x;y"].map(|said| Base::of(&terminal(said)));
    assert_eq!(said, [Base::Dark, Base::Dark, Base::Light, Base::Light, Base::Dark, Base::Dark]);
    let light = Choice { base: Some(Base::Light), roles: Vec::new() };
    assert_eq!(Theme::chosen(&light, &terminal("15;0")).base(), Base::Light);
}

#[test]
fn chosen_roles_look_as_chosen_but_not_without_colour() {
    let mine = style("bold white on red").expect("a style");
    let choice = Choice { base: None, roles: vec![(Role::Selected, mine)] };
    let full = Environment { colorterm: "truecolor".into(), ..Environment::default() };
    let theme = Theme::chosen(&choice, &full);
    assert_eq!(theme.style(Role::Selected), mine);
    assert_eq!(theme.style(Role::Bad), Theme::default().style(Role::Bad));
    let none = Environment { no_color: "1".into(), ..full };
    assert_eq!(Theme::chosen(&choice, &none), Theme::new(Base::Dark, Depth::None));
}

#[test]
fn a_style_is_colours_a_ground_and_modifiers() {
    let bold = Style::new().add_modifier(Modifier::BOLD);
    assert_eq!(style(" on #010203  bold light-red "), Ok(bold.fg(Color::LightRed).bg(Color::Rgb(1, 2, 3))));
    assert_eq!(style("17"), Ok(Style::new().fg(Color::Indexed(17))));
    for (text, word) in
        [("blod", "blod"), ("red on", "on"), ("on bold", "bold"), ("#12345", "#12345"), ("256", "256")]
    {
        assert_eq!(style(text), Err(StyleError { word: word.into() }), "{text}");
    }
}

//! A screen as text, as styles and as SVG.

use std::num::NonZeroU16;

use ratatui::buffer::CellDiffOption;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Block, BorderType, Widget as _};

use super::*;
use crate::tui::lower::Depth;
use crate::tui::theme::{Base, Role, Theme};

/// A small screen with something of everything.
fn screen() -> Buffer {
    let theme = Theme::default();
    let mut buffer = Buffer::empty(Rect::new(0, 0, 24, 6));
    Block::bordered().border_type(BorderType::Rounded).title("stages").render(buffer.area, &mut buffer);
    buffer.set_string(2, 1, "FC <a> & b", theme.style(Role::Text));
    buffer.set_string(14, 1, "漢字✓", theme.style(Role::Good));
    buffer.set_string(2, 2, "1.2", Style::new().fg(Color::Red));
    buffer.set_string(6, 2, "██▌", theme.style(Role::Bar));
    buffer.set_style(Rect::new(1, 3, 22, 1), theme.style(Role::Selected));
    buffer.set_string(2, 3, "selected row", Style::new());
    for x in 0..22u8 {
        let cell = &mut buffer[(1 + u16::from(x), 4)];
        cell.set_symbol("▀").set_fg(Color::Rgb(x * 10, 0, 0)).set_bg(Color::Rgb(0, 0, x * 10));
    }
    buffer
}

#[test]
fn text_is_what_one_reads() {
    let expected = "\
╭stages────────────────╮
│ FC <a> & b  漢字✓    │
│ 1.2 ██▌              │
│ selected row         │
│▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀│
╰──────────────────────╯
";
    assert_eq!(to_text(&screen()), expected);
    assert_eq!(to_text(&Buffer::empty(Rect::ZERO)), "");
    assert_eq!(to_text(&Buffer::empty(Rect::new(3, 3, 2, 2))), "\n\n", "blanks at ends are not kept");
}

#[test]
fn styles_are_told_once_for_rows_alike_and_not_for_plain_ones() {
    let mut buffer = Buffer::empty(Rect::new(0, 0, 8, 4));
    buffer.set_style(Rect::new(2, 1, 3, 2), Style::new().fg(Color::LightRed).bg(Color::Rgb(0, 16, 255)));
    buffer.set_style(Rect::new(4, 1, 4, 2), Style::new().add_modifier(Modifier::BOLD | Modifier::REVERSED));
    let styled = to_styled(&buffer);
    let expected = "\n\n\n\nstyles\n1..3: 2..4 lightred on #0010ff, 4..5 bold reverse lightred on #0010ff, 5..8 bold reverse\n";
    assert_eq!(styled, expected);
}

#[test]
fn a_picture_is_told_by_a_hash_that_sees_every_colour() {
    let told = |buffer: &Buffer| {
        let styled = to_styled(buffer);
        styled.lines().find(|line| line.contains("picture")).expect("a picture").to_owned()
    };
    let mut buffer = screen();
    let before = told(&buffer);
    assert!(before.starts_with("4: 1..23 picture "), "{before}");
    buffer[(7, 4)].set_bg(Color::Rgb(1, 2, 3));
    assert_ne!(told(&buffer), before);
}

#[test]
fn what_is_no_text_is_blank() {
    let mut buffer = Buffer::empty(Rect::new(0, 0, 4, 1));
    buffer.set_string(0, 0, "abcd", Style::new());
    let unit = CellDiffOption::ForcedWidth(NonZeroU16::MIN);
    buffer[(0, 0)].set_symbol("\u{1b}_Gpicture\u{1b}\\").set_diff_option(unit);
    buffer[(1, 0)].set_diff_option(CellDiffOption::Skip);
    assert_eq!(to_text(&buffer), "  cd\n");
    assert!(!to_svg(&buffer, &Theme::default()).contains("picture"));
}

#[test]
fn a_wide_character_at_the_edge_does_no_harm() {
    let mut buffer = Buffer::empty(Rect::new(0, 0, 3, 1));
    buffer[(2, 0)].set_symbol("漢");
    assert_eq!(to_text(&buffer), "  漢\n");
    assert!(to_svg(&buffer, &Theme::default()).contains("textLength=\"8\""));
}

/// The attributes of the element around a text.
fn text_element<'s>(svg: &'s str, text: &str) -> &'s str {
    let end = svg.find(&format!(">{text}</text>")).unwrap_or_else(|| panic!("no {text} in {svg}"));
    let start = svg[..end].rfind("<text ").expect("an element");
    &svg[start..end]
}

#[test]
fn a_picture_of_the_screen_puts_text_where_its_cells_are() {
    let svg = to_svg(&screen(), &Theme::default());
    let element = text_element(&svg, "FC &lt;a&gt; &amp; b");
    assert!(element.contains("x=\"16\" y=\"28\" textLength=\"80\""), "{element}");
    let wide = text_element(&svg, "漢");
    assert!(wide.contains("x=\"112\" y=\"28\" textLength=\"16\" lengthAdjust"), "{wide}");
    assert!(text_element(&svg, "selected row").contains("fill=\"#ffffff\" font-weight=\"bold\""));
    assert!(svg.starts_with("<svg xmlns=") && svg.ends_with("</svg>\n"));
    assert!(
        svg.contains("width=\"208\" height=\"112\" viewBox=\"-8 -8 208 112\""),
        "24 x 6 cells and the margin"
    );
}

#[test]
fn halves_of_cells_are_exact_and_lines_are_shapes() {
    let svg = to_svg(&screen(), &Theme::default());
    // The cell in column 3: the upper half in its text's colour, over the whole in its ground's.
    assert!(svg.contains("<path fill=\"#140000\" d=\"M24 64h8v8h-8z\"/>"), "{svg}");
    assert!(svg.contains("<path fill=\"#000014\" d=\"M24 64h8v16h-8z\"/>"));
    // Two full cells and a half.
    assert!(svg.contains("M48 32h20v16h-20z"));
    // The selected row is one rectangle.
    assert!(svg.contains("<path fill=\"#264f78\" d=\"M8 48h176v16h-176z\"/>"));
    // The upper left corner is round, from the right to below.
    assert!(svg.contains("M8 8Q4 8 4 16"), "{svg}");
    assert!(!svg.contains('╭') && !svg.contains('▀') && !svg.contains('█'));
}

#[test]
fn a_picture_of_the_screen_has_its_themes_ground() {
    let mut buffer = Buffer::empty(Rect::new(0, 0, 3, 1));
    buffer.set_string(0, 0, "abc", Style::new().add_modifier(Modifier::REVERSED));
    let svg = to_svg(&buffer, &Theme::new(Base::Light, Depth::Full));
    assert!(svg.contains("rx=\"8\" fill=\"#fbfcfd\""));
    assert!(svg.contains("<path fill=\"#1b2128\" d=\"M0 0h24v16h-24z\"/>"), "{svg}");
    assert!(text_element(&svg, "abc").contains("fill=\"#fbfcfd\""));
}

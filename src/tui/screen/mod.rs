//! A screen as text, as text with its styles, and as a picture.
//!
//! Snapshots of whole screens are kept as text with styles: a difference then reads as what a user would see. Styles are written as in `config.toml`,
//! line by line and run by run; a stretch of a picture is a hash of its colours, since nobody reads those. Pictures that go to the terminal by a
//! protocol of their own are no text: their cells are blank here.

mod glyph;
mod svg;

use std::fmt::Write as _;

use ratatui::buffer::{Buffer, Cell, CellWidth as _};
use ratatui::style::{Color, Modifier};

use super::lower::is_picture_by_protocol;

pub use svg::to_svg;

/// What a cell shows: its place in the row, its text, and itself.
struct Shown<'b> {
    x: u16,
    symbol: &'b str,
    width: u16,
    cell: &'b Cell,
}

/// The cells of a row; one that is covered by a wide one before it shows nothing.
fn row(buffer: &Buffer, y: u16) -> impl Iterator<Item = Shown<'_>> {
    let width = buffer.area.width;
    let mut free = 0;
    (0..width).filter_map(move |x| {
        let cell = buffer.cell((buffer.area.x + x, buffer.area.y + y))?;
        let (symbol, cells) = symbol(cell);
        let cells = cells.min(width - x);
        if x < free {
            return None;
        }
        free = x + cells;
        Some(Shown { x, symbol, width: cells, cell })
    })
}

/// What a cell shows and how wide that is; a blank for what is no text.
fn symbol(cell: &Cell) -> (&str, u16) {
    let symbol = cell.symbol();
    let blank = symbol.is_empty() || symbol.contains(char::is_control) || is_picture_by_protocol(cell);
    if blank { (" ", 1) } else { (symbol, symbol.cell_width().max(1)) }
}

/// The text of a screen, a line for each row, without the blanks at their ends.
pub fn to_text(buffer: &Buffer) -> String {
    let line = |y| row(buffer, y).map(|shown| shown.symbol).collect::<String>();
    (0..buffer.area.height).map(|y| line(y).trim_end().to_owned() + "\n").collect()
}

/// The text of a screen, and then the styles of its rows: `3: 0..5 bold cyan, 7..9 red on blue`. Rows alike are told once, plain ones
/// not at all.
pub fn to_styled(buffer: &Buffer) -> String {
    let mut text = to_text(buffer);
    text.push_str("styles\n");
    let height = buffer.area.height;
    let mut y = 0;
    while y < height {
        let runs = styles(buffer, y);
        let next = (y + 1..height).find(|y| styles(buffer, *y) != runs).unwrap_or(height);
        let rows = if next == y + 1 { y.to_string() } else { format!("{y}..{next}") };
        if !runs.is_empty() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{rows}: {}", runs.join(", "));
        }
        y = next;
    }
    text
}

/// The runs of a row that have a style.
fn styles(buffer: &Buffer, y: u16) -> Vec<String> {
    let shown: Vec<Shown<'_>> = row(buffer, y).collect();
    let runs = shown.chunk_by(|a, b| look(a.cell) == look(b.cell));
    let told = runs.filter_map(|run| {
        let (first, last) = (run.first()?, run.last()?);
        let style = match look(first.cell) {
            Look::Picture => format!("picture {}", hash(run)),
            Look::Style(style) => style,
        };
        (!style.is_empty()).then(|| format!("{}..{} {style}", first.x, last.x + last.width))
    });
    told.collect()
}

/// What is told of a cell.
#[derive(PartialEq)]
enum Look {
    Picture,
    Style(String),
}

fn look(cell: &Cell) -> Look {
    let is_exact = |color: Color| matches!(color, Color::Rgb(..));
    if matches!(cell.symbol(), "▀" | "▄") && is_exact(cell.fg) && is_exact(cell.bg) {
        return Look::Picture;
    }
    let modifiers = MODIFIERS.iter().filter(|(_, modifier)| cell.modifier.contains(*modifier));
    let mut words: Vec<String> = modifiers.map(|(name, _)| (*name).to_owned()).collect();
    words.extend(written(cell.fg));
    words.extend(written(cell.bg).map(|ground| format!("on {ground}")));
    Look::Style(words.join(" "))
}

const MODIFIERS: [(&str, Modifier); 7] = [
    ("bold", Modifier::BOLD),
    ("dim", Modifier::DIM),
    ("italic", Modifier::ITALIC),
    ("underline", Modifier::UNDERLINED),
    ("reverse", Modifier::REVERSED),
    ("crossed-out", Modifier::CROSSED_OUT),
    ("hidden", Modifier::HIDDEN),
];

/// A colour as in `config.toml`; none for the terminal's own.
fn written(color: Color) -> Option<String> {
    (color != Color::Reset).then(|| color.to_string().to_lowercase())
}

/// As much of a hash of the colours as tells two apart.
fn hash(run: &[Shown<'_>]) -> String {
    let mut hasher = blake3::Hasher::new();
    for shown in run {
        for color in [shown.cell.fg, shown.cell.bg] {
            hasher.update(color.to_string().as_bytes());
        }
        hasher.update(shown.symbol.as_bytes());
    }
    hasher.finalize().to_hex()[..8].to_owned()
}

#[cfg(test)]
mod tests;

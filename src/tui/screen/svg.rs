//! A screen as an SVG, for the README: what it shows is made by the program itself, and looks the same everywhere.
//!
//! Colours of cells, blocks and lines are shapes on a grid of whole numbers, so that halves of cells are exact and lines meet. Text goes in
//! whatever monospaced font there is, each run stretched to the cells that it has; only runs of ASCII are longer than a
//! character, since others may come from another font. Nothing is loaded from elsewhere.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::Modifier;

use super::glyph::{Arms, HEIGHT, Part, WIDTH, arms, block};
use super::{Shown, row};
use crate::tui::colour::{self, Rgb};
use crate::tui::theme::Theme;

/// Around the screen.
const MARGIN: u32 = 8;
/// With a line of text every 16, and characters of 0.6 em, which most monospaced fonts have, 8 wide.
const FONT_SIZE: &str = "13.3";
const BASELINE: u32 = 12;
const UNDERLINE: u32 = 14;

/// The screen as an SVG document.
pub fn to_svg(buffer: &Buffer, theme: &Theme) -> String {
    let mut picture = Picture::default();
    for y in 0..buffer.area.height {
        let shown: Vec<Shown<'_>> = row(buffer, y).collect();
        let top = u32::from(y) * HEIGHT;
        shown.iter().for_each(|shown| picture.cell(shown, top, theme));
        picture.words(&shown, top, theme);
    }
    picture.document(u32::from(buffer.area.width) * WIDTH, u32::from(buffer.area.height) * HEIGHT, theme)
}

/// The layers of the picture, from the back; shapes of a colour, or of a colour and weight, share an element.
#[derive(Default)]
struct Picture {
    grounds: BTreeMap<Rgb, Vec<Part>>,
    blocks: BTreeMap<Rgb, Vec<Part>>,
    lines: BTreeMap<(Rgb, u8), String>,
    text: String,
}

/// The colours of a cell's text and ground; `None` for the screen's own ground.
fn colours(cell: &Cell, theme: &Theme) -> (Rgb, Option<Rgb>) {
    let (ink, ground) = (colour::rgb(cell.fg), colour::rgb(cell.bg));
    match cell.modifier.contains(Modifier::REVERSED) {
        true => (ground.unwrap_or(theme.ground()), Some(ink.unwrap_or(theme.ink()))),
        false => (ink.unwrap_or(theme.ink()), ground),
    }
}

impl Picture {
    fn cell(&mut self, shown: &Shown<'_>, top: u32, theme: &Theme) {
        let (ink, ground) = colours(shown.cell, theme);
        let left = left(shown);
        let whole = [0, 0, width(shown), HEIGHT];
        let at = |[x, y, w, h]: Part| [left + x, top + y, w, h];
        if let Some(ground) = ground {
            fill(&mut self.grounds, ground, at(whole));
        }
        if let Some(part) = block(shown.symbol) {
            fill(&mut self.blocks, ink, at(part));
        }
        if shown.cell.modifier.contains(Modifier::UNDERLINED) {
            fill(&mut self.blocks, ink, at([0, UNDERLINE, whole[2], 1]));
        }
        if let Some(arms) = arms(shown.symbol) {
            self.line(arms, ink, left + WIDTH / 2, top + HEIGHT / 2);
        }
    }

    /// A line, from the middle of its cell.
    fn line(&mut self, arms: Arms, ink: Rgb, x: u32, y: u32) {
        let [half_width, half_height] = [WIDTH / 2, HEIGHT / 2];
        let ends = [(x, y - half_height), (x + half_width, y), (x, y + half_height), (x - half_width, y)];
        let mut arms_and_ends = arms.weights.iter().zip(ends).filter(|(weight, _)| **weight > 0);
        if arms.round {
            let (Some((weight, a)), Some((_, b))) = (arms_and_ends.next(), arms_and_ends.next()) else {
                return;
            };
            let path = self.lines.entry((ink, *weight)).or_default();
            add(path, format_args!("M{} {}Q{x} {y} {} {}", a.0, a.1, b.0, b.1));
            return;
        }
        for (weight, end) in arms_and_ends {
            let path = self.lines.entry((ink, *weight)).or_default();
            add(path, format_args!("M{x} {y}L{} {}", end.0, end.1));
        }
    }

    /// The text of a row, in runs.
    fn words(&mut self, row: &[Shown<'_>], top: u32, theme: &Theme) {
        let is_text = |shown: &Shown<'_>| {
            let hidden = shown.cell.modifier.contains(Modifier::HIDDEN);
            !hidden && block(shown.symbol).is_none() && arms(shown.symbol).is_none()
        };
        let joins = |a: &Shown<'_>, b: &Shown<'_>| {
            let blank = a.symbol == " " && b.symbol == " ";
            let ascii = a.symbol.is_ascii() && b.symbol.is_ascii();
            !blank && ascii && a.cell.style() == b.cell.style() && is_text(a) == is_text(b)
        };
        for run in row.chunk_by(joins).filter(|run| run.iter().all(is_text)) {
            let start = run.iter().position(|shown| shown.symbol != " ").unwrap_or(run.len());
            let end = run.iter().rposition(|shown| shown.symbol != " ").map_or(start, |last| last + 1);
            if let [first, ..] = &run[start..end] {
                self.run(first, &run[start..end], top + BASELINE, theme);
            }
        }
    }

    /// A run of text of one style.
    fn run(&mut self, first: &Shown<'_>, run: &[Shown<'_>], base: u32, theme: &Theme) {
        let has = |modifier| first.cell.modifier.contains(modifier);
        let modifiers = [
            (Modifier::BOLD, " font-weight=\"bold\""),
            (Modifier::ITALIC, " font-style=\"italic\""),
            (Modifier::DIM, " opacity=\".6\""),
            (Modifier::CROSSED_OUT, " text-decoration=\"line-through\""),
        ];
        let attributes: String = modifiers.iter().filter(|(m, _)| has(*m)).map(|(_, text)| *text).collect();
        let left = left(first);
        let length: u32 = run.iter().map(width).sum();
        let (ink, _) = colours(first.cell, theme);
        let text: String = run.iter().map(|shown| escaped(shown.symbol)).collect();
        // A character of another font may be wider than its cells.
        let squeezed = if text.is_ascii() { "" } else { " lengthAdjust=\"spacingAndGlyphs\"" };
        add(
            &mut self.text,
            format_args!(
                "<text x=\"{left}\" y=\"{base}\" textLength=\"{length}\"{squeezed} fill=\"{}\"{attributes}>{text}</text>\n",
                hex(ink)
            ),
        );
    }

    fn document(&self, width: u32, height: u32, theme: &Theme) -> String {
        let (width, height) = (width + 2 * MARGIN, height + 2 * MARGIN);
        let mut out = String::new();
        add(
            &mut out,
            format_args!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
                 viewBox=\"-{MARGIN} -{MARGIN} {width} {height}\">\n\
                 <rect x=\"-{MARGIN}\" y=\"-{MARGIN}\" width=\"{width}\" height=\"{height}\" rx=\"{MARGIN}\" fill=\"{}\"/>\n\
                 <g shape-rendering=\"crispEdges\">\n",
                hex(theme.ground())
            ),
        );
        for (ink, parts) in self.grounds.iter().chain(&self.blocks) {
            add(&mut out, format_args!("<path fill=\"{}\" d=\"", hex(*ink)));
            parts.iter().for_each(|[x, y, w, h]| add(&mut out, format_args!("M{x} {y}h{w}v{h}h-{w}z")));
            out.push_str("\"/>\n");
        }
        out.push_str("</g>\n<g fill=\"none\">\n");
        for ((ink, weight), path) in &self.lines {
            add(
                &mut out,
                format_args!("<path stroke=\"{}\" stroke-width=\"{weight}\" d=\"{path}\"/>\n", hex(*ink)),
            );
        }
        add(
            &mut out,
            format_args!(
                "</g>\n<g font-family=\"ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace\" \
                 font-size=\"{FONT_SIZE}\">\n{}</g>\n</svg>\n",
                self.text
            ),
        );
        out
    }
}

fn left(shown: &Shown<'_>) -> u32 {
    u32::from(shown.x) * WIDTH
}

fn width(shown: &Shown<'_>) -> u32 {
    u32::from(shown.width) * WIDTH
}

/// Adds a part to those of its colour; one that continues the last of them makes it longer.
fn fill(layer: &mut BTreeMap<Rgb, Vec<Part>>, ink: Rgb, part: Part) {
    let parts = layer.entry(ink).or_default();
    match parts.last_mut() {
        Some(last) if (last[0] + last[2], last[1], last[3]) == (part[0], part[1], part[3]) => {
            last[2] += part[2]
        }
        _ => parts.push(part),
    }
}

/// Writing to a string cannot fail.
fn add(to: &mut String, what: std::fmt::Arguments<'_>) {
    let _ = to.write_fmt(what);
}

fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(symbol: &str) -> String {
    symbol.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

//! A ladder as a picture: a strip for each program, a cell for each rung. A cell is empty where every cut is done; it is filled the more cuts fail,
//! in another colour the more are refused. So one sees at a glance on which rung a program begins to fail.
//!
//! Colours are those of [`crate::measure::plot`]; the picture brings its own ground, light or dark as the viewer prefers.

use std::fmt::Write as _;

use super::report::{LadderReport, capitalised, number};
use super::rung::{Rung, Theirs};

/// Left and right end of the strips, and where the first begins.
const LEFT: f64 = 132.0;
const RIGHT: f64 = 796.0;
const TOP: f64 = 78.0;
/// Height of a strip, and of the picture.
const STRIP: f64 = 52.0;
const HEIGHT: f64 = 308.0;

const STYLE: &str = "
.ground{fill:#ffffff;stroke:#d8dce2}.cell{fill:#fafbfc;stroke:#c3c9d1}.failed{fill:#d55e00}.refused{fill:#0072b2}
text{fill:#3b434e;font-family:system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif;font-size:12px}
.title{font-size:17px;font-weight:600;fill:#161b22}.count{font-size:11px}
@media (prefers-color-scheme: dark){.ground{fill:#14181f;stroke:#303845}.cell{fill:#181d25;stroke:#3c4654}
.failed{fill:#ff8c42}.refused{fill:#56b4e9}text{fill:#c3cad4}.title{fill:#f0f3f7}}
";

/// What one program did on a rung: cuts asked for, failed and refused.
type Cell = (usize, usize, usize);

/// What a program came to on a rung.
type Of = fn(&Rung) -> Cell;

fn ours(rung: &Rung) -> Cell {
    (rung.cuts, rung.ours.findings, rung.ours.refused.values().sum())
}

fn theirs(theirs: &Theirs) -> Cell {
    (theirs.asked, theirs.lost() + theirs.wrong(), 0)
}

/// The picture as an SVG document.
pub(super) fn svg(ladder: &LadderReport) -> String {
    let mut out = String::new();
    head(&mut out, ladder);
    let programs: [(&str, Of); 3] = [
        ("engine", ours),
        ("f64 with ε", |rung| theirs(&rung.plain_f64)),
        ("f32 with ε", |rung| theirs(&rung.plain_f32)),
    ];
    let width = (RIGHT - LEFT) / ladder.rungs.len().max(1) as f64;
    for (i, (name, of)) in programs.into_iter().enumerate() {
        let y = TOP + i as f64 * (STRIP + 6.0);
        text(&mut out, [LEFT - 12.0, y + 0.5 * STRIP + 4.0], "end", "", name);
        for (j, rung) in ladder.rungs.iter().enumerate() {
            cell(&mut out, [LEFT + j as f64 * width, y, width - 3.0], rung, name, of(rung));
        }
    }
    let below = TOP + 3.0 * (STRIP + 6.0) + 12.0;
    for (j, rung) in ladder.rungs.iter().enumerate() {
        let x = LEFT + (j as f64 + 0.5) * width - 1.5;
        text(&mut out, [x, below], "middle", "", &number(rung.value));
    }
    text(&mut out, [0.5 * (LEFT + RIGHT), below + 26.0], "middle", "", &ladder.unit);
    out.push_str("</svg>\n");
    out
}

fn head(out: &mut String, ladder: &LadderReport) {
    let title = format!("{}: cuts that fail", capitalised(&ladder.name));
    add(
        out,
        format_args!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 820 {HEIGHT}" width="820" height="{HEIGHT}" role="img">"#
        ),
    );
    add(out, format_args!("<title>{title}</title><style>{STYLE}</style>"));
    add(
        out,
        format_args!(r#"<rect class="ground" x=".5" y=".5" width="819" height="{}" rx="8"/>"#, HEIGHT - 1.0),
    );
    text(out, [24.0, 36.0], "start", "title", &title);
    let cuts = ladder.rungs.first().map_or(0, |rung| rung.cuts);
    let key = format!("of {cuts} on every rung; orange: failed, blue: refused by the engine");
    text(out, [24.0, 58.0], "start", "count", &key);
}

fn cell(out: &mut String, [x, y, width]: [f64; 3], rung: &Rung, name: &str, (asked, failed, refused): Cell) {
    let share = |part: usize| part as f64 / asked.max(1) as f64;
    let (x, width) = (round(x), round(width));
    let said = format!("{name} at {}: {failed} of {asked} failed, {refused} refused", number(rung.value));
    add(
        out,
        format_args!(
            r#"<g><title>{said}</title><rect class="cell" x="{x}" y="{y}" width="{width}" height="{STRIP}" rx="3"/>"#
        ),
    );
    // From below: what failed, and on it what was refused.
    let mut floor = y + STRIP;
    for (class, part) in [("failed", failed), ("refused", refused)].into_iter().filter(|(_, n)| *n > 0) {
        // A single cut is to be seen, too.
        let height = round((share(part) * STRIP).max(2.0));
        floor -= height;
        add(
            out,
            format_args!(
                r#"<rect class="{class}" x="{x}" y="{}" width="{width}" height="{height}"/>"#,
                round(floor)
            ),
        );
    }
    if failed + refused > 0 {
        let count = if failed > 0 { failed } else { refused };
        text(out, [x + 0.5 * width, y + 15.0], "middle", "count", &count.to_string());
    }
    add(out, format_args!("</g>"));
}

fn text(out: &mut String, [x, y]: [f64; 2], anchor: &str, class: &str, said: &str) {
    let (x, y) = (round(x), round(y));
    add(out, format_args!(r#"<text class="{class}" x="{x}" y="{y}" text-anchor="{anchor}">{said}</text>"#));
}

fn add(out: &mut String, line: std::fmt::Arguments<'_>) {
    // A string takes everything.
    let _ = writeln!(out, "{line}");
}

fn round(v: f64) -> f64 {
    (v * 10.0).round() / 10.0
}

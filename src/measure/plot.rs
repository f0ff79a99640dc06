//! A plot of price against price, as SVG: points on two logarithmic axes, less being better on both, and a staircase along what nothing beats.
//!
//! A point on the front is filled, others are hollow; below and left of the staircase there is nothing to be had. Each series has a colour (Okabe and Ito 2008,
//! which the colour-blind can tell apart) and a shape. An error of nought has no logarithm: it lies on a line of its own at the bottom. The picture
//! brings its own ground, light or dark as the viewer prefers, and its text is text. Nothing is loaded from elsewhere.
//!
//! Not promised: a label for every point; one that fits nowhere is left out, and shown when the point is pointed at.

mod labels;
mod scale;

use std::fmt::Write as _;

use labels::{Labels, Place};
use scale::Scale;

/// A point.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Microseconds.
    pub x: f64,
    /// The error, from nought up.
    pub y: f64,
    /// What it is called.
    pub label: String,
    /// Whether nothing beats it.
    pub front: bool,
}

/// Points that do the same task.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is called.
    pub name: String,
    /// Its points.
    pub marks: Vec<Mark>,
}

/// A picture of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// What stands below.
    pub across: String,
    /// What stands at the left.
    pub up: String,
    /// The points.
    pub series: Vec<Series>,
}

/// Width and height.
const SIZE: [f64; 2] = [820.0, 500.0];
/// Left, top, right and bottom of the frame.
const FRAME: [f64; 4] = [86.0, 92.0, 796.0, 436.0];
/// About how wide a character of the legend is.
const CHARACTER: f64 = 6.9;

/// Colours on light and on dark ground.
const STYLE: &str = "
.ground{fill:#ffffff;stroke:#d8dce2}.frame{fill:#fafbfc;stroke:#c3c9d1}.grid{stroke:#e6e9ee}.fine{stroke:#f1f3f6}
text{fill:#3b434e;font-family:system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif;font-size:12px}
.title{font-size:17px;font-weight:600;fill:#161b22}.axis{font-size:12.5px;fill:#3b434e}.label{font-size:11px}
.zero{stroke:#9aa3ae;stroke-dasharray:2 4}.stairs{fill:none;stroke-width:1.75;stroke-opacity:.75}.mark{stroke-width:1.75}
";
const DARK: &str = "
.ground{fill:#14181f;stroke:#303845}.frame{fill:#181d25;stroke:#3c4654}.grid{stroke:#2a323d}.fine{stroke:#20262f}
text,.axis{fill:#c3cad4}.title{fill:#f0f3f7}.zero{stroke:#6d7885}
";
/// The colours of the series, on light and on dark ground.
const COLOURS: [[&str; 2]; 6] = [
    ["#0072b2", "#56b4e9"],
    ["#d55e00", "#ff8c42"],
    ["#009e73", "#3ecf9f"],
    ["#b0508a", "#e59bc6"],
    ["#a87400", "#f0c04a"],
    ["#555c66", "#aab2bd"],
];

/// The plot as an SVG document.
pub fn svg(plot: &Plot) -> String {
    let [left, top, right, bottom] = FRAME;
    let marks = || plot.series.iter().flat_map(|series| &series.marks);
    let axes = Axes {
        x: Scale::over(marks().map(|m| m.x), [left, right]),
        y: Scale::over(marks().map(|m| m.y), [bottom, top]),
    };
    let mut out = String::new();
    head(&mut out, plot);
    axes.draw(&mut out, plot);
    legend(&mut out, plot);
    plot.series.iter().enumerate().for_each(|(i, series)| stairs(&mut out, &axes, i, series));
    plot.series.iter().enumerate().for_each(|(i, series)| points(&mut out, &axes, i, series));
    names(&mut out, &axes, plot);
    out.push_str("</svg>\n");
    out
}

struct Axes {
    x: Scale,
    y: Scale,
}

impl Axes {
    fn at(&self, mark: &Mark) -> [f64; 2] {
        [self.x.at(mark.x), self.y.at(mark.y)]
    }

    fn draw(&self, out: &mut String, plot: &Plot) {
        let [left, top, right, bottom] = FRAME;
        add(
            out,
            format_args!(
                r#"<rect class="frame" x="{left}" y="{top}" width="{}" height="{}"/>"#,
                right - left,
                bottom - top
            ),
        );
        for tick in self.x.ticks() {
            let (x, class) = (round(tick.at), if tick.named { "grid" } else { "fine" });
            add(out, format_args!(r#"<path class="{class}" d="M{x} {top}V{bottom}"/>"#));
            if tick.named {
                add(
                    out,
                    format_args!(
                        r#"<text x="{x}" y="{}" text-anchor="middle">{}</text>"#,
                        bottom + 18.0,
                        scale::time(tick.value)
                    ),
                );
            }
        }
        for tick in self.y.ticks() {
            let (y, class) = (round(tick.at), if tick.named { "grid" } else { "fine" });
            add(out, format_args!(r#"<path class="{class}" d="M{left} {y}H{right}"/>"#));
            if tick.named {
                add(
                    out,
                    format_args!(
                        r#"<text x="{}" y="{}" text-anchor="end">{}</text>"#,
                        left - 8.0,
                        y + 4.0,
                        scale::number(tick.value)
                    ),
                );
            }
        }
        if let Some(y) = self.y.zero() {
            add(
                out,
                format_args!(
                    r#"<path class="zero" d="M{left} {y}H{right}"/><text x="{}" y="{}" text-anchor="end">0</text>"#,
                    left - 8.0,
                    y + 4.0
                ),
            );
        }
        let (middle, level) = (0.5 * (left + right), 0.5 * (top + bottom));
        add(
            out,
            format_args!(
                r#"<text class="axis" x="{middle}" y="{}" text-anchor="middle">{}</text>"#,
                bottom + 44.0,
                escaped(&plot.across)
            ),
        );
        add(
            out,
            format_args!(
                r#"<text class="axis" transform="translate(24 {level}) rotate(-90)" text-anchor="middle">{}</text>"#,
                escaped(&plot.up)
            ),
        );
    }
}

fn head(out: &mut String, plot: &Plot) {
    let [width, height] = SIZE;
    add(
        out,
        format_args!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img">"#
        ),
    );
    add(out, format_args!("<title>{}</title>", escaped(&plot.title)));
    add(out, format_args!("<style>{STYLE}{}", colours(0)));
    add(out, format_args!("@media (prefers-color-scheme: dark){{{DARK}{}}}</style>", colours(1)));
    add(
        out,
        format_args!(
            r#"<rect class="ground" x=".5" y=".5" width="{}" height="{}" rx="8"/>"#,
            width - 1.0,
            height - 1.0
        ),
    );
    add(out, format_args!(r#"<text class="title" x="24" y="36">{}</text>"#, escaped(&plot.title)));
}

/// A series has a stroke, its filled points a fill, its hollow ones the frame's.
fn colours(ground: usize) -> String {
    let frame = ["#fafbfc", "#181d25"][ground];
    let rule = |(i, colour): (usize, &[&str; 2])| {
        let colour = colour[ground];
        format!(
            ".s{i}{{stroke:{colour}}}.f{i}{{fill:{colour};stroke:{colour}}}.h{i}{{fill:{frame};stroke:{colour}}}\n"
        )
    };
    COLOURS.iter().enumerate().map(rule).collect()
}

fn legend(out: &mut String, plot: &Plot) {
    let mut x = 30.0;
    for (i, series) in plot.series.iter().enumerate() {
        shape(out, [x, 64.0], i, true, "");
        add(out, format_args!(r#"<text x="{}" y="68">{}</text>"#, x + 12.0, escaped(&series.name)));
        x += 36.0 + CHARACTER * series.name.chars().count() as f64;
    }
    let text = "filled: nothing is both faster and better";
    add(out, format_args!(r#"<text class="label" x="{}" y="36" text-anchor="end">{text}</text>"#, FRAME[2]));
}

/// The staircase along the front: from each of its points across to the next one's time, then down.
fn stairs(out: &mut String, axes: &Axes, i: usize, series: &Series) {
    let mut front: Vec<&Mark> = series.marks.iter().filter(|mark| mark.front).collect();
    front.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(b.y.total_cmp(&a.y)));
    let Some(first) = front.first() else { return };
    let [_, top, right, _] = FRAME;
    let mut path = format!("M{} {top}", round(axes.at(first)[0]));
    for mark in &front {
        let [x, y] = axes.at(mark).map(round);
        add(&mut path, format_args!("H{x}V{y}"));
    }
    add(out, format_args!(r#"<path class="stairs s{}" d="{path}H{right}"/>"#, i % COLOURS.len()));
}

fn points(out: &mut String, axes: &Axes, i: usize, series: &Series) {
    for mark in &series.marks {
        let said =
            format!("{}: {}, {} in {}", series.name, mark.label, scale::number(mark.y), scale::time(mark.x));
        shape(out, axes.at(mark), i, mark.front, &said);
    }
}

/// A point of a series; what it says when it is pointed at.
fn shape(out: &mut String, at: [f64; 2], i: usize, filled: bool, said: &str) {
    let [x, y] = at.map(round);
    let class = format!("mark {}{}", if filled { "f" } else { "h" }, i % COLOURS.len());
    let path = match i % 4 {
        0 => format!("M{} {y}a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z", x - 4.5),
        1 => format!("M{} {}h8v8h-8z", x - 4.0, y - 4.0),
        2 => format!("M{x} {}l5.2 9h-10.4z", y - 5.5),
        _ => format!("M{x} {}l5.4 5.4l-5.4 5.4l-5.4 -5.4z", y - 5.4),
    };
    let title = if said.is_empty() { String::new() } else { format!("<title>{}</title>", escaped(said)) };
    add(out, format_args!(r#"<path class="{class}" d="{path}">{title}</path>"#));
}

/// The points' names, those on the front first.
fn names(out: &mut String, axes: &Axes, plot: &Plot) {
    let all = || plot.series.iter().flat_map(|series| &series.marks);
    let mut labels = Labels::new(FRAME, all().map(|mark| axes.at(mark)).collect());
    let (front, behind): (Vec<&Mark>, Vec<&Mark>) = all().partition(|mark| mark.front);
    for mark in front.into_iter().chain(behind) {
        if let Some(Place { x, y, anchor }) = labels.place(axes.at(mark), &mark.label) {
            let (x, y, text) = (round(x), round(y), escaped(&mark.label));
            add(
                out,
                format_args!(r#"<text class="label" x="{x}" y="{y}" text-anchor="{anchor}">{text}</text>"#),
            );
        }
    }
}

fn round(v: f64) -> f64 {
    (v * 10.0).round() / 10.0
}

fn add(out: &mut String, text: std::fmt::Arguments<'_>) {
    // A string takes everything.
    let _ = out.write_fmt(text);
    if text.as_str().is_none_or(|text| text.starts_with('<')) && out.ends_with('>') {
        out.push('\n');
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(marks: Vec<Mark>) -> Plot {
        let series = vec![Series { name: "a < b".into(), marks }];
        Plot { title: "t & t".into(), across: "time".into(), up: "error".into(), series }
    }

    fn mark(x: f64, y: f64, front: bool) -> Mark {
        Mark { x, y, label: format!("at {x}"), front }
    }

    #[test]
    fn every_point_is_drawn_within_the_frame_and_the_front_has_its_staircase() {
        let text = svg(&plot(vec![mark(1.0, 100.0, true), mark(10.0, 1.0, true), mark(100.0, 50.0, false)]));
        assert_eq!(text.matches("class=\"mark f0\"").count(), 3, "two, and the legend's");
        assert_eq!(text.matches("class=\"mark h0\"").count(), 1);
        assert_eq!(text.matches("class=\"stairs").count(), 1);
        assert!(text.contains("t &amp; t") && text.contains("a &lt; b") && text.contains("at 10</text>"));
        assert!(text.starts_with("<svg") && text.ends_with("</svg>\n") && !text.contains("NaN"));
    }

    #[test]
    fn a_nought_has_a_line_of_its_own_and_nothing_at_all_is_a_picture_too() {
        let text = svg(&plot(vec![mark(1.0, 0.0, true), mark(2.0, 3.0, false)]));
        assert!(text.contains("class=\"zero\"") && !text.contains("inf"));
        for marks in [Vec::new(), vec![mark(5.0, 5.0, true)], vec![mark(0.0, 0.0, true)]] {
            let text = svg(&plot(marks));
            assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        }
    }
}

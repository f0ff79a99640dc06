//! How a plot looks on light and on dark ground.

/// All but the series, on light ground.
pub(super) const LIGHT: &str = "
.ground{fill:#ffffff;stroke:#d8dce2}.frame{fill:#fafbfc;stroke:#c3c9d1}.grid{stroke:#e6e9ee}.fine{stroke:#f1f3f6}
text{fill:#3b434e;font-family:system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif;font-size:12px}
.title{font-size:17px;font-weight:600;fill:#161b22}.axis{font-size:12.5px;fill:#3b434e}.label{font-size:11px;paint-order:stroke;stroke:#fafbfc;stroke-width:3px;stroke-linejoin:round}
.zero{stroke:#9aa3ae;stroke-dasharray:2 4}.stairs{fill:none;stroke-width:1.75;stroke-opacity:.75}.mark{stroke-width:1.75}
";
/// And on dark ground.
pub(super) const DARK: &str = "
.ground{fill:#14181f;stroke:#303845}.frame{fill:#181d25;stroke:#3c4654}.grid{stroke:#2a323d}.fine{stroke:#20262f}
.label{stroke:#181d25}text,.axis{fill:#c3cad4}.title{fill:#f0f3f7}.zero{stroke:#6d7885}
";
/// The colours of the series, on light and on dark ground.
pub(super) const COLOURS: [[&str; 2]; 6] = [
    ["#0072b2", "#56b4e9"],
    ["#d55e00", "#ff8c42"],
    ["#009e73", "#3ecf9f"],
    ["#b0508a", "#e59bc6"],
    ["#a87400", "#f0c04a"],
    ["#555c66", "#aab2bd"],
];

/// A series has a stroke, its filled points a fill, its hollow ones the frame's.
pub(super) fn colours(ground: usize) -> String {
    let frame = ["#fafbfc", "#181d25"][ground];
    let rule = |(i, colour): (usize, &[&str; 2])| {
        let colour = colour[ground];
        format!(
            ".s{i}{{stroke:{colour}}}.f{i}{{fill:{colour};stroke:{colour}}}.h{i}{{fill:{frame};stroke:{colour}}}\n"
        )
    };
    COLOURS.iter().enumerate().map(rule).collect()
}

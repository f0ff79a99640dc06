//! Colours as numbers: what a terminal's named and numbered colours look like, and which of them is nearest to a given one.
//!
//! Distance is the "redmean" approximation (T. Riemersma, "Colour metric"): a weighted Euclidean distance whose weights follow the mean of the two
//! reds. It needs whole numbers alone, and its order is close to that of CIELUV. What the sixteen look like is up to the
//! user's terminal; taken here are xterm's.

use ratatui::style::Color;

/// Red, green and blue.
pub type Rgb = [u8; 3];

/// The sixteen, in the order of their numbers.
const SIXTEEN: [(Color, Rgb); 16] = [
    (Color::Black, [0, 0, 0]),
    (Color::Red, [205, 0, 0]),
    (Color::Green, [0, 205, 0]),
    (Color::Yellow, [205, 205, 0]),
    (Color::Blue, [0, 0, 238]),
    (Color::Magenta, [205, 0, 205]),
    (Color::Cyan, [0, 205, 205]),
    (Color::Gray, [229, 229, 229]),
    (Color::DarkGray, [127, 127, 127]),
    (Color::LightRed, [255, 0, 0]),
    (Color::LightGreen, [0, 255, 0]),
    (Color::LightYellow, [255, 255, 0]),
    (Color::LightBlue, [92, 92, 255]),
    (Color::LightMagenta, [255, 0, 255]),
    (Color::LightCyan, [0, 255, 255]),
    (Color::White, [255, 255, 255]),
];
/// The steps of the cube of 216 colours, from number 16.
const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];
const FIRST_OF_CUBE: u8 = 16;
/// The 24 greys, from 8 in steps of 10.
const FIRST_GREY: u8 = 232;

/// What a colour looks like; `None` for the terminal's own ([`Color::Reset`]).
pub fn rgb(color: Color) -> Option<Rgb> {
    match color {
        Color::Reset => None,
        Color::Rgb(r, g, b) => Some([r, g, b]),
        Color::Indexed(n) => Some(numbered(n)),
        named => SIXTEEN.iter().find(|(color, _)| *color == named).map(|(_, rgb)| *rgb),
    }
}

/// What a numbered colour looks like.
fn numbered(n: u8) -> Rgb {
    match n {
        0..FIRST_OF_CUBE => SIXTEEN[usize::from(n)].1,
        FIRST_OF_CUBE..FIRST_GREY => {
            let n = usize::from(n - FIRST_OF_CUBE);
            [CUBE[n / 36], CUBE[n / 6 % 6], CUBE[n % 6]]
        }
        FIRST_GREY.. => [8 + 10 * (n - FIRST_GREY); 3],
    }
}

/// The nearest of the sixteen.
pub fn nearest_named(rgb: Rgb) -> Color {
    let nearest = SIXTEEN.iter().min_by_key(|(_, other)| distance(rgb, *other));
    nearest.map_or(Color::Reset, |(color, _)| *color)
}

/// The nearest of the 240 that look the same in every terminal.
pub fn nearest_numbered(rgb: Rgb) -> Color {
    let step = |c: u8| (0..6u8).min_by_key(|i| c.abs_diff(CUBE[usize::from(*i)])).unwrap_or(0);
    let cube = FIRST_OF_CUBE + 36 * step(rgb[0]) + 6 * step(rgb[1]) + step(rgb[2]);
    let grey = FIRST_GREY + (luma(rgb).saturating_sub(3) / 10).min(23);
    let nearest = if distance(rgb, numbered(grey)) < distance(rgb, numbered(cube)) { grey } else { cube };
    Color::Indexed(nearest)
}

/// How bright it looks, from 0 to 255 (Rec. 601).
pub fn luma([r, g, b]: Rgb) -> u8 {
    let sum = 299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b);
    (sum / 1000) as u8
}

/// Redmean, squared and times 256.
fn distance(a: Rgb, b: Rgb) -> u32 {
    let mean = (u32::from(a[0]) + u32::from(b[0])) / 2;
    let square = |i: usize| u32::from(a[i].abs_diff(b[i])) * u32::from(a[i].abs_diff(b[i]));
    (512 + mean) * square(0) + 1024 * square(1) + (767 - mean) * square(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_of_what_there_is_is_itself() {
        for (color, rgb) in SIXTEEN {
            assert_eq!(nearest_named(rgb), color);
            assert_eq!(super::rgb(color), Some(rgb));
        }
        for n in FIRST_OF_CUBE..=255 {
            let Color::Indexed(nearest) = nearest_numbered(numbered(n)) else { panic!("{n}") };
            assert_eq!(numbered(nearest), numbered(n), "{n} and {nearest}");
        }
    }

    #[test]
    fn the_nearest_is_one_that_looks_alike() {
        assert_eq!(nearest_named([20, 10, 15]), Color::Black);
        assert_eq!(nearest_named([240, 240, 250]), Color::White);
        assert_eq!(nearest_named([200, 30, 20]), Color::Red);
        assert_eq!(nearest_named([120, 130, 125]), Color::DarkGray);
        assert_eq!(nearest_numbered([129, 127, 128]), Color::Indexed(244));
        assert_eq!(nearest_numbered([250, 0, 3]), Color::Indexed(196));
    }

    #[test]
    fn brightness_runs_from_black_to_white() {
        assert_eq!([luma([0; 3]), luma([255; 3])], [0, 255]);
        assert!(luma([0, 255, 0]) > luma([255, 0, 0]) && luma([255, 0, 0]) > luma([0, 0, 255]));
    }
}

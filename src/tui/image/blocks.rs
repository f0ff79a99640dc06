//! Pictures of half blocks: a character of two colours shows two pixels, one above the other.
//!
//! Made here and not by a library, which would paint black where there is no picture, and true colours where there are sixteen. Without any colour
//! the character's own weight tells light from dark.

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};
use ratatui::style::Color;
use ratatui::widgets::Widget;

use crate::canvas::image::Image;

/// How many colours a terminal has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// All.
    True,
    /// The usual 256.
    Indexed,
    /// Sixteen.
    Sixteen,
    /// None: shades of the character's own weight.
    Grey,
}

/// Characters from empty to full.
const SHADES: [char; 5] = [' ', '░', '▒', '▓', '█'];

/// What the usual sixteen colours look like.
const SIXTEEN: [(Color, [u8; 3]); 16] = [
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

/// A cell's two colours, the upper one first; none where there is no picture.
type Pair = [Option<Color>; 2];

/// A picture of half blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    size: Size,
    cells: Vec<(char, Pair)>,
}

impl Blocks {
    /// Of a picture of 1 x 2 pixels a cell; where its alpha is 0 nothing is drawn.
    pub fn new(image: &Image, depth: Depth) -> Self {
        let [width, height] = [image.size[0], image.size[1] / 2].map(|side| side.min(u16::MAX.into()));
        let cell = |i: u32| {
            let (x, y) = (i % width, 2 * (i / width));
            cell([image.at(x, y), image.at(x, y + 1)], depth)
        };
        Self { size: Size::new(width as u16, height as u16), cells: (0..width * height).map(cell).collect() }
    }

    /// Its cells, across and down.
    pub fn size(&self) -> Size {
        self.size
    }
}

impl Widget for &Blocks {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(buffer.area);
        for (i, (symbol, pair)) in self.cells.iter().enumerate() {
            let [x, y] = [i % usize::from(self.size.width), i / usize::from(self.size.width)];
            if x < area.width.into() && y < area.height.into() {
                set(&mut buffer[(area.x + x as u16, area.y + y as u16)], *symbol, *pair);
            }
        }
    }
}

fn set(cell: &mut Cell, symbol: char, [front, back]: Pair) {
    if symbol != ' ' || back.is_some() {
        cell.set_char(symbol);
    }
    front.map(|colour| cell.set_fg(colour));
    back.map(|colour| cell.set_bg(colour));
}

/// The character of two pixels, its own colour, and the colour behind it.
fn cell(pixels: [[u8; 4]; 2], depth: Depth) -> (char, Pair) {
    if depth == Depth::Grey {
        return (shade(pixels), [None, None]);
    }
    match pixels.map(|[r, g, b, a]| (a > 0).then(|| colour([r, g, b], depth))) {
        [None, None] => (' ', [None, None]),
        [Some(upper), None] => ('▀', [Some(upper), None]),
        [None, lower] => ('▄', [lower, None]),
        [upper, lower] if upper == lower => (' ', [None, lower]),
        both => ('▀', both),
    }
}

/// The character as light as two pixels are together.
fn shade(pixels: [[u8; 4]; 2]) -> char {
    let light = |[r, g, b, a]: [u8; 4]| {
        if a == 0 { 0 } else { (2 * usize::from(r) + 5 * usize::from(g) + usize::from(b)) / 8 }
    };
    SHADES[(light(pixels[0]) + light(pixels[1])) * SHADES.len() / 511]
}

fn colour(rgb: [u8; 3], depth: Depth) -> Color {
    let [r, g, b] = rgb;
    match depth {
        Depth::True => Color::Rgb(r, g, b),
        Depth::Indexed => Color::Indexed(indexed(rgb)),
        Depth::Sixteen | Depth::Grey => {
            let nearest = SIXTEEN.iter().min_by_key(|(_, known)| distance(rgb, *known));
            nearest.map_or(Color::Reset, |(colour, _)| *colour)
        }
    }
}

/// The nearest of the cube of 6 x 6 x 6 and the ramp of 24 greys.
fn indexed(rgb: [u8; 3]) -> u8 {
    let level = |step: u8| if step == 0 { 0 } else { 55 + 40 * step };
    let step = |v: u8| (0..6).min_by_key(|step| level(*step).abs_diff(v)).unwrap_or(0);
    let cube = rgb.map(step);
    let mean = (rgb.iter().map(|v| u32::from(*v)).sum::<u32>() / 3) as u8;
    let grey = (0..24_u8).min_by_key(|i| (8 + 10 * i).abs_diff(mean)).unwrap_or(0);
    let cubed = distance(rgb, cube.map(level));
    if distance(rgb, [8 + 10 * grey; 3]) < cubed {
        232 + grey
    } else {
        16 + 36 * cube[0] + 6 * cube[1] + cube[2]
    }
}

/// How far two colours are apart, each channel by what it counts for light.
fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    let off = |k: usize| u32::from(a[k].abs_diff(b[k]));
    2 * off(0) * off(0) + 4 * off(1) * off(1) + 3 * off(2) * off(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(image: &Image, depth: Depth, area: Rect) -> Buffer {
        let mut buffer = Buffer::filled(Rect::new(0, 0, 4, 2), Cell::new("x"));
        Blocks::new(image, depth).render(area, &mut buffer);
        buffer
    }

    fn column(upper: [u8; 4], lower: [u8; 4]) -> Image {
        Image { size: [1, 2], texels: vec![upper, lower] }
    }

    fn only(image: &Image, depth: Depth) -> Cell {
        drawn(image, depth, Rect::new(0, 0, 1, 1))[(0, 0)].clone()
    }

    const RED: [u8; 4] = [250, 3, 3, 255];
    const BLUE: [u8; 4] = [0, 0, 240, 255];

    #[test]
    fn a_cell_shows_two_pixels() {
        let cell = only(&column(RED, BLUE), Depth::True);
        assert_eq!((cell.symbol(), cell.fg, cell.bg), ("▀", Color::Rgb(250, 3, 3), Color::Rgb(0, 0, 240)));
        let cell = only(&column(RED, RED), Depth::True);
        assert_eq!((cell.symbol(), cell.bg), (" ", Color::Rgb(250, 3, 3)));
    }

    #[test]
    fn where_there_is_no_picture_the_terminal_stays_as_it_is() {
        assert_eq!(only(&column([0; 4], [0; 4]), Depth::True), Cell::new("x"));
        let cell = only(&column([9, 9, 9, 0], BLUE), Depth::True);
        assert_eq!((cell.symbol(), cell.fg, cell.bg), ("▄", Color::Rgb(0, 0, 240), Color::Reset));
        let cell = only(&column(RED, [0; 4]), Depth::True);
        assert_eq!((cell.symbol(), cell.fg, cell.bg), ("▀", Color::Rgb(250, 3, 3), Color::Reset));
    }

    #[test]
    fn colours_are_the_nearest_that_there_are() {
        let cell = only(&column(RED, BLUE), Depth::Sixteen);
        assert_eq!((cell.fg, cell.bg), (Color::LightRed, Color::Blue));
        let cell = only(&column([255, 135, 0, 255], [118, 119, 117, 255]), Depth::Indexed);
        assert_eq!((cell.fg, cell.bg), (Color::Indexed(208), Color::Indexed(243)));
        let shades =
            [0, 60, 130, 180, 255].map(|v| only(&column([v, v, v, 255], [v, v, v, 255]), Depth::Grey));
        assert_eq!(shades.each_ref().map(Cell::symbol), ["x", "░", "▒", "▓", "█"]);
        assert!(shades.iter().all(|cell| (cell.fg, cell.bg) == (Color::Reset, Color::Reset)));
    }

    #[test]
    fn what_does_not_fit_is_left_out() {
        let image = Image::filled([9, 9], RED);
        assert_eq!(Blocks::new(&image, Depth::True).size(), Size::new(9, 4));
        let buffer = drawn(&image, Depth::True, Rect::new(2, 1, 50, 50));
        let painted: Vec<bool> = buffer.content.iter().map(|cell| cell.symbol() == " ").collect();
        assert_eq!(painted, [false, false, false, false, false, false, true, true]);
        for size in [[0, 0], [1, 1], [0, 7], [7, 0]] {
            drawn(&Image::filled(size, RED), Depth::True, Rect::new(0, 0, 4, 2));
        }
    }
}

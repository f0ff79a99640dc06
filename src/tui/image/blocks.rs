//! Pictures of half blocks: a character of two colours shows two pixels, one above the other.
//!
//! Made here and not by a library, which would paint black where there is no picture. The colours are exact: a finished screen is
//! brought down to what the terminal has as a whole ([`lower`](crate::tui::lower)), pictures included.

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};
use ratatui::style::Color;
use ratatui::widgets::Widget;

use crate::canvas::image::Image;

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
    pub fn new(image: &Image) -> Self {
        let [width, height] = [image.size[0], image.size[1] / 2].map(|side| side.min(u16::MAX.into()));
        let cell = |i: u32| {
            let (x, y) = (i % width, 2 * (i / width));
            cell([image.at(x, y), image.at(x, y + 1)])
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
fn cell(pixels: [[u8; 4]; 2]) -> (char, Pair) {
    match pixels.map(|[r, g, b, a]| (a > 0).then_some(Color::Rgb(r, g, b))) {
        [None, None] => (' ', [None, None]),
        [Some(upper), None] => ('▀', [Some(upper), None]),
        [None, lower] => ('▄', [lower, None]),
        [upper, lower] if upper == lower => (' ', [None, lower]),
        both => ('▀', both),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(image: &Image, area: Rect) -> Buffer {
        let mut buffer = Buffer::filled(Rect::new(0, 0, 4, 2), Cell::new("x"));
        Blocks::new(image).render(area, &mut buffer);
        buffer
    }

    fn column(upper: [u8; 4], lower: [u8; 4]) -> Image {
        Image { size: [1, 2], texels: vec![upper, lower] }
    }

    fn only(image: &Image) -> Cell {
        drawn(image, Rect::new(0, 0, 1, 1))[(0, 0)].clone()
    }

    const RED: [u8; 4] = [250, 3, 3, 255];
    const BLUE: [u8; 4] = [0, 0, 240, 255];

    #[test]
    fn a_cell_shows_two_pixels() {
        let cell = only(&column(RED, BLUE));
        assert_eq!((cell.symbol(), cell.fg, cell.bg), ("▀", Color::Rgb(250, 3, 3), Color::Rgb(0, 0, 240)));
        let cell = only(&column(RED, RED));
        assert_eq!((cell.symbol(), cell.bg), (" ", Color::Rgb(250, 3, 3)));
    }

    #[test]
    fn where_there_is_no_picture_the_terminal_stays_as_it_is() {
        assert_eq!(only(&column([0; 4], [0; 4])), Cell::new("x"));
        let cell = only(&column([9, 9, 9, 0], BLUE));
        assert_eq!((cell.symbol(), cell.fg, cell.bg), ("▄", Color::Rgb(0, 0, 240), Color::Reset));
        let cell = only(&column(RED, [0; 4]));
        assert_eq!((cell.symbol(), cell.fg, cell.bg), ("▀", Color::Rgb(250, 3, 3), Color::Reset));
    }

    #[test]
    fn what_does_not_fit_is_left_out() {
        let image = Image::filled([9, 9], RED);
        assert_eq!(Blocks::new(&image).size(), Size::new(9, 4));
        let buffer = drawn(&image, Rect::new(2, 1, 50, 50));
        let painted: Vec<bool> = buffer.content.iter().map(|cell| cell.symbol() == " ").collect();
        assert_eq!(painted, [false, false, false, false, false, false, true, true]);
        for size in [[0, 0], [1, 1], [0, 7], [7, 0]] {
            drawn(&Image::filled(size, RED), Rect::new(0, 0, 4, 2));
        }
    }
}

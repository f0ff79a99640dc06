//! The characters that are drawn as shapes: blocks and lines must meet those of the next cell, which no font promises.

/// A cell is drawn this wide and this high, so that its eighths are whole numbers and its halves squares.
pub(super) const WIDTH: u32 = 8;
/// See [`WIDTH`].
pub(super) const HEIGHT: u32 = 16;

/// A part of a cell: left, top, width and height.
pub(super) type Part = [u32; 4];

/// The part of its cell that a block character fills.
pub(super) fn block(symbol: &str) -> Option<Part> {
    const LEFT: &str = "▏▎▍▌▋▊▉█";
    const LOWER: &str = "▁▂▃▄▅▆▇█";
    let c = single(symbol)?;
    let eighths = |blocks: &str| blocks.chars().position(|block| block == c).map(|i| i as u32 + 1);
    match c {
        '▀' => Some([0, 0, WIDTH, HEIGHT / 2]),
        '▐' => Some([WIDTH / 2, 0, WIDTH / 2, HEIGHT]),
        '▔' => Some([0, 0, WIDTH, HEIGHT / 8]),
        '▕' => Some([WIDTH - 1, 0, 1, HEIGHT]),
        _ => None,
    }
    .or_else(|| eighths(LEFT).map(|n| [0, 0, n, HEIGHT]))
    .or_else(|| eighths(LOWER).map(|n| [0, HEIGHT - 2 * n, WIDTH, 2 * n]))
}

/// The arms of a line: how it goes up, right, down and left from the middle (0 not, 1 light, 2 heavy), and whether it bends round.
#[derive(Clone, Copy)]
pub(super) struct Arms {
    pub(super) weights: [u8; 4],
    pub(super) round: bool,
}

#[rustfmt::skip]
const LINES: [(char, [u8; 4]); 30] = [
    ('─', [0, 1, 0, 1]), ('│', [1, 0, 1, 0]), ('┌', [0, 1, 1, 0]), ('┐', [0, 0, 1, 1]), ('└', [1, 1, 0, 0]),
    ('┘', [1, 0, 0, 1]), ('├', [1, 1, 1, 0]), ('┤', [1, 0, 1, 1]), ('┬', [0, 1, 1, 1]), ('┴', [1, 1, 0, 1]),
    ('┼', [1, 1, 1, 1]), ('━', [0, 2, 0, 2]), ('┃', [2, 0, 2, 0]), ('┏', [0, 2, 2, 0]), ('┓', [0, 0, 2, 2]),
    ('┗', [2, 2, 0, 0]), ('┛', [2, 0, 0, 2]), ('┣', [2, 2, 2, 0]), ('┫', [2, 0, 2, 2]), ('┳', [0, 2, 2, 2]),
    ('┻', [2, 2, 0, 2]), ('╋', [2, 2, 2, 2]), ('╴', [0, 0, 0, 1]), ('╵', [1, 0, 0, 0]), ('╶', [0, 1, 0, 0]),
    ('╷', [0, 0, 1, 0]), ('╸', [0, 0, 0, 2]), ('╹', [2, 0, 0, 0]), ('╺', [0, 2, 0, 0]), ('╻', [0, 0, 2, 0]),
];
const CORNERS: [(char, [u8; 4]); 4] =
    [('╭', [0, 1, 1, 0]), ('╮', [0, 0, 1, 1]), ('╰', [1, 1, 0, 0]), ('╯', [1, 0, 0, 1])];

/// The arms of a line character.
pub(super) fn arms(symbol: &str) -> Option<Arms> {
    let c = single(symbol)?;
    let find = |table: &[(char, [u8; 4])], round| {
        table.iter().find(|(line, _)| *line == c).map(|(_, weights)| Arms { weights: *weights, round })
    };
    find(&LINES, false).or_else(|| find(&CORNERS, true))
}

fn single(symbol: &str) -> Option<char> {
    let mut chars = symbol.chars();
    chars.next().filter(|_| chars.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_make_a_whole() {
        let area = |symbol: &str| block(symbol).map(|[_, _, w, h]| w * h);
        assert_eq!(area("█"), Some(WIDTH * HEIGHT));
        assert_eq!([area("▀"), area("▄"), area("▌"), area("▐")], [Some(WIDTH * HEIGHT / 2); 4]);
        assert_eq!(block("▄"), Some([0, 8, 8, 8]));
        assert_eq!(block("▃"), Some([0, 10, 8, 6]));
        assert_eq!(block("▎"), Some([0, 0, 2, 16]));
        assert_eq!([block("x"), block(""), block("██")], [None; 3]);
    }

    #[test]
    fn lines_meet_their_neighbours() {
        let weights = |symbol: &str| arms(symbol).expect(symbol).weights;
        // Of a box: each corner's arm runs towards the next one's.
        for [a, b, c, d] in
            [["┌", "┐", "└", "┘"], ["╭", "╮", "╰", "╯"], ["┏", "┓", "┗", "┛"]].map(|b| b.map(weights))
        {
            assert!(a[1] > 0 && a[1] == b[3] && c[1] == d[3] && a[2] == c[0] && b[2] == d[0] && d[0] > 0);
        }
        assert!(arms("║").is_none() && arms("a").is_none());
    }
}

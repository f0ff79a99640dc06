//! Where the names of points go: beside them, not over one another, not over points, and within the frame.

/// About how wide a character is, and how high a line.
const CHARACTER: f64 = 6.0;
const LINE: f64 = 12.0;
/// What a point takes.
const POINT: f64 = 5.5;

/// Left, top, right and bottom.
type Rect = [f64; 4];

/// A place for a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) x: f64,
    /// Of the line that it stands on.
    pub(super) y: f64,
    /// Which part of it is at x.
    pub(super) anchor: &'static str,
}

/// The places that are left.
pub(super) struct Labels {
    frame: Rect,
    points: Vec<[f64; 2]>,
    taken: Vec<Rect>,
}

impl Labels {
    pub(super) fn new(frame: Rect, points: Vec<[f64; 2]>) -> Self {
        Self { frame, points, taken: Vec::new() }
    }

    /// Takes the first place beside a point that is free.
    pub(super) fn place(&mut self, at: [f64; 2], text: &str) -> Option<Place> {
        let width = CHARACTER * text.chars().count() as f64;
        let found = candidates(at).into_iter().find_map(|place| {
            let rect = rectangle(place, width);
            self.is_free(rect, at).then_some((place, rect))
        })?;
        self.taken.push(found.1);
        Some(found.0)
    }

    fn is_free(&self, rect: Rect, own: [f64; 2]) -> bool {
        let [left, top, right, bottom] = self.frame;
        let inside = rect[0] >= left + 3.0 && rect[1] >= top && rect[2] <= right - 3.0 && rect[3] <= bottom;
        let others = self.points.iter().filter(|point| **point != own);
        let around = |[x, y]: &[f64; 2]| [x - POINT, y - POINT, x + POINT, y + POINT];
        inside
            && !self.taken.iter().any(|t| overlap(*t, rect))
            && !others.map(around).any(|p| overlap(p, rect))
    }
}

/// Right above the staircase first, where it leaves room.
fn candidates([x, y]: [f64; 2]) -> [Place; 8] {
    let place = |dx: f64, dy: f64, anchor| Place { x: x + dx, y: y + dy, anchor };
    [
        place(7.0, -6.0, "start"),
        place(-8.0, 13.0, "end"),
        place(0.0, 20.0, "middle"),
        place(-9.0, 4.0, "end"),
        place(9.0, 13.0, "start"),
        place(0.0, -10.0, "middle"),
        place(-7.0, -7.0, "end"),
        place(10.0, 4.0, "start"),
    ]
}

fn rectangle(place: Place, width: f64) -> Rect {
    let left = match place.anchor {
        "start" => place.x,
        "end" => place.x - width,
        _ => place.x - 0.5 * width,
    };
    [left, place.y - LINE + 2.0, left + width, place.y + 2.0]
}

fn overlap(a: Rect, b: Rect) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lie_within_the_frame_and_not_over_one_another() {
        let points: Vec<[f64; 2]> = (0..40).map(|i| [5.0 * f64::from(i), f64::from(i * 37 % 100)]).collect();
        let mut labels = Labels::new([0.0, 0.0, 200.0, 100.0], points.clone());
        let placed = points.iter().filter(|at| labels.place(**at, "name").is_some()).count();
        assert!((5..40).contains(&placed), "{placed}");
        for (i, a) in labels.taken.iter().enumerate() {
            assert!(a[0] >= 0.0 && a[2] <= 200.0);
            assert!(labels.taken[..i].iter().all(|b| !overlap(*a, *b)));
        }
    }
}

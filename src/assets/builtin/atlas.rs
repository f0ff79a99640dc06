//! Packs the rectangles of charts into the unit square, on shelves: the highest first, side by side until a shelf is full.
//!
//! All charts keep one scale. Between charts, and around them, [`GUTTER`] stays free: filtering and the padding of painted
//! texels must not reach a neighbour.

use glam::{DVec2, Vec2, dvec2};

/// Free space around a chart, as a share of the atlas: six texels at 1024².
pub(super) const GUTTER: f64 = 6.0 / 1024.0;

/// Where the charts lie in the atlas.
pub(super) struct Atlas {
    side: f64,
    corners: Vec<DVec2>,
}

impl Atlas {
    /// Packs rectangles of these sizes, any common unit.
    pub(super) fn pack(sizes: &[DVec2]) -> Self {
        let area: f64 = sizes.iter().map(|s| s.x * s.y).sum();
        let mut side = area.sqrt();
        loop {
            if let Some(corners) = shelves(sizes, side) {
                return Self { side, corners };
            }
            side *= 1.01;
        }
    }

    /// Texture coordinates of a point of a chart, given from the chart's lower left corner.
    pub(super) fn uv(&self, chart: usize, p: DVec2) -> Vec2 {
        ((self.corners[chart] + p) / self.side).as_vec2()
    }
}

/// Lower left corners in a square of this side; `None` if they do not fit.
fn shelves(sizes: &[DVec2], side: f64) -> Option<Vec<DVec2>> {
    let gutter = side * GUTTER;
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by(|&a, &b| sizes[b].y.total_cmp(&sizes[a].y));
    let mut corners = vec![DVec2::ZERO; sizes.len()];
    let (mut at, mut shelf_height) = (dvec2(gutter, gutter), 0.0_f64);
    for chart in order {
        if at.x + sizes[chart].x + gutter > side {
            at = dvec2(gutter, at.y + shelf_height + gutter);
            shelf_height = 0.0;
        }
        let end = at + sizes[chart] + gutter;
        if end.x > side || end.y > side {
            return None;
        }
        corners[chart] = at;
        at.x = end.x;
        shelf_height = shelf_height.max(sizes[chart].y);
    }
    Some(corners)
}

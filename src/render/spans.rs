//! Which texels a triangle covers: those whose centres lie within it, by the top-left rule, corners rounded to 1/256 of a texel.
//!
//! All is integer arithmetic in 1/256 of a texel, x to the right and y down from the map's top left corner, so neighbours that share
//! a side share no texel and leave none out. Row by row the three sides are solved for the columns: a side's half-plane
//! is A i + B ≥ 0 in column i, with 1 instead of 0 where the rule leaves the side's own points to the neighbour.
//!
//! **Bounds.** A face is left out if its texture coordinates are not finite, farther out than [`FARTHEST`] maps, where f32 no longer tells
//! texels apart, or span more than [`COPIES`] maps; and so is every face on a map larger than [`LARGEST_SIDE`]. So coordinates stay
//! below 2^16 texels, where f32 still holds 1/256, and products below 2^63.

use std::ops::Range;

use glam::Vec2;

/// Parts of a texel that corners are rounded to.
pub const PARTS: i64 = 256;

/// How many maps' widths a face may span, maps repeating.
pub const COPIES: i64 = 3;

/// How far out texture coordinates may be.
pub const FARTHEST: f32 = 4096.0;

/// The largest side of a map that is painted on, texels.
pub const LARGEST_SIDE: u32 = 16384;

/// Corners in 1/256 of a texel.
pub type Corners = [[i64; 2]; 3];

/// A rectangle of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Its least column and row.
    pub from: [u32; 2],
    /// One more than its last column and row.
    pub to: [u32; 2],
}

impl Window {
    /// A whole map.
    pub fn whole(size: [u32; 2]) -> Self {
        Self { from: [0; 2], to: size }
    }
}

/// Twice a triangle's area, positive if it runs clockwise as seen on the map.
#[inline]
pub fn doubled_area([a, b, c]: Corners) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The least and the greatest coordinates.
#[inline]
pub fn bounds([a, b, c]: Corners) -> [[i64; 2]; 2] {
    let least = |k: usize| a[k].min(b[k]).min(c[k]);
    let most = |k: usize| a[k].max(b[k]).max(c[k]);
    [[least(0), least(1)], [most(0), most(1)]]
}

/// The same triangle elsewhere.
#[inline]
pub fn shifted(corners: Corners, by: [i64; 2]) -> Corners {
    corners.map(|[x, y]| [x + by[0], y + by[1]])
}

/// A coordinate in texels as 1/256 of one, halves upwards.
#[inline]
pub fn round(texels: f64) -> i64 {
    let scaled = texels * PARTS as f64 + 0.5;
    // Truncated, and one less for what is negative and no integer; `floor` would be a call.
    let whole = scaled as i64;
    whole - i64::from(whole as f64 > scaled)
}

/// A face on the map: rounded, and moved by whole maps so that its least column and row lie on it. `None` if it has no area there, or
/// is out of bounds.
#[inline]
pub fn place(uv: [Vec2; 3], size: [u32; 2]) -> Option<Corners> {
    // A NaN is not within.
    let within = |c: f32| c.abs() <= FARTHEST;
    if !uv.iter().all(|c| within(c.x) && within(c.y)) || size.iter().any(|&side| side > LARGEST_SIDE) {
        return None;
    }
    let [w, h] = size.map(f64::from);
    let corners = uv.map(|c| [round(f64::from(c.x) * w), round((1.0 - f64::from(c.y)) * h)]);
    let [least, most] = bounds(corners);
    let maps = size.map(|side| i64::from(side) * PARTS);
    let fits = (0..2).all(|k| most[k] - least[k] <= COPIES * maps[k]);
    let by = [0, 1]
        .map(|k| if (0..maps[k]).contains(&least[k]) { 0 } else { -least[k].div_euclid(maps[k]) * maps[k] });
    (fits && doubled_area(corners) != 0).then(|| shifted(corners, by))
}

/// Moves a triangle by whole maps to each place where it may cover texels of the map, the one that lies farthest right and down first.
#[inline]
pub fn each_copy(corners: Corners, size: [u32; 2], mut each: impl FnMut(Corners)) {
    let maps = size.map(|side| i64::from(side) * PARTS);
    let [least, most] = bounds(corners);
    let on_map = |v: [i64; 2]| (0..maps[0]).contains(&v[0]) && (0..maps[1]).contains(&v[1]);
    if on_map(least) && on_map(most) {
        return each(corners);
    }
    for j in least[1].div_euclid(maps[1])..=most[1].div_euclid(maps[1]) {
        for i in least[0].div_euclid(maps[0])..=most[0].div_euclid(maps[0]) {
            each(shifted(corners, [-i * maps[0], -j * maps[1]]));
        }
    }
}

/// Tells each row of a window in which a triangle covers texels, and which columns those are.
#[inline]
pub fn spans(corners: Corners, window: Window, mut each: impl FnMut(u32, Range<u32>)) {
    let [a, b, c] = corners;
    let ordered = if doubled_area(corners) < 0 { [a, c, b] } else { corners };
    let sides = [0, 1, 2].map(|i| Side::new(ordered[i], ordered[(i + 1) % 3]));
    let [least, most] = bounds(corners);
    // Centres lie at half texels.
    let first = |k: usize| (least[k] + PARTS / 2 - 1).div_euclid(PARTS).max(window.from[k].into());
    let end = |k: usize| ((most[k] + PARTS / 2).div_euclid(PARTS)).min(window.to[k].into());
    let columns = [first(0), end(0)];
    for row in first(1)..end(1) {
        let [from, to] = sides.iter().fold(columns, |columns, side| side.clip(row, columns));
        if from < to {
            each(row as u32, from as u32..to as u32);
        }
    }
}

/// A half-plane: texel (i, j) lies within if a i + b j + c ≥ 0.
struct Side {
    a: i64,
    b: i64,
    c: i64,
}

impl Side {
    #[inline]
    fn new(from: [i64; 2], to: [i64; 2]) -> Self {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let half = PARTS / 2;
        let at_first = dx * (half - from[1]) - dy * (half - from[0]);
        // The inside lies to the right of a left side, and below a top one: they own their points.
        let owns = dy < 0 || (dy == 0 && dx > 0);
        Self { a: -dy * PARTS, b: dx * PARTS, c: at_first - i64::from(!owns) }
    }

    /// What is left of a range of columns.
    #[inline]
    fn clip(&self, row: i64, [from, to]: [i64; 2]) -> [i64; 2] {
        let rest = self.b * row + self.c;
        let holds = |column: i64| self.a * column + rest >= 0;
        // Most sides cut nothing off a small face's row, and need no division.
        match self.a {
            0.. if holds(from) => [from, to],
            ..0 if holds(to - 1) => [from, to],
            // The least i with a i ≥ −rest.
            1.. => [from.max(-rest.div_euclid(self.a)), to],
            0 => [from, from],
            // The greatest with −a i ≤ rest.
            _ => [from, to.min(rest.div_euclid(-self.a) + 1)],
        }
    }
}

#[cfg(test)]
mod tests;

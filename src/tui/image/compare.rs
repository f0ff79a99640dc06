//! Two pictures in one: left of a line the first, right of it the second.
//!
//! Meant for what is already cut to the pane, so that the line is as thin as can be shown, and stays under the pointer that drags it.

use crate::canvas::image::Image;

/// One picture left of a line at a share of the width, another right of it. What one of them does not have, being smaller, is empty.
pub fn slider(left: &Image, right: &Image, share: f64) -> Image {
    let size = [0, 1].map(|k| left.size[k].max(right.size[k]));
    let share = if share.is_nan() { 0.5 } else { share.clamp(0.0, 1.0) };
    let line = ((f64::from(size[0]) * share) as u32).min(size[0].saturating_sub(1));
    let texel = |x: u32, y: u32| match x {
        x if x < line => get(left, x, y),
        x if x == line => contrast(get(right, x, y)),
        _ => get(right, x, y),
    };
    Image { size, texels: (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| texel(x, y))).collect() }
}

fn get(image: &Image, x: u32, y: u32) -> [u8; 4] {
    if x < image.size[0] && y < image.size[1] { image.at(x, y) } else { [0; 4] }
}

/// Black on what is light, and white on what is dark.
fn contrast([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let light = a > 0 && 2 * u32::from(r) + 5 * u32::from(g) + u32::from(b) > 8 * 127;
    if light { [0, 0, 0, 255] } else { [255; 4] }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: [u8; 4] = [200, 0, 0, 255];
    const PALE: [u8; 4] = [220, 230, 240, 255];

    fn row(share: f64) -> Vec<[u8; 4]> {
        slider(&Image::filled([5, 1], RED), &Image::filled([5, 1], PALE), share).texels
    }

    #[test]
    fn the_line_is_where_the_share_is() {
        let black = [0, 0, 0, 255];
        assert_eq!(row(0.5), [RED, RED, black, PALE, PALE]);
        assert_eq!(row(0.0), [black, PALE, PALE, PALE, PALE]);
        for right in [1.0, 7.0] {
            assert_eq!(row(right), [RED, RED, RED, RED, black]);
        }
        assert_eq!(row(f64::NAN), row(0.5));
    }

    #[test]
    fn the_line_is_seen_on_the_dark_and_sizes_may_differ() {
        let image = slider(&Image::filled([2, 3], PALE), &Image::filled([4, 1], RED), 0.5);
        assert_eq!(image.size, [4, 3]);
        assert_eq!(image.texels[..4], [PALE, PALE, [255; 4], RED]);
        assert_eq!(image.texels[4..8], [PALE, PALE, [255; 4], [0; 4]]);
        assert!(slider(&Image::default(), &Image::default(), 0.3).texels.is_empty());
    }
}

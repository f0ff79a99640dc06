//! Pan and zoom: what part of a picture a pane shows, and the ways between their pixels.
//!
//! At zoom 1 the whole picture fits into the pane, in its own shape, centred. Zoomed in, the picture never leaves a gap that it could fill. A [`Fit`] is
//! one scale and one shift, so the way back is the way there, turned round: what is under the pointer is what is clicked.
//!
//! Magnified, a pixel is a square: whoever zooms in wants to see pixels. Reduced, a pixel is the mean over its box, by area, of the values as they
//! are: nothing glimmers when it moves, and the difference to a mean of light is not seen at a few times.

use crate::canvas::image::Image;

/// The most that is magnified, over the whole picture in the pane.
pub const MOST: f64 = 64.0;

/// A part of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// What is in the pane's middle, in shares of the picture's width and height.
    pub centre: [f64; 2],
    /// How much larger than in full, 1 at least.
    pub zoom: f64,
}

impl Default for Window {
    fn default() -> Self {
        Self { centre: [0.5; 2], zoom: 1.0 }
    }
}

impl Window {
    /// Where a picture lies in a pane, both in their own pixels.
    pub fn fit(&self, picture: [u32; 2], pane: [u32; 2]) -> Fit {
        let (picture, pane) = (picture.map(|side| side.max(1)), pane.map(|side| side.max(1)));
        let whole = [0, 1].map(|k| f64::from(pane[k]) / f64::from(picture[k]));
        let scale = whole[0].min(whole[1]) * within(self.zoom, 1.0, MOST);
        let origin = [0, 1].map(|k| {
            let (side, room) = (f64::from(picture[k]) * scale, f64::from(pane[k]));
            let most = (side - room).max(0.0) / 2.0;
            (room - side) / 2.0 - within((self.centre[k] - 0.5) * side, -most, most)
        });
        Fit { picture, pane, scale, origin }
    }

    /// Zooms, and keeps in place what is at a point of the pane.
    pub fn zoom_at(&mut self, [x, y]: [f64; 2], factor: f64, picture: [u32; 2], pane: [u32; 2]) {
        let fit = self.fit(picture, pane);
        let kept = fit.back([x, y]);
        let zoom = within(self.zoom * factor, 1.0, MOST);
        let scale = fit.scale * (zoom / within(self.zoom, 1.0, MOST));
        let centre = [0, 1].map(|k| {
            let aside = ([x, y][k] - f64::from(fit.pane[k]) / 2.0) / scale;
            (kept[k] - aside) / f64::from(fit.picture[k])
        });
        *self = Self { centre, zoom }.held(picture, pane);
    }

    /// Moves the picture by some of the pane's pixels.
    pub fn pan(&mut self, by: [f64; 2], picture: [u32; 2], pane: [u32; 2]) {
        let fit = self.fit(picture, pane);
        let centre = [0, 1].map(|k| self.centre[k] - by[k] / (fit.scale * f64::from(fit.picture[k])));
        *self = Self { centre, ..*self }.held(picture, pane);
    }

    /// The same window as it is shown, so that no gap is stored up to be walked back through.
    fn held(&self, picture: [u32; 2], pane: [u32; 2]) -> Self {
        let fit = self.fit(picture, pane);
        let middle = fit.back(fit.pane.map(|side| f64::from(side) / 2.0));
        let centre = [0, 1].map(|k| middle[k] / f64::from(fit.picture[k]));
        Self { centre, zoom: within(self.zoom, 1.0, MOST) }
    }
}

/// A number between bounds; one that is none counts as the least in size.
fn within(value: f64, least: f64, most: f64) -> f64 {
    if value.is_nan() { 0.0_f64.clamp(least, most) } else { value.clamp(least, most) }
}

/// Where a picture lies in a pane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    picture: [u32; 2],
    pane: [u32; 2],
    scale: f64,
    origin: [f64; 2],
}

impl Fit {
    /// Where in the picture a point of the pane lies, in the picture's pixels. None beside it, and beside the pane.
    pub fn to_picture(&self, point: [f64; 2]) -> Option<[f64; 2]> {
        let at = self.back(point);
        let inside =
            |at: [f64; 2], size: [u32; 2]| (0..2).all(|k| (0.0..f64::from(size[k])).contains(&at[k]));
        (inside(point, self.pane) && inside(at, self.picture)).then_some(at)
    }

    /// The same as shares of the picture's width and height: what is there in a view of the same shape and any size.
    pub fn to_share(&self, point: [f64; 2]) -> Option<[f64; 2]> {
        let [x, y] = self.to_picture(point)?;
        Some([x / f64::from(self.picture[0]), y / f64::from(self.picture[1])])
    }

    /// Where in the pane a point of the picture lies. None if it is not shown.
    pub fn to_pane(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let at = [x * self.scale + self.origin[0], y * self.scale + self.origin[1]];
        (0..2).all(|k| (0.0..f64::from(self.pane[k])).contains(&at[k])).then_some(at)
    }

    /// Where in the pane something lies that is at shares of the picture's width and height. None if it is not shown.
    pub fn share_to_pane(&self, share: [f64; 2]) -> Option<[f64; 2]> {
        self.to_pane([0, 1].map(|k| share[k] * f64::from(self.picture[k])))
    }

    /// What so many of the pane's pixels are, across and down, in shares of the picture's width and height.
    pub fn shares(&self, pixels: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| pixels[k] / (self.scale * f64::from(self.picture[k])))
    }

    /// Pixels of the picture that are shown as one, in both directions; 1 where it is magnified.
    pub fn reduction(&self) -> u32 {
        (1.0 / self.scale).round().max(1.0) as u32
    }

    fn back(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.origin[0]) / self.scale, (y - self.origin[1]) / self.scale]
    }

    /// The picture as it is in the pane. Beside it nothing, with an alpha of 0; on it an alpha of 255, whatever the picture's meant.
    pub fn crop(&self, image: &Image) -> Image {
        if image.size != self.picture {
            return Image::filled(self.pane, [0; 4]);
        }
        let [columns, rows] = [0, 1].map(|axis| self.axis(axis));
        let texels = rows.iter().flat_map(|row| columns.iter().map(|column| mean(image, column, row)));
        Image { size: self.pane, texels: texels.collect() }
    }

    /// For each of the pane's columns or rows the picture's that it shows, and how much of each.
    fn axis(&self, axis: usize) -> Vec<Shown> {
        let side = self.picture[axis];
        let back = |at: f64| (at - self.origin[axis]) / self.scale;
        let shown = |i: u32| match back(f64::from(i) + 0.5) {
            middle if !(0.0..f64::from(side)).contains(&middle) => Shown { first: 0, shares: Vec::new() },
            middle if self.scale >= 1.0 => Shown { first: middle as u32, shares: vec![1.0] },
            _ => Shown::between(back(f64::from(i)), back(f64::from(i) + 1.0), side),
        };
        (0..self.pane[axis]).map(shown).collect()
    }
}

/// Neighbouring columns or rows of a picture, and their shares of a pixel.
struct Shown {
    first: u32,
    shares: Vec<f32>,
}

impl Shown {
    fn between(from: f64, to: f64, side: u32) -> Self {
        let (from, to) = (from.max(0.0), to.min(f64::from(side)));
        let (first, end) = (from as u32, (to.ceil() as u32).min(side));
        let share = |i: u32| (to.min(f64::from(i) + 1.0) - from.max(f64::from(i))).max(0.0) as f32;
        Self { first, shares: (first..end).map(share).collect() }
    }
}

/// The mean over a box.
fn mean(image: &Image, columns: &Shown, rows: &Shown) -> [u8; 4] {
    let (mut sum, mut all) = ([0.0_f32; 3], 0.0_f32);
    for (y, row) in (rows.first..).zip(&rows.shares) {
        for (x, column) in (columns.first..).zip(&columns.shares) {
            let (texel, share) = (image.at(x, y), row * column);
            all += share;
            (0..3).for_each(|k| sum[k] += share * f32::from(texel[k]));
        }
    }
    if all == 0.0 {
        return [0; 4];
    }
    let [r, g, b] = sum.map(|value| (value / all).round() as u8);
    [r, g, b, 255]
}

/// The part of a picture that a window shows, as it is in a pane of this size.
pub fn crop(image: &Image, window: &Window, pane: [u32; 2]) -> Image {
    window.fit(image.size, pane).crop(image)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: [[u32; 2]; 5] = [[640, 360], [1, 1], [13, 97], [333, 7], [128, 128]];

    fn windows() -> Vec<Window> {
        let places = [[0.5, 0.5], [0.0, 1.0], [0.31, 0.77], [-3.0, f64::NAN]];
        let zooms = [1.0, 1.7, 9.3, 64.0, f64::NAN, 1e9];
        places.iter().flat_map(|centre| zooms.map(|zoom| Window { centre: *centre, zoom })).collect()
    }

    fn each_fit(mut each: impl FnMut(Fit)) {
        for (picture, pane) in SIZES.iter().flat_map(|p| SIZES.map(|q| (*p, q))) {
            windows().iter().for_each(|window| each(window.fit(picture, pane)));
        }
    }

    /// A picture whose every pixel tells where it is.
    fn ramp(size: [u32; 2]) -> Image {
        let texel = |i: u32| [(i % size[0]) as u8, (i / size[0]) as u8, 7, 3];
        Image { size, texels: (0..size[0] * size[1]).map(texel).collect() }
    }

    #[test]
    fn the_way_back_is_the_way_there() {
        each_fit(|fit| {
            let mut there = 0;
            for (x, y) in (0..21).flat_map(|x| (0..21).map(move |y| (x, y))) {
                let point =
                    [(0, x), (1, y)].map(|(k, at)| f64::from(fit.pane[k]) * (f64::from(at) + 0.5) / 21.0);
                let Some(at) = fit.to_picture(point) else { continue };
                there += 1;
                let back = fit.to_pane(at).expect("what lies in the pane");
                assert!((0..2).all(|k| (back[k] - point[k]).abs() < 1e-9), "{fit:?} {point:?} {back:?}");
                let share = fit.to_share(point).expect("the same");
                assert!((0..2).all(|k| (share[k] * f64::from(fit.picture[k]) - at[k]).abs() < 1e-9));
            }
            assert!(there > 0, "{fit:?}");
        });
    }

    #[test]
    fn the_whole_picture_is_seen_at_zoom_1_and_no_gap_that_could_be_filled() {
        let fit = Window::default().fit([640, 360], [100, 100]);
        assert_eq!(fit.to_pane([0.0, 0.0]), Some([0.0, 21.875]));
        assert_eq!(fit.to_picture([50.0, 50.0]), Some([320.0, 180.0]));
        assert_eq!(fit.to_picture([50.0, 21.0]), None);
        assert_eq!(fit.to_picture([-0.5, 50.0]), None);
        each_fit(|fit| {
            for k in 0..2 {
                let (side, room) = (f64::from(fit.picture[k]) * fit.scale, f64::from(fit.pane[k]));
                let (before, after) = (fit.origin[k], room - fit.origin[k] - side);
                let gaps = if side >= room { [0.0; 2] } else { [(room - side) / 2.0; 2] };
                assert!(before <= gaps[0] + 1e-6 && after <= gaps[1] + 1e-6, "{fit:?}");
            }
        });
    }

    #[test]
    fn zooming_keeps_what_is_under_the_pointer() {
        let (picture, pane) = ([640, 360], [101, 57]);
        let mut window = Window::default();
        for (point, factor) in
            [([30.0, 20.0], 2.0), ([80.0, 41.0], 3.0), ([55.0, 30.0], 0.5), ([1.0, 1.0], 7.0)]
        {
            let before = window.fit(picture, pane).to_picture(point).expect("on the picture");
            window.zoom_at(point, factor, picture, pane);
            let after = window.fit(picture, pane).to_picture(point).expect("still on it");
            assert!((0..2).all(|k| (before[k] - after[k]).abs() < 1e-6), "{before:?} {after:?}");
        }
        for factor in [1e-9, f64::NAN] {
            window.zoom_at([0.0, 0.0], factor, picture, pane);
            assert_eq!(window, Window::default());
        }
        window.zoom_at([0.0, 0.0], 1e300, picture, pane);
        assert_eq!(window.zoom, MOST);
    }

    #[test]
    fn panning_ends_at_the_border_and_comes_back_at_once() {
        let (picture, pane) = ([640, 360], [64, 36]);
        let mut window = Window { zoom: 2.0, ..Window::default() };
        window.pan([1e6, 0.0], picture, pane);
        assert_eq!(window.fit(picture, pane).to_picture([0.0, 0.0]), Some([0.0, 90.0]));
        window.pan([-3.0, 0.0], picture, pane);
        let left = window.fit(picture, pane).to_picture([0.0, 0.0]).expect("on the picture");
        assert!((left[0] - 15.0).abs() < 1e-9, "{left:?}");
        let mut whole = Window::default();
        whole.pan([5.0, 5.0], picture, pane);
        assert_eq!(whole, Window::default());
    }

    #[test]
    fn a_magnified_pixel_is_a_square() {
        let image = ramp([5, 3]);
        let crop = crop(&image, &Window::default(), [20, 12]);
        for (x, y) in (0..20).flat_map(|x| (0..12).map(move |y| (x, y))) {
            assert_eq!(crop.at(x, y), [(x / 4) as u8, (y / 4) as u8, 7, 255]);
        }
    }

    #[test]
    fn a_reduced_pixel_is_the_mean_of_its_box() {
        let bands = |x: u32| if x.is_multiple_of(3) { [90, 0, 255, 9] } else { [0, 30, 255, 0] };
        let image = Image { size: [12, 6], texels: (0..72).map(|i| bands(i % 12)).collect() };
        assert_eq!(crop(&image, &Window::default(), [4, 2]).texels, [[30, 20, 255, 255]; 8]);
        // 2.5 of the picture's for one: half of a pixel counts half.
        let wide = Image { size: [5, 1], texels: [10, 10, 60, 10, 10].map(|v| [v, v, v, 255]).to_vec() };
        let halves = crop(&wide, &Window::default(), [2, 1]);
        assert_eq!(halves.texels, [[20, 20, 20, 255]; 2]);
    }

    #[test]
    fn beside_the_picture_there_is_nothing() {
        let crop = crop(&ramp([8, 4]), &Window::default(), [8, 8]);
        let shown: Vec<bool> = (0..8).map(|y| (0..8).all(|x| crop.at(x, y)[3] == 255)).collect();
        assert_eq!(shown, [false, false, true, true, true, true, false, false]);
        assert_eq!(crop.at(3, 1), [0; 4]);
    }

    #[test]
    fn no_size_is_too_small_and_what_is_cropped_is_what_is_clicked() {
        let nothing = Image::filled([0, 0], [0; 4]);
        assert_eq!(crop(&nothing, &Window::default(), [3, 2]), Image::filled([3, 2], [0; 4]));
        for (size, pane) in SIZES.iter().flat_map(|p| SIZES.map(|q| (*p, q))) {
            for window in windows() {
                assert_eq!(crop(&ramp(size), &window, pane).size, pane);
            }
        }
        let (image, window, pane) = (ramp([97, 53]), Window { centre: [0.3, 0.6], zoom: 5.0 }, [61, 44]);
        let (fit, crop) = (window.fit(image.size, pane), crop(&image, &window, pane));
        for (x, y) in (0..61).flat_map(|x| (0..44).map(move |y| (x, y))) {
            let at = fit.to_picture([f64::from(x) + 0.5, f64::from(y) + 0.5]);
            let [i, j] = at.expect("it fills the pane").map(|v| v as u32);
            assert_eq!(crop.at(x, y)[..3], image.at(i, j)[..3]);
        }
    }

    #[test]
    fn a_reduction_is_told() {
        let reduction = |zoom| Window { zoom, ..Window::default() }.fit([300, 180], [100, 60]).reduction();
        assert_eq!([1.0, 2.0, 3.0, 9.0].map(reduction), [3, 2, 1, 1]);
    }
}

//! A golden picture: a PNG beside its checkpoint's text.
//!
//! The text holds the digest of the pixels, so a picture that was damaged, or put there by anything but a blessing, is told apart from one that a
//! renderer no longer gives. The repository keeps every picture for ever: above [`BYTES_CAP`] none is blessed.

use crate::assets::{read_png, write_png};
use crate::canvas::image::Image;

/// Bytes of a picture's file, at most.
const BYTES_CAP: usize = 512 << 10;

/// A golden picture.
pub(super) struct Picture {
    /// Its file.
    pub(super) png: Vec<u8>,
    pub(super) image: Image,
}

impl Picture {
    /// The file of a picture. An error says why it cannot be a golden.
    pub(super) fn file(image: &Image) -> Result<Vec<u8>, String> {
        let png = write_png(image).map_err(|fault| fault.to_string())?;
        if png.len() > BYTES_CAP {
            return Err(format!("it would take {} bytes, and a golden takes {BYTES_CAP} at most", png.len()));
        }
        Ok(png)
    }

    /// Reads the golden of a frame. `digest` is what the text beside it says of it. An error says what is wrong with it.
    pub(super) fn read(png: Vec<u8>, digest: Option<&str>, frame: &Image) -> Result<Self, String> {
        let image = read_png(&png).map_err(|fault| format!("damaged: {fault}"))?;
        if digest.is_some_and(|digest| digest != image.digest()) {
            return Err("damaged: it is not the picture that the text beside it tells of".into());
        }
        if image.size != frame.size {
            let ([w, h], [fw, fh]) = (image.size, frame.size);
            return Err(format!("mis-sized: it is {w} x {h}, and the frame {fw} x {fh}"));
        }
        Ok(Self { png, image })
    }
}

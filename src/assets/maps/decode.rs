//! Image files as maps: PNG, JPEG and DDS, told apart by their first bytes, whatever the file is called.
//!
//! Grey becomes RGB, what has no alpha is opaque, and 16 bits a channel are rounded to 8. Of a DDS the largest level of its one picture is read.
//! Sizes are looked at before anything is allocated: at most [`LARGEST_SIDE`] along a side and [`MOST_BYTES`] in memory, and no more than
//! the size of the file can account for.

use std::io::Cursor;

use image::{DynamicImage, ImageDecoder as _, ImageFormat, ImageReader, Limits};
use image_dds::SurfaceRgba8;
use image_dds::ddsfile::Dds;

use crate::assets::error::{Fault, FaultKind};
use crate::canvas::image::Image;

/// What every GPU of today can hold.
const LARGEST_SIDE: u32 = 16384;
/// While an image is decoded, and as RGBA with 8 bits a channel.
const MOST_BYTES: u64 = 1 << 30;
/// No format packs a picture tighter: Deflate gets to 1032 : 1, and a texel of one bit becomes 32.
const TIGHTEST: u64 = 1032 * 32;
/// Where the texels of a DDS begin, at the latest.
const DDS_HEADER: usize = 4 + 124 + 20;

#[derive(Clone, Copy)]
enum Format {
    Common(ImageFormat),
    Dds,
}

impl Format {
    fn of(bytes: &[u8]) -> Result<Self, Fault> {
        match bytes {
            [0x89, b'P', b'N', b'G', ..] => Ok(Self::Common(ImageFormat::Png)),
            [0xff, 0xd8, 0xff, ..] => Ok(Self::Common(ImageFormat::Jpeg)),
            [b'D', b'D', b'S', b' ', ..] => Ok(Self::Dds),
            _ => Err(Fault::whole(FaultKind::Unsupported, "is no PNG, JPEG or DDS image")),
        }
    }
}

/// Width and height, from the header alone.
pub(super) fn size(bytes: &[u8]) -> Result<[u32; 2], Fault> {
    let size = match Format::of(bytes)? {
        Format::Common(format) => {
            let (width, height) = reader(bytes, format).into_dimensions().map_err(broken)?;
            [width, height]
        }
        Format::Dds => {
            let dds = read_dds(&bytes[..bytes.len().min(DDS_HEADER)])?;
            [dds.get_width(), dds.get_height()]
        }
    };
    check(size, bytes.len())?;
    Ok(size)
}

/// A JPEG decoder fills up what is missing, without a word: after the beginning of the last scan there has to be the end of the image.
fn require_whole(bytes: &[u8]) -> Result<(), Fault> {
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    match Format::of(bytes)? {
        Format::Common(ImageFormat::Jpeg) if last([0xff, 0xd9]) <= last([0xff, 0xda]) => {
            Err(Fault::whole(FaultKind::Truncated, "the end of the image is missing"))
        }
        _ => Ok(()),
    }
}

/// The whole image.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, Fault> {
    size(bytes)?;
    require_whole(bytes)?;
    let image = match Format::of(bytes)? {
        Format::Common(format) => {
            let decoder = reader(bytes, format).into_decoder().map_err(broken)?;
            // 16 bits a channel need twice as much.
            if decoder.total_bytes() > MOST_BYTES {
                return Err(too_large(decoder.dimensions().into()));
            }
            DynamicImage::from_decoder(decoder).map_err(broken)?.into_rgba8()
        }
        Format::Dds => decode_dds(bytes)?,
    };
    let size = image.dimensions().into();
    let (texels, _) = image.as_raw().as_chunks();
    Ok(Image { size, texels: texels.to_vec() })
}

fn reader(bytes: &[u8], format: ImageFormat) -> ImageReader<Cursor<&[u8]>> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_image_width = Some(LARGEST_SIDE);
    limits.max_image_height = Some(LARGEST_SIDE);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    reader
}

fn check(size: [u32; 2], length: usize) -> Result<(), Fault> {
    let [width, height] = size.map(u64::from);
    let bytes = width * height * 4;
    if bytes == 0 {
        return Err(Fault::whole(FaultKind::Empty, "has no texel"));
    }
    if size.iter().any(|&side| side > LARGEST_SIDE) || bytes > MOST_BYTES {
        return Err(too_large(size));
    }
    if bytes > TIGHTEST * length as u64 {
        let detail = format!("{width} x {height} texels do not fit into {length} bytes");
        return Err(Fault::whole(FaultKind::Truncated, detail));
    }
    Ok(())
}

fn too_large([width, height]: [u32; 2]) -> Fault {
    let detail = format!("{width} x {height} texels: at most {LARGEST_SIDE} along a side, and 1 GiB");
    Fault::whole(FaultKind::TooLarge, detail)
}

fn broken(error: image::ImageError) -> Fault {
    let kind = match &error {
        image::ImageError::Unsupported(_) => FaultKind::Unsupported,
        image::ImageError::Limits(_) => FaultKind::TooLarge,
        image::ImageError::IoError(_) => FaultKind::Truncated,
        _ => FaultKind::Syntax,
    };
    Fault::whole(kind, error.to_string())
}

fn read_dds(bytes: &[u8]) -> Result<Dds, Fault> {
    Dds::read(bytes).map_err(|error| Fault::whole(FaultKind::Syntax, error.to_string()))
}

fn decode_dds(bytes: &[u8]) -> Result<image::RgbaImage, Fault> {
    let dds = read_dds(bytes)?;
    if dds.get_depth() > 1 || dds.get_num_array_layers() > 1 {
        return Err(Fault::whole(FaultKind::Unsupported, "is a volume or an array of pictures, not one"));
    }
    SurfaceRgba8::decode_layers_mipmaps_dds(&dds, 0..1, 0..1)
        .map_err(|error| Fault::whole(FaultKind::Syntax, error.to_string()))?
        .into_image()
        .map_err(|error| Fault::whole(FaultKind::Syntax, error.to_string()))
}

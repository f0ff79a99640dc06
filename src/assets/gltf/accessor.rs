//! The numbers behind an accessor, every step of the way checked against the bytes that are there.

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

use crate::assets::error::{Fault, FaultKind};

/// Rows of `N` floats: f32, or normalized u8 and u16 where glTF allows that.
pub(super) fn reals<const N: usize>(
    accessor: &Accessor<'_>,
    buffers: &[Vec<u8>],
) -> Result<Vec<[f32; N]>, Fault> {
    let dimensions = match N {
        2 => Dimensions::Vec2,
        _ => Dimensions::Vec3,
    };
    require(accessor, accessor.dimensions() == dimensions, "has the wrong number of components")?;
    let read: fn(&[u8]) -> f32 = match (accessor.data_type(), accessor.normalized()) {
        (DataType::F32, _) => |b| f32::from_bits(little(b)),
        (DataType::U8, true) => |b| little(b) as f32 / 255.0,
        (DataType::U16, true) => |b| little(b) as f32 / 65535.0,
        _ => return Err(fault(accessor, FaultKind::Unsupported, "is neither f32 nor normalized")),
    };
    let size = accessor.data_type().size();
    let row = |bytes: &[u8]| {
        let mut parts = bytes.chunks_exact(size).map(read);
        [(); N].map(|()| parts.next().unwrap_or_default())
    };
    Ok(rows(accessor, buffers, size * N)?.map(row).collect())
}

/// Whole numbers: u8, u16 or u32.
pub(super) fn indices(accessor: &Accessor<'_>, buffers: &[Vec<u8>]) -> Result<Vec<u32>, Fault> {
    let whole = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
    require(accessor, whole && accessor.dimensions() == Dimensions::Scalar, "does not hold indices")?;
    Ok(rows(accessor, buffers, accessor.data_type().size())?.map(little).collect())
}

/// The bytes of each row.
fn rows<'a>(
    accessor: &Accessor<'_>,
    buffers: &'a [Vec<u8>],
    width: usize,
) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, Fault> {
    if accessor.sparse().is_some() {
        return Err(fault(accessor, FaultKind::Unsupported, "is sparse"));
    }
    let Some(view) = accessor.view() else {
        return Err(fault(accessor, FaultKind::Unsupported, "has no buffer view"));
    };
    let stride = view.stride().unwrap_or(width);
    require(accessor, stride >= width, "has rows that overlap")?;
    let bytes = buffers.get(view.buffer().index()).map_or(&[][..], Vec::as_slice);
    let view_end = view.offset().checked_add(view.length());
    let view_bytes = view_end.and_then(|end| bytes.get(view.offset()..end));
    // The last row need not be padded to the stride.
    let before_last = accessor.count().saturating_sub(1).checked_mul(stride);
    let length = if accessor.count() == 0 { Some(0) } else { before_last.and_then(|n| n.checked_add(width)) };
    let end = length.and_then(|n| n.checked_add(accessor.offset()));
    let own = view_bytes.zip(end).and_then(|(bytes, end)| bytes.get(accessor.offset()..end));
    let own = own.ok_or_else(|| fault(accessor, FaultKind::Truncated, "reaches beyond its buffer"))?;
    Ok(own.chunks(stride).map(move |row| &row[..width]))
}

fn little(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |n, &b| n << 8 | u32::from(b))
}

fn require(accessor: &Accessor<'_>, holds: bool, what: &str) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(fault(accessor, FaultKind::Syntax, what)) }
}

fn fault(accessor: &Accessor<'_>, kind: FaultKind, what: &str) -> Fault {
    Fault::whole(kind, format!("accessor {} {what}", accessor.index()))
}

//! Where the bytes of a glTF are.

use std::path::PathBuf;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf::buffer::Source;

use crate::assets::error::{Fault, FaultKind};
use crate::report::quoted;

/// A buffer: its bytes, or the file that has them, relative to the document.
#[derive(Debug)]
pub(in crate::assets) enum Uri {
    Data(Vec<u8>),
    File(PathBuf),
}

/// The buffers of a document, by index.
pub(in crate::assets) fn buffer_uris(bytes: &[u8]) -> Result<Vec<Uri>, Fault> {
    let gltf::Gltf { document, mut blob } = super::parse(bytes)?;
    let locate = |buffer: gltf::Buffer<'_>| match buffer.source() {
        Source::Bin => {
            let none = || Fault::whole(FaultKind::Truncated, "the file has no binary chunk");
            blob.take().map(Uri::Data).ok_or_else(none)
        }
        Source::Uri(uri) => from_uri(uri),
    };
    document.buffers().map(locate).collect()
}

fn from_uri(uri: &str) -> Result<Uri, Fault> {
    if let Some(rest) = uri.strip_prefix("data:") {
        let invalid = || Fault::whole(FaultKind::Syntax, "a data URI is not in base64");
        let (_, encoded) = rest.split_once(";base64,").ok_or_else(invalid)?;
        return STANDARD.decode(encoded).map(Uri::Data).map_err(|_| invalid());
    }
    if uri.contains("://") {
        let detail = format!("the buffer {} is not a file; nothing is fetched", quoted(uri));
        return Err(Fault::whole(FaultKind::Unsupported, detail));
    }
    let name = String::from_utf8(percent_decoded(uri));
    name.map(|n| Uri::File(n.into()))
        .map_err(|_| Fault::whole(FaultKind::Syntax, format!("{} is not text", quoted(uri))))
}

/// `%20` and the like as bytes; a `%` that starts nothing stays.
fn percent_decoded(uri: &str) -> Vec<u8> {
    let (mut bytes, mut out) = (uri.as_bytes(), Vec::new());
    while let Some((&first, rest)) = bytes.split_first() {
        let code = rest.get(..2).filter(|c| first == b'%' && c.iter().all(u8::is_ascii_hexdigit));
        let value = code.and_then(|c| u8::from_str_radix(std::str::from_utf8(c).ok()?, 16).ok());
        out.push(value.unwrap_or(first));
        bytes = if value.is_some() { &rest[2..] } else { rest };
    }
    out
}

//! A report as one page that needs nothing else: no network, no file beside it.
//!
//! The page is `page.html`, with the report and its details as JSON in a script tag. Its script builds everything from that data, as text and never as markup, so that no
//! name or message can become part of the page; in the JSON every `<` is written `\u003c`, so that none can end the tag. Differences between
//! pictures are computed when they are looked at. A picture that equals its golden is there once.

use serde::Serialize;

use super::blob::Blob;
use super::detail::Detail;
use super::report::{RecordingReport, VerifyReport};
use super::skips::Skips;

const PAGE: &str = include_str!("page.html");
/// Where the data goes.
const SLOT: &str = "{{data}}";
const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// What the page is told, so that it has nothing to work out.
#[derive(Serialize)]
struct Page<'a> {
    report: &'a VerifyReport,
    details: &'a [Detail],
    exit_status: u8,
    /// Of each recording.
    problems: Vec<Vec<String>>,
    /// By each of the report's skips.
    saved_us: Vec<f64>,
}

/// The page of a report.
pub fn html(blob: &Blob) -> String {
    let report = &blob.report;
    let page = Page {
        report,
        details: &blob.details,
        exit_status: report.exit_code(),
        problems: report.recordings.iter().map(RecordingReport::problems).collect(),
        saved_us: report.skips.iter().map(Skips::saved_us).collect(),
    };
    let data = serde_json::to_string(&page).expect("names, numbers and texts always have a form");
    let (head, tail) = PAGE.split_once(SLOT).expect("the page has a slot");
    [head, &data.replace('<', "\\u003c"), tail].concat()
}

/// Bytes as base64 (RFC 4648), as data URLs hold them.
pub(super) fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let bits =
            group.iter().fold(0_u32, |bits, byte| bits << 8 | u32::from(*byte)) << (8 * (3 - group.len()));
        for place in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * place)) as usize & 63];
            text.push(if place > group.len() { '=' } else { digit.into() });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::report::{RecordingReport, VerifyReport};

    #[test]
    fn base64_is_that_of_the_rfc() {
        let expected = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (length, expected) in expected.iter().enumerate() {
            assert_eq!(base64(&b"foobar"[..length]), *expected);
        }
        assert_eq!(base64(&[0xff, 0xef, 0xfe]), "/+/+");
    }

    #[test]
    fn no_name_becomes_part_of_the_page() {
        let name = "</script><script>alert(1)</script><!--&\"'";
        let report = VerifyReport::new(None, vec![RecordingReport::new(name.into())]);
        let page = html(&Blob::new(report, Vec::new()));
        let tags = |text: &str| (text.matches('<').count(), text.matches("</script").count());
        assert_eq!(tags(&page), tags(PAGE));
        let (_, data) = page.split_once("type=\"application/json\">").expect("the data");
        let (data, _) = data.split_once("</script>").expect("its end");
        let data: serde_json::Value = serde_json::from_str(data).expect("JSON");
        assert_eq!(data["report"]["recordings"][0]["recording"], name, "and it is all there");
    }

    #[test]
    fn the_page_asks_for_nothing() {
        assert_eq!(PAGE.matches(SLOT).count(), 1);
        for outside in ["http:", "https:", "src=", "href=", "@import", "url(", "fetch(", "innerHTML"] {
            assert!(!PAGE.contains(outside), "{outside}");
        }
    }
}

//! A report as JUnit XML, as continuous integration shows it.
//!
//! A recording is a test case, in the class of its folder: verified, failed, or in error when it could not be replayed. What is no
//! recording's (orphaned goldens, paths that stand for nothing) is in test cases of its own.

use std::fmt::Write as _;

use super::report::{RecordingReport, Verdict, VerifyReport};

/// The report as XML.
pub fn junit(report: &VerifyReport) -> String {
    let mut cases: Vec<Case<'_>> = report.recordings.iter().map(Case::of).collect();
    cases.extend(Case::loose("orphaned goldens", "failure", &report.orphans));
    cases.extend(Case::loose("what was asked for", "error", &report.errors));
    let count = |kind: &str| cases.iter().filter(|c| c.fault == Some(kind)).count();
    let counts = format!(
        "tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3}\"",
        cases.len(),
        count("failure"),
        count("error"),
        report.ms / 1e3
    );
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {counts}>\n  <testsuite name=\"lancet verify\" {counts}>\n"
    );
    if let Some(adapter) = &report.adapter {
        let value = escape(&adapter.to_string());
        xml += &format!("    <properties><property name=\"renderer\" value=\"{value}\"/></properties>\n");
    }
    cases.iter().for_each(|case| case.write(&mut xml));
    xml + "  </testsuite>\n</testsuites>\n"
}

struct Case<'a> {
    class: &'a str,
    name: &'a str,
    ms: f64,
    /// `failure` or `error`.
    fault: Option<&'static str>,
    lines: Vec<String>,
}

impl<'a> Case<'a> {
    fn of(recording: &'a RecordingReport) -> Self {
        let (class, name) = recording.recording.rsplit_once('/').unwrap_or(("", &recording.recording));
        let fault = match recording.verdict {
            Verdict::Verified => None,
            Verdict::Failed => Some("failure"),
            Verdict::Unreadable => Some("error"),
        };
        Self { class, name, ms: recording.ms, fault, lines: recording.problems() }
    }

    fn loose(name: &'a str, fault: &'static str, lines: &[String]) -> Option<Self> {
        let case = Self { class: "", name, ms: 0.0, fault: Some(fault), lines: lines.to_vec() };
        (!lines.is_empty()).then_some(case)
    }

    fn write(&self, xml: &mut String) {
        let class = if self.class.is_empty() { "lancet".into() } else { format!("lancet.{}", self.class) };
        let head = format!(
            "    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3}\"",
            escape(&class.replace('/', ".")),
            escape(self.name),
            self.ms / 1e3
        );
        // Writing to a text cannot fail.
        let _ = match self.fault {
            None => writeln!(xml, "{head}/>"),
            Some(fault) => {
                let first = self.lines.first().map_or("", String::as_str);
                writeln!(
                    xml,
                    "{head}>\n      <{fault} message=\"{}\">{}</{fault}>\n    </testcase>",
                    escape(first),
                    escape(&self.lines.join("\n"))
                )
            }
        };
    }
}

/// A text as XML may hold it; characters that it may not hold at all become U+FFFD.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\'' => escaped += "&apos;",
            '\n' => escaped += "&#10;",
            '\t' => escaped += "&#9;",
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> VerifyReport {
        let recording = |name: &str, verdict, error: Option<&str>| {
            let error = error.map(Into::into);
            RecordingReport { verdict, error, ms: 1500.0, ..RecordingReport::new(name.into()) }
        };
        let recordings = vec![
            recording("wound/fine", Verdict::Verified, None),
            recording("wound/<\"b\" & 'c'>", Verdict::Failed, Some("a\u{1b}[31m]]>\nb")),
            recording("lone", Verdict::Unreadable, Some("cut off")),
        ];
        let orphans = vec!["golden/x: orphaned".into()];
        VerifyReport { orphans, ms: 4500.0, ..VerifyReport::new(None, recordings) }
    }

    #[test]
    fn a_recording_is_a_test_case() {
        let xml = junit(&report());
        let counts = "tests=\"4\" failures=\"2\" errors=\"1\" time=\"4.500\"";
        assert!(xml.contains(&format!("<testsuite name=\"lancet verify\" {counts}>")), "{xml}");
        assert!(xml.contains("<testcase classname=\"lancet.wound\" name=\"fine\" time=\"1.500\"/>\n"));
        assert!(xml.contains("<error message=\"cut off\">cut off</error>"));
        assert!(xml.contains("name=\"orphaned goldens\"") && xml.contains("golden/x: orphaned"));
    }

    #[test]
    fn whatever_a_name_holds_it_is_well_formed() {
        let xml = junit(&report());
        assert!(xml.contains("name=\"&lt;&quot;b&quot; &amp; &apos;c&apos;&gt;\""), "{xml}");
        assert!(xml.contains("<failure message=\"a\u{fffd}[31m]]&gt;&#10;b\">"), "{xml}");
        let tags = xml.matches('<').count();
        assert_eq!(tags, xml.matches('>').count(), "no text holds a bracket");
        for end in ["testsuites", "testsuite", "failure", "error"] {
            let (open, close) = (format!("<{end} "), format!("</{end}>"));
            assert_eq!(xml.matches(&open).count(), xml.matches(&close).count(), "{end}");
        }
    }
}

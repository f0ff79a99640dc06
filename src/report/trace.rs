//! A run as a Chrome trace (the `traceEvents` of `chrome://tracing` and Perfetto).
//!
//! A report knows how long each stage ran, not when: the spans are laid end to end, each event around its stages.

use std::io::{self, Write};

use serde_json::{Value, json};

use super::{EventReport, RunReport};

/// Writes the spans of all events and stages that ran. Times are microseconds.
pub fn trace(run: &RunReport, out: &mut dyn Write) -> io::Result<()> {
    let mut clock_us = 0.0;
    let mut spans = Vec::new();
    for event in &run.events {
        let begin_us = clock_us;
        let stages = event.stages.iter().filter(|s| s.skipped.is_none());
        for stage in stages {
            spans.push(span(&stage.id, "stage", clock_us, stage.us, json!({ "digest": stage.digest })));
            clock_us += stage.us;
        }
        if clock_us > begin_us {
            spans.push(span(&event_title(event), "event", begin_us, clock_us - begin_us, detail(event)));
        }
    }
    let document = json!({ "displayTimeUnit": "ms", "traceEvents": spans });
    serde_json::to_writer(&mut *out, &document)?;
    writeln!(out)
}

fn event_title(event: &EventReport) -> String {
    format!("{} {}", event.index, event.kind)
}

fn detail(event: &EventReport) -> Value {
    json!({ "mode": event.mode, "outcome": event.outcome, "reason": event.reason })
}

fn span(name: &str, category: &str, begin_us: f64, us: f64, args: Value) -> Value {
    json!({ "name": name, "cat": category, "ph": "X", "pid": 1, "tid": 1, "ts": begin_us, "dur": us, "args": args })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::StageReport;

    #[test]
    fn stages_lie_end_to_end_within_their_event() {
        let mut event = EventReport::new(7, "cut");
        for (id, us) in [("FC", 2.0), ("MC", 3.0)] {
            event.stages.push(StageReport { us, skipped: None, ..StageReport::skipped(id, "") });
        }
        event.stages.push(StageReport::skipped("CI", "mode"));
        let run = RunReport::new("a", "wound", Default::default(), vec![event], None);
        let mut out = Vec::new();
        trace(&run, &mut out).expect("writing to memory");
        let json: Value = serde_json::from_slice(&out).expect("a trace is JSON");
        let spans = json["traceEvents"].as_array().expect("a list");
        let seen: Vec<_> =
            spans.iter().map(|s| (s["name"].as_str(), s["ts"].as_f64(), s["dur"].as_f64())).collect();
        let expected = [("FC", 0.0, 2.0), ("MC", 2.0, 3.0), ("7 cut", 0.0, 5.0)];
        assert_eq!(seen, expected.map(|(n, t, d)| (Some(n), Some(t), Some(d))));
    }
}

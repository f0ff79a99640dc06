//! Where a replay is to stop: a breakpoint, as a word that a person types.
//!
//! | word | stops after the first event |
//! | --- | --- |
//! | `finding` | with a broken invariant |
//! | `rejected` | that was rejected |
//! | `rejected=REASON` | that was rejected for this reason, such as `miss` |
//! | `COUNTER=NAME` | that counted something by this name, such as `configurations=FE` |
//! | `COUNTER=N` | at which a counter without names is this number, such as `snapped=1` |
//! | `STAGE>MS` | with a stage that took longer than so many milliseconds, such as `MC>0.5` |
//!
//! All but the last are the same in every run.

use std::fmt;
use std::str::FromStr;

use super::{Counter, EventReport, Outcome};

/// What an event has to be for a replay to stop after it.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// An invariant of it is broken.
    Finding,
    /// It was rejected; for this reason, where one is named.
    Rejected(Option<String>),
    /// It counted something.
    Counted {
        /// The counter, such as `configurations`.
        counter: String,
        /// A name in it that was counted, such as `FE`; of a counter without names its number.
        name: String,
    },
    /// A stage of it took long.
    Slower {
        /// The stage, such as `MC`.
        stage: String,
        /// Milliseconds that it may take.
        ms: f64,
    },
}

impl Stop {
    /// The stage that it names, where it names one.
    pub fn stage(&self) -> Option<&str> {
        match self {
            Self::Slower { stage, .. } => Some(stage),
            Self::Finding | Self::Rejected(_) | Self::Counted { .. } => None,
        }
    }

    /// Whether an event is such a one.
    pub fn hits(&self, event: &EventReport) -> bool {
        match self {
            Self::Finding => event.findings().next().is_some(),
            Self::Rejected(reason) => {
                event.outcome == Outcome::Rejected && (reason.is_none() || event.reason == *reason)
            }
            Self::Counted { counter, name } => match event.counters.get(counter) {
                Some(Counter::ByName(counts)) => counts.get(name).is_some_and(|count| *count > 0),
                Some(Counter::Count(count)) => count.to_string() == *name,
                None => false,
            },
            Self::Slower { stage, ms } => {
                event.stages.iter().any(|row| row.id == *stage && row.skipped.is_none() && row.us > ms * 1e3)
            }
        }
    }
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finding => write!(f, "finding"),
            Self::Rejected(None) => write!(f, "rejected"),
            Self::Rejected(Some(reason)) => write!(f, "rejected={reason}"),
            Self::Counted { counter, name } => write!(f, "{counter}={name}"),
            Self::Slower { stage, ms } => write!(f, "{stage}>{ms}"),
        }
    }
}

impl FromStr for Stop {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is not finding, rejected, rejected=REASON, COUNTER=NAME, such as configurations=FE, or STAGE>MS, such as MC>0.5"
            )
        };
        let said = |word: &str| (!word.is_empty()).then(|| word.to_owned()).ok_or_else(wrong);
        if let Some((stage, ms)) = text.split_once('>') {
            let ms = ms.parse().ok().filter(|ms: &f64| ms.is_finite() && *ms >= 0.0);
            return Ok(Self::Slower { stage: said(stage)?, ms: ms.ok_or_else(wrong)? });
        }
        match (text, text.split_once('=')) {
            ("finding", _) => Ok(Self::Finding),
            ("rejected", _) => Ok(Self::Rejected(None)),
            (_, Some(("rejected", reason))) => Ok(Self::Rejected(Some(said(reason)?))),
            (_, Some((counter, name))) if counter != "finding" => {
                Ok(Self::Counted { counter: said(counter)?, name: said(name)? })
            }
            _ => Err(wrong()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Check, Rejection, StageReport};

    fn stop(text: &str) -> Stop {
        text.parse().expect("a word that stops")
    }

    /// A cut with two stages, the second of which did not run.
    fn cut() -> EventReport {
        let mut event = EventReport::new(2, "cut");
        event.outcome = Outcome::Applied;
        let by_name = Counter::ByName([("FE".into(), 1), ("EE".into(), 0)].into());
        event.counters = [("configurations".into(), by_name), ("snapped".into(), Counter::Count(3))].into();
        event.stages.push(StageReport { us: 700.0, skipped: None, ..StageReport::skipped("MC", "") });
        event.stages.push(StageReport { us: 9e9, ..StageReport::skipped("CI", "mode") });
        event
    }

    fn hit(event: &EventReport) -> Vec<&'static str> {
        let words = [
            "finding",
            "rejected",
            "rejected=miss",
            "configurations=FE",
            "configurations=EE",
            "configurations=NN",
            "snapped=3",
            "snapped=30",
            "links=3",
            "MC>0.5",
            "MC>0.7",
            "CI>0",
        ];
        words.into_iter().filter(|word| stop(word).hits(event)).collect()
    }

    #[test]
    fn an_event_stops_by_what_it_counted_and_by_what_took_long() {
        assert_eq!(hit(&cut()), ["configurations=FE", "snapped=3", "MC>0.5"]);
        assert!(hit(&EventReport::new(0, "camera")).is_empty());
    }

    #[test]
    fn an_event_stops_by_its_outcome() {
        let mut miss = EventReport::new(3, "click");
        miss.reject(Rejection::new("miss", "beside the mesh"));
        assert_eq!(hit(&miss), ["rejected", "rejected=miss"]);
        miss.reject(Rejection::new("silhouette", ""));
        assert_eq!(hit(&miss), ["rejected"]);
        miss.outcome = Outcome::Cancelled;
        assert!(hit(&miss).is_empty());
    }

    #[test]
    fn a_broken_invariant_stops_wherever_it_broke() {
        let (mut of_stage, mut of_state) = (EventReport::new(0, "cut"), EventReport::new(1, "checkpoint"));
        let checks = vec![Check::pass("closed"), Check::fail("manifold", "a hole")];
        of_stage.stages.push(StageReport { checks: checks.clone(), ..StageReport::skipped("MC", "") });
        of_state.checks = checks;
        assert_eq!([hit(&of_stage), hit(&of_state)], [["finding"], ["finding"]]);
    }

    #[test]
    fn what_is_typed_comes_back() {
        for text in ["finding", "rejected", "rejected=too-short", "configurations=FE", "snapped=1", "MC>0.5"]
        {
            assert_eq!(stop(text).to_string(), text);
        }
        assert_eq!(stop("MC>.50").to_string(), "MC>0.5");
    }

    #[test]
    fn what_stops_nowhere_is_refused() {
        for text in [
            "",
            "found",
            "finding=x",
            "rejected=",
            "=FE",
            "configurations=",
            "MC>",
            ">1",
            "MC>-1",
            "MC>NaN",
            "MC>inf",
        ] {
            let error = text.parse::<Stop>().expect_err(text);
            assert!(error.starts_with(&format!("`{text}` is not finding, ")), "{error}");
        }
    }
}

//! A place in a run: after so many events, or within the next one after a stage.

use crate::report::EventReport;

/// See the module. Places are in the order of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::tui) struct Place {
    /// How many events have run.
    pub(in crate::tui) events: usize,
    /// The row of the next event's stages that has run too.
    pub(in crate::tui) stage: Option<usize>,
}

impl Place {
    /// Before the first event.
    pub(in crate::tui) const START: Self = Self { events: 0, stage: None };

    /// After so many events.
    pub(in crate::tui) fn after(events: usize) -> Self {
        Self { events, stage: None }
    }

    /// The event that ran last, in part or in whole.
    pub(in crate::tui) fn event(self) -> Option<usize> {
        match self.stage {
            Some(_) => Some(self.events),
            None => self.events.checked_sub(1),
        }
    }

    /// The place one stage on. `next` is the report of the event numbered `events`; none where there is no event left.
    pub(in crate::tui) fn stage_on(self, next: Option<&EventReport>) -> Option<Self> {
        let rows = ran(next?);
        let on = match self.stage {
            Some(stage) => rows.iter().find(|row| **row > stage),
            None => rows.first(),
        };
        // After the last stage there is what the session does with the work: the event is over.
        let within = on.filter(|row| rows.last() != Some(row));
        Some(within.map_or(Self::after(self.events + 1), |row| Self { stage: Some(*row), ..self }))
    }

    /// The place after a row of an event's stages, or after the last one before it that ran; none where none did.
    pub(in crate::tui) fn after_row(report: &EventReport, row: usize) -> Option<Self> {
        let rows = ran(report);
        let stage = *rows.iter().rfind(|ran| **ran <= row).filter(|_| row < report.stages.len())?;
        let within = rows.last() != Some(&stage);
        Some(if within {
            Self { events: report.index, stage: Some(stage) }
        } else {
            Self::after(report.index + 1)
        })
    }

    /// The row of the stage that ran last, in the report of [`Place::event`].
    pub(in crate::tui) fn row(self, report: &EventReport) -> Option<usize> {
        self.stage.or_else(|| ran(report).last().copied())
    }

    /// The place one stage back. `report` gives the report of an event.
    pub(in crate::tui) fn stage_back<'a>(
        self,
        report: impl Fn(usize) -> Option<&'a EventReport>,
    ) -> Option<Self> {
        let event = self.event()?;
        let rows = ran(report(event)?);
        let before = match self.stage {
            Some(stage) => rows.iter().rev().find(|row| **row < stage),
            None => rows.iter().rev().nth(1),
        };
        Some(Self { events: event, stage: before.copied() })
    }
}

/// The rows of the stages that ran.
pub(in crate::tui) fn ran(report: &EventReport) -> Vec<usize> {
    (0..report.stages.len()).filter(|row| report.stages[*row].skipped.is_none()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::StageReport;

    /// Four stages, of which the second was skipped.
    fn report() -> EventReport {
        let stage = |id: &str| StageReport { skipped: None, ..StageReport::skipped(id, "") };
        let stages = vec![stage("A"), StageReport::skipped("B", "mode"), stage("C"), stage("D")];
        EventReport { stages, ..EventReport::new(0, "cut") }
    }

    #[test]
    fn stages_are_walked_on_and_back_over_what_was_skipped() {
        let report = report();
        let mut places = vec![Place::START];
        while let Some(on) =
            places.last().and_then(|place| place.stage_on((place.events == 0).then_some(&report)))
        {
            places.push(on);
        }
        let within = |stage| Place { events: 0, stage: Some(stage) };
        assert_eq!(places, [Place::START, within(0), within(2), Place::after(1)]);
        assert!(places.is_sorted());
        for pair in places.windows(2) {
            assert_eq!(pair[1].stage_back(|_| Some(&report)), Some(pair[0]));
        }
        assert_eq!(Place::START.stage_back(|_| Some(&report)), None);
    }

    #[test]
    fn a_row_of_the_stages_is_a_place_and_the_place_has_that_row() {
        let report = report();
        let places: Vec<Option<Place>> = (0..5).map(|row| Place::after_row(&report, row)).collect();
        let within = |stage| Some(Place { events: 0, stage: Some(stage) });
        assert_eq!(places, [within(0), within(0), within(2), Some(Place::after(1)), None]);
        let rows: Vec<Option<usize>> = places.into_iter().flatten().map(|place| place.row(&report)).collect();
        assert_eq!(rows, [Some(0), Some(0), Some(2), Some(3)]);
        assert_eq!(Place::after(1).row(&EventReport::new(0, "mode")), None);
    }

    #[test]
    fn an_event_without_stages_is_one_step() {
        let report = EventReport::new(3, "mode");
        assert_eq!(Place::after(3).stage_on(Some(&report)), Some(Place::after(4)));
        assert_eq!(Place::after(4).stage_back(|_| Some(&report)), Some(Place::after(3)));
    }
}

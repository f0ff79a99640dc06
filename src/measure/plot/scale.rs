//! A logarithmic axis: where values lie, which of them have a line, and how they are written.

/// Part of the span that is left free at either end.
const FREE: f64 = 0.07;
/// Where nought lies, as a part of the axis.
const NOUGHT: f64 = 0.03;
/// Up to so many decades also twos and fives are named.
const FEW: f64 = 2.6;

/// Beyond so many decades only they have a line.
const MANY: f64 = 7.0;

/// An axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// log₁₀ of the ends.
    from: f64,
    to: f64,
    /// Where the ends lie.
    ends: [f64; 2],
    has_zero: bool,
}

/// A line across the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) at: f64,
    /// Whether the value is written.
    pub(super) named: bool,
}

impl Scale {
    /// The axis that holds some values, between two ends.
    pub(super) fn over(values: impl Iterator<Item = f64>, ends: [f64; 2]) -> Self {
        let (mut least, mut most, mut has_zero) = (f64::INFINITY, f64::NEG_INFINITY, false);
        for value in values {
            if value > 0.0 && value.is_finite() {
                (least, most) = (least.min(libm::log10(value)), most.max(libm::log10(value)));
            } else {
                has_zero = true;
            }
        }
        // Of no value, or of one.
        let (least, most) = if least <= most { (least, most) } else { (0.0, 0.0) };
        let missing = 0.5 * (0.6 - (most - least)).max(0.0);
        let (least, most) = (least - missing, most + missing);
        let free = FREE * (most - least);
        let below = if has_zero { 0.15 * (most - least) } else { 0.0 };
        Self { from: least - free - below, to: most + free, ends, has_zero }
    }

    /// Where a value lies.
    pub(super) fn at(&self, value: f64) -> f64 {
        match value > 0.0 {
            true => self.place((libm::log10(value) - self.from) / (self.to - self.from)),
            false => self.place(NOUGHT),
        }
    }

    fn place(&self, part: f64) -> f64 {
        self.ends[0] + (self.ends[1] - self.ends[0]) * part
    }

    /// Where nought lies, if there is one.
    pub(super) fn zero(&self) -> Option<f64> {
        self.has_zero.then(|| self.place(NOUGHT))
    }

    /// The lines: every step of a decade, but no more names than can be read.
    pub(super) fn ticks(&self) -> Vec<Tick> {
        let decades = self.to - self.from;
        let every = libm::ceil(decades / 10.0).max(1.0) as i64;
        // Beside the line of nought nothing else is written.
        let first = if self.has_zero { self.from + (NOUGHT + 0.05) * decades } else { self.from };
        let mut ticks = Vec::new();
        for decade in libm::floor(self.from) as i64..=libm::floor(self.to) as i64 {
            for step in 1..10_u8 {
                let value = f64::from(step) * libm::exp10(decade as f64);
                let place = libm::log10(value);
                if place < first || place > self.to || step > 1 && decades > MANY {
                    continue;
                }
                let named = match step {
                    1 => decade.rem_euclid(every) == 0,
                    2 | 5 => decades < FEW,
                    _ => false,
                };
                ticks.push(Tick { value, at: self.at(value), named });
            }
        }
        ticks
    }
}

/// Microseconds, in the unit that suits them.
pub(super) fn time(us: f64) -> String {
    match us {
        0.0..1.0 => format!("{} ns", short(us * 1e3)),
        1.0..1e3 => format!("{} µs", short(us)),
        1e3..1e6 => format!("{} ms", short(us / 1e3)),
        _ => format!("{} s", short(us / 1e6)),
    }
}

/// A number as short as can be.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value) {
        return short(value);
    }
    let decade = libm::floor(libm::log10(value) + 1e-9);
    let leading = short(value / libm::exp10(decade));
    let power = power(decade as i32);
    if leading == "1" { format!("10{power}") } else { format!("{leading}·10{power}") }
}

/// Three digits, without noughts at the end.
fn short(value: f64) -> String {
    let decimals = if value == 0.0 { 0 } else { (2 - libm::floor(libm::log10(value)) as i32).clamp(0, 6) };
    let text = format!("{value:.*}", decimals as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}

fn power(n: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' | '4'..='9' => char::from_u32('⁰' as u32 + c as u32 - '0' as u32).unwrap_or(c),
        other => other,
    };
    n.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_in_order_between_the_ends() {
        let scale = Scale::over([1e-3, 1.0, 1e3].into_iter(), [0.0, 100.0]);
        let at = [1e-3, 1.0, 1e3].map(|v| scale.at(v));
        assert!(at[0] > 0.0 && at[0] < 10.0 && (at[1] - 50.0).abs() < 1e-9 && at[2] < 100.0);
        assert!(scale.ticks().iter().all(|t| (0.0..=100.0).contains(&t.at)));
        assert_eq!(scale.ticks().iter().filter(|t| t.named).count(), 7);
        assert!(scale.zero().is_none());
        let with_zero = Scale::over([0.0, 1.0, 10.0].into_iter(), [0.0, 100.0]);
        assert!(with_zero.zero().expect("a line") < with_zero.at(1.0));
    }

    #[test]
    fn a_short_axis_names_twos_and_fives() {
        let scale = Scale::over([3.0, 4.0].into_iter(), [0.0, 1.0]);
        let named: Vec<f64> = scale.ticks().iter().filter(|t| t.named).map(|t| t.value).collect();
        assert_eq!(named, [2.0, 5.0]);
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.5, 20.0, 3e3, 2.5e6].map(time), ["500 ns", "20 µs", "3 ms", "2.5 s"]);
        assert_eq!([0.0, 0.01, 250.0, 1e-6, 2e5].map(number), ["0", "0.01", "250", "10⁻⁶", "2·10⁵"]);
    }
}

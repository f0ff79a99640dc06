//! Who is timed takes turns: round by round each task runs once, so that whatever else runs on the machine disturbs all alike.
//!
//! **One thread** does it all: a pass that would be shared out among threads waits for the slowest of them, and on a shared machine that is anybody's guess. What is
//! measured is work.
//!
//! **The yardstick** is a fixed piece of work that begins every round: square roots and hashes in registers, and a walk over memory that no cache
//! of the first level holds. No change of the program touches it, so what a task takes in yardsticks can be compared between runs, machines and
//! changes, roughly: up to what the machine is better at.

use std::hint::black_box;
use std::time::Instant;

use rayon::ThreadPoolBuilder;

use crate::measure::{Figure, MeasureError, Random};

/// Runs once, and says how many microseconds of that count.
pub(super) type Task<'a> = Box<dyn FnMut() -> Result<f64, MeasureError> + Send + 'a>;

/// What a task takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Timing {
    /// Microseconds.
    pub(super) us: Figure,
    /// The same in yardsticks.
    pub(super) effort: Figure,
}

/// Runs all tasks in turns, after a round that warms up.
pub(super) fn in_turns(rounds: usize, tasks: &mut [Task<'_>]) -> Result<Vec<Timing>, MeasureError> {
    let pool = ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|error| MeasureError::Rejected(error.to_string()))?;
    pool.install(|| run(rounds, tasks))
}

fn run(rounds: usize, tasks: &mut [Task<'_>]) -> Result<Vec<Timing>, MeasureError> {
    let mut yardstick = Yardstick::new();
    let mut taken: Vec<Vec<[f64; 2]>> = vec![Vec::with_capacity(rounds); tasks.len()];
    for round in 0..=rounds {
        let unit = yardstick.us();
        for (task, taken) in tasks.iter_mut().zip(&mut taken) {
            let us = task()?;
            if round > 0 {
                taken.push([us, us / unit]);
            }
        }
    }
    let figure = |taken: &[[f64; 2]], k: usize| Figure::of(taken.iter().map(|t| t[k]));
    Ok(taken.iter().map(|t| Timing { us: figure(t, 0), effort: figure(t, 1) }).collect())
}

/// Microseconds that something takes.
pub(super) fn timed<T>(run: impl FnOnce() -> T) -> (T, f64) {
    let clock = Instant::now();
    let value = black_box(run());
    (value, clock.elapsed().as_nanos() as f64 / 1e3)
}

/// Words that are walked over: a megabyte.
const WORDS: usize = 1 << 17;
/// Steps of a turn, some 200 µs.
const STEPS: usize = 40_000;

struct Yardstick {
    words: Vec<u64>,
}

impl Yardstick {
    fn new() -> Self {
        let mut random = Random::of(0, 0, "yardstick");
        Self { words: (0..WORDS).map(|_| random.any()).collect() }
    }

    /// The least of three turns: what disturbs makes it longer.
    fn us(&mut self) -> f64 {
        (0..3).map(|_| timed(|| self.turn()).1).fold(f64::INFINITY, f64::min)
    }

    fn turn(&mut self) -> f64 {
        let (mut at, mut sum) = (0_u64, 0.0);
        for _ in 0..STEPS {
            at = self.words[(at >> 47) as usize % WORDS].wrapping_add(at.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            sum += ((at >> 11) as f64).sqrt();
        }
        black_box(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_take_turns_and_the_first_round_does_not_count() {
        let order = std::sync::Mutex::new(Vec::new());
        let task = |name: usize| -> Task<'_> {
            let order = &order;
            Box::new(move || {
                let mut order = order.lock().expect("nobody panicked");
                order.push(name);
                // The round that warms up takes longest.
                Ok(if order.len() <= 2 { 1e9 } else { 10.0 * (name + 1) as f64 })
            })
        };
        let timings = in_turns(3, &mut [task(0), task(1)]).expect("they run");
        assert_eq!(*order.lock().expect("nobody panicked"), [0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(timings.iter().map(|t| t.us.high).collect::<Vec<_>>(), [10.0, 20.0]);
        assert!(timings.iter().all(|t| t.effort.median > 0.0));
    }
}

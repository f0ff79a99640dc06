//! How many instructions the hot paths take, compared with those that are kept in `benches/counts.txt`.
//!
//! ```sh
//! cargo bench --no-default-features --bench instructions
//! cargo bench --no-default-features --bench instructions -- --bless --reason "why they are others"
//! cargo bench --no-default-features --bench instructions -- --plant pick    # does the work of one path twice: this has to fail
//! ```
//!
//! Status 1: a path is off by more than 3 %. Where there is no valgrind, or the counts that are kept were made by another compiler or on another
//! kind of processor, it says so, and nothing is compared.

#[path = "../kit/mod.rs"]
mod kit;
mod paths;
mod valgrind;

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use lancet::measure::counts::{Count, Counts, share};

/// What was typed.
#[derive(Default)]
struct Typed {
    bless: bool,
    reason: Option<String>,
    plant: Option<String>,
    /// Run the paths, as callgrind wants it.
    measured: bool,
}

fn main() -> ExitCode {
    let mut said = String::new();
    let done = Typed::read(std::env::args().skip(1)).and_then(|typed| match typed.measured {
        true => paths::run(typed.plant.as_deref(), &mut said).map(|()| true),
        false => compare(&typed, &mut said),
    });
    // A reader that went away needs no answer.
    let _ = std::io::stdout().write_all(said.as_bytes());
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

impl Typed {
    fn read(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut typed = Self::default();
        while let Some(word) = words.next() {
            match word.as_str() {
                // Cargo says this to every benchmark.
                "--bench" => {}
                "--bless" => typed.bless = true,
                "--measured" => typed.measured = true,
                "--reason" => typed.reason = words.next(),
                "--plant" => typed.plant = words.next(),
                other => {
                    return Err(format!(
                        "there is no {other}; there are --bless, --reason TEXT, --plant PATH"
                    ));
                }
            }
        }
        let reason = typed.reason.as_deref().map_or("", str::trim);
        match typed.bless && (reason.is_empty() || reason.contains('\n')) {
            true => Err("--bless needs a --reason, of one line".into()),
            false => Ok(typed),
        }
    }
}

fn file() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "benches", "counts.txt"].iter().collect()
}

/// Whether all is as it is kept, or kept by now.
fn compare(typed: &Typed, said: &mut String) -> Result<bool, String> {
    let Some(valgrind) = valgrind::version() else {
        *said += "skipped: no valgrind\n";
        return Ok(true);
    };
    let kept = match file().exists() {
        true => Counts::parse(&fs::read_to_string(file()).map_err(|error| error.to_string())?)?,
        false => Counts::default(),
    };
    let now = valgrind::count(&valgrind, typed.plant.as_deref())?;
    *said += &table(&kept, &now);
    if typed.bless {
        let reason = typed.reason.as_deref().unwrap_or_default().trim();
        fs::write(file(), kept.blessed(&now, reason).text()).map_err(|error| error.to_string())?;
        *said += "kept\n";
        return Ok(true);
    }
    if !kept.paths.is_empty() && kept.made != now.made {
        let [kept, now] = [kept.made, now.made];
        *said +=
            &format!("not compared: those that are kept were made by\n  {kept}\nand these by\n  {now}\n");
        return Ok(true);
    }
    let changes = kept.changes(&now);
    changes.iter().for_each(|change| *said += &format!("{change}\n"));
    if !changes.is_empty() {
        *said += "What was meant is kept with: -- --bless --reason TEXT\n";
    }
    Ok(changes.is_empty())
}

fn table(kept: &Counts, now: &Counts) -> String {
    let row = |is: &Count| {
        let was = kept.paths.iter().find(|was| was.name == is.name);
        let off = |was: &Count| format!("{:+.2} %", 100.0 * share(was.instructions, is.instructions));
        format!("{:<16} {:>14} {:>9}\n", is.name, is.instructions, was.map_or("new".into(), off))
    };
    let head = format!("{:<16} {:>14} {:>9}\n", "path", "instructions", "change");
    std::iter::once(head).chain(now.paths.iter().map(row)).collect()
}

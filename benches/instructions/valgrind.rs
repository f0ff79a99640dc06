//! This program again, under callgrind: it counts within one function alone, and writes a file whenever that is left.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use lancet::measure::counts::{Count, Counts, callgrind_total};

use crate::paths::PATHS;

/// The function that is counted in: see `paths::measured`. With a pattern in place of a name nothing is dumped.
const MEASURED: &str = "instructions::paths::measured";

/// Which valgrind there is, if any.
pub(crate) fn version() -> Option<String> {
    let output = Command::new("valgrind").arg("--version").output().ok()?;
    output.status.success().then(|| text(&output))
}

/// Counts what the paths take.
pub(crate) fn count(valgrind: &str, plant: Option<&str>) -> Result<Counts, String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let out = folder.path().join("out");
    let output = callgrind(&out, plant)?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("{}\n{said}", output.status));
    }
    let processor = text(&output);
    let paths = (1..).zip(PATHS).map(|(part, path)| {
        let file = format!("{}.{part}", out.display());
        let total =
            fs::read_to_string(&file).ok().and_then(|text| callgrind_total(&text)).filter(|total| *total > 0);
        let instructions =
            total.ok_or_else(|| format!("callgrind counted nothing for {}\n{said}", path.name))?;
        Ok(Count { name: path.name.into(), instructions, reason: String::new() })
    });
    let made = format!("{}, {valgrind}, {processor}, {}", compiler()?, features());
    Ok(Counts { made, paths: paths.collect::<Result<_, String>>()? })
}

fn callgrind(out: &Path, plant: Option<&str>) -> Result<Output, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--collect-atstart=no"]);
    command.arg(format!("--callgrind-out-file={}", out.display()));
    command.args([format!("--toggle-collect={MEASURED}"), format!("--dump-after={MEASURED}")]);
    command.arg(program).arg("--measured");
    command.args(plant.into_iter().flat_map(|path| ["--plant", path]));
    // One thread, and nothing that only this shell has.
    let path = std::env::var_os("PATH").unwrap_or_default();
    command.env_clear().env("PATH", path).env("RAYON_NUM_THREADS", "1");
    command.output().map_err(|error| error.to_string())
}

/// The compiler that this package is built with.
fn compiler() -> Result<String, String> {
    let output = Command::new("rustc").arg("--version").current_dir(env!("CARGO_MANIFEST_DIR")).output();
    let output = output.map_err(|error| format!("rustc: {error}"))?;
    match output.status.success() {
        true => Ok(text(&output)),
        false => Err(format!("rustc --version: {}", String::from_utf8_lossy(&output.stderr).trim())),
    }
}

/// What else there is in the program, which moves the rest about.
fn features() -> &'static str {
    match (cfg!(feature = "gpu"), cfg!(feature = "tui")) {
        (false, false) => "without gpu and tui",
        _ => "with gpu or tui",
    }
}

fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).trim().into()
}

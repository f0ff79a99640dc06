#!/usr/bin/env bash
# Verifies on a Slurm cluster: N parts as an array, then one report. Usage: tests/slurm/submit.sh N FOLDER [PATH...]
# FOLDER has to be seen by every node; LANCET names the program (default: target/release/lancet). The exit status is that of `lancet merge`.
set -euo pipefail
parts=${1:?how many parts} folder=${2:?a folder for the parts and the report}
shift 2
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$folder"
BLOBS=$(realpath "$folder")
LANCET=$(realpath "${LANCET:-target/release/lancet}")
export BLOBS LANCET
rm -f "$BLOBS"/*.blob
# --wait ends when every task has.
sbatch --wait --array="1-$parts" --output="$BLOBS/%a.txt" --export=ALL "$here/verify.sbatch" "$@" || true
# A part that is missing is an error of the merge.
"$LANCET" merge "$BLOBS"/*.blob --json "$BLOBS/report.json"

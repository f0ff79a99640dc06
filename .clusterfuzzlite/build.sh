#!/bin/bash -eu
# Builds every fuzz target, with its corpus and, where it has one, its dictionary.
cd "$SRC/lancet"
# The image's own nightly, not the compiler that rust-toolchain.toml pins for the program.
cargo +nightly fuzz build -O --debug-assertions
for file in fuzz/fuzz_targets/*.rs; do
  target=$(basename "$file" .rs)
  cp "fuzz/target/x86_64-unknown-linux-gnu/release/$target" "$OUT/"
  zip -jq "$OUT/${target}_seed_corpus.zip" "fuzz/corpus/$target"/*
  if [[ -f fuzz/dictionaries/$target.dict ]]; then
    cp "fuzz/dictionaries/$target.dict" "$OUT/"
  fi
  # The same limits as the nightly run: no input may take long, nor set aside what its size does not justify.
  printf '[libfuzzer]\ntimeout = 20\nmalloc_limit_mb = 512\n' > "$OUT/$target.options"
done

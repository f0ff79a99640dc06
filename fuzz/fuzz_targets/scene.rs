#![no_main]

libfuzzer_sys::fuzz_target!(init: lancet_fuzz::begin(), |data: &[u8]| lancet_fuzz::attack("scene", data));

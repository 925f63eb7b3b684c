#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| netmesh_fuzz::features::check(data));

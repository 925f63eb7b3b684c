#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| netmesh_fuzz::facets::check(data));

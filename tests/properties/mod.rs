//! The properties that the fuzz targets check (`fuzz/src`), on stable Rust: for every file of the
//! fuzz targets' corpora, and for what proptest invents. Equal runs make equal inputs.

#[path = "../../fuzz/src/lib.rs"]
mod checks;

mod corpus;
mod findings;
mod flat_lattices;
mod inventions;

use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};

/// Checks `cases` values of the strategy, always the same ones.
fn for_all<S: Strategy>(cases: u32, strategy: S, check: impl Fn(S::Value)) {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let outcome = TestRunner::new_with_rng(config, random).run(&strategy, |value| {
        check(value);
        Ok::<(), TestCaseError>(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
}

//! The cases whose speed is watched: `benches/speed.rs` times them, `src/bin/one_run.rs` runs one
//! so that its instructions can be counted.

pub mod cases;
pub mod inputs;
#[path = "../../experiments/src/random.rs"]
mod random;

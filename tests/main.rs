//! The tests from outside, as one program: every program of its own is linked anew and compiles again
//! what it uses of the library. `hostile_files.rs` is another one, since it counts what its allocator
//! is asked for.

mod architecture;
mod c_api;
mod certificate;
mod closing;
mod damaged_meshes;
mod determinism;
mod extremes;
mod formats;
mod guarantees;
mod header;
mod instruments;
mod pages;
mod progress;
mod properties;
mod sizes;
mod spread_curve;
mod svr;
mod written_files;

#[path = "c/compiler.rs"]
mod compiler;
#[path = "support/directory.rs"]
mod directory;

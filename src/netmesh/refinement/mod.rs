//! Refinement (§6.4, §6.6): which cells are bad, and what mends them.
//!
//! `quality` tests simplices (Definition 4), `bad_simplex` sees at a glance which ones may be bad,
//! `refine_list` keeps those that are (REFINELIST), `steiner` places a point for one, `clean`
//! inserts it or the input that it yields to (CLEAN, YIELDINGINSERT). `finish` dissolves the cages
//! (FINISHMESH). `final_refinement` brings every cell to the caller's bound, `distance_ratio` then to a
//! part of its distance from the inputs, and `size` simplices to the sizes that are asked for.
//!
//! What tests or improves the shape of cells belongs here.

pub(super) mod bad_simplex;
mod cage_gap;
mod clean;
mod distance_ratio;
mod final_refinement;
mod finish;
mod quality;
pub(super) mod refine_list;
pub(super) mod size;
mod steiner;

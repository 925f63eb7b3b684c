//! Refinement of the whole mesh, once all inputs are in: `finish` dissolves the cages (FINISHMESH,
//! §6.6), `final_refinement` brings every cell to the caller's bound, `distance_ratio` then to a
//! part of its distance from the inputs, and `size` simplices to the sizes that are asked for.

pub(super) mod distance_ratio;
pub(super) mod final_refinement;
pub(super) mod finish;
pub(super) mod size;

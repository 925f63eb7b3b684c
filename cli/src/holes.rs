//! Holes of the input's surface, which `--close-holes` closes before anything else is done with it.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::numbers::counted;
use crate::standard;
use netmesh::{HoleFilling, Mesh};

/// Closes the holes that are to be closed.
pub fn close(mesh: &mut Mesh, arguments: &Arguments) -> Result<Option<HoleFilling>, Failure> {
    let Some(most) = arguments.close_holes else { return Ok(None) };
    let name = standard::input_name(&arguments.input);
    if mesh.given_facets().count() == 0 {
        let message = format!("{name}: has no facets; --close-holes is for surfaces");
        return Err(Failure::new(ExitCode::Usage, message));
    }
    let closed = mesh.close_holes(most as usize);
    closed.map(Some).map_err(|error| Failure::reading(&name, &error.of_content()))
}

/// Returns the line that tells what was closed.
pub fn told(filling: &HoleFilling) -> String {
    let count = |number: usize, one, many| counted(number as u64, one, many);
    format!(
        "{} closed with {}, {} left open",
        count(filling.holes, "hole", "holes"),
        count(filling.triangles.len(), "triangle", "triangles"),
        count(filling.open_edges, "edge", "edges"),
    )
}

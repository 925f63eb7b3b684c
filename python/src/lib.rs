//! The extension module `netmesh._netmesh`: meshes and their arrays, without the names and the
//! defaults that Python's users see, which are in the package beside it.

mod arrays;
mod boundary;
mod core;
mod derived;
mod errors;
mod export;
mod interpolation;
mod making;
mod options;
mod parts;
mod progress;
mod queries;
mod reading;
mod selection;
mod shapes;
mod sizes;
mod surface;
mod topology;
mod voronoi;

#[pyo3::pymodule]
mod _netmesh {
    #[pymodule_export]
    use crate::boundary::{
        close_holes, intersections, merge_points, odd_edges, triangulate_facets,
    };
    #[pymodule_export]
    use crate::core::Core;
    #[pymodule_export]
    use crate::interpolation::{PointIndexCore, cubic, estimate_gradients, representatives};
    #[pymodule_export]
    use crate::progress::Progress;
    #[pymodule_export]
    use crate::reading::{read_file, read_geojson};
    #[pymodule_export]
    use crate::surface::SurfaceCore;
    #[pymodule_export]
    use crate::topology::FiltrationCore;

    /// The version of the library.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}

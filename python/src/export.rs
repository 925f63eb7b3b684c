//! Files of a mesh.

use crate::core::Core;
use crate::errors::{detached_on_file, exception, invalid};
use crate::options::choice;
use netmesh::Attribute;
use netmesh::io::{Format, write_file_with};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use std::path::{Path, PathBuf};

#[pymethods]
impl Core {
    fn export(
        &self,
        py: Python<'_>,
        path: PathBuf,
        format: &Bound<'_, PyAny>,
        attributes: Vec<(String, PyReadonlyArray2<'_, f64>)>,
    ) -> PyResult<()> {
        let formats = [
            ("auto", Format::Auto),
            ("vtu", Format::Vtu),
            ("tetgen_node", Format::TetgenNode),
            ("gmsh", Format::Gmsh),
            ("medit", Format::Medit),
            ("off", Format::Off),
            ("ply", Format::Ply),
            ("stl", Format::Stl),
            ("xyz", Format::Xyz),
            ("csv", Format::Csv),
            ("npy", Format::Npy),
            ("voronoi_json", Format::VoronoiJson),
            ("domains_json", Format::DomainsJson),
            ("svg", Format::Svg),
            ("html", Format::Html),
        ];
        let format = choice("format", format, &formats)?;
        if !attributes.is_empty() {
            require_attributes(py, &path, format)?;
        }
        let attributes = vertex_attributes(py, &attributes)?;
        detached_on_file(py, &path, || write_file_with(&self.mesh, &attributes, &path, format))
    }
}

/// Refuses a format that would leave the attributes out.
fn require_attributes(py: Python<'_>, path: &Path, format: Format) -> PyResult<()> {
    let format = format.resolve_output(path).map_err(|error| exception(py, &error))?;
    if format.holds_attributes() {
        return Ok(());
    }
    let message = format!(
        "{}: {} holds no attributes; VTU, TetGen, Gmsh, PLY, CSV, NumPy and HTML files do",
        path.display(),
        format.name()
    );
    Err(invalid(py, message))
}

/// Returns values at the vertices as attributes, under names that the library allows.
fn vertex_attributes(
    py: Python<'_>,
    given: &[(String, PyReadonlyArray2<'_, f64>)],
) -> PyResult<Vec<Attribute>> {
    let attribute = |(name, values): &(String, PyReadonlyArray2<'_, f64>)| {
        let components = values.as_array().dim().1;
        let values = values.as_slice()?.to_vec();
        Attribute::check_name(name).map_err(|error| exception(py, &error))?;
        Ok(Attribute { name: name.clone(), components, values, is_extended: false })
    };
    given.iter().map(attribute).collect()
}

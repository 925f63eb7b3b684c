//! Options by keyword.

use crate::errors::invalid;
use netmesh::{
    Algorithm, Criterion, Crossings, Extent, GivesWay, Interior, NetOrdering, Options, Output,
};
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The defaults, but for the options that are given.
pub fn options(given: &Bound<'_, PyDict>) -> PyResult<Options> {
    let mut options = Options::default();
    for (name, value) in given {
        let name: String = name.extract()?;
        set(&mut options, &name, &value)?;
    }
    Ok(options)
}

fn set(options: &mut Options, name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    match name {
        "output" => {
            let names =
                [("hierarchical", Output::Hierarchical), ("well_spaced", Output::WellSpaced)];
            options.output = choice(name, value, &names)?;
        }
        "algorithm" => {
            let names = [
                ("netmesh", Algorithm::Netmesh),
                ("svr", Algorithm::Svr),
                ("delaunay", Algorithm::Delaunay),
            ];
            options.algorithm = choice(name, value, &names)?;
        }
        "ordering" => {
            let names = [
                ("sampled_net", NetOrdering::SampledNet),
                ("deterministic_net", NetOrdering::DeterministicNet),
            ];
            options.ordering = choice(name, value, &names)?;
        }
        "criterion" => {
            let names = [
                ("voronoi_aspect", Criterion::VoronoiAspect),
                ("radius_edge", Criterion::RadiusEdge),
            ];
            options.criterion = choice(name, value, &names)?;
        }
        "extent" => {
            let names = [
                ("all", Extent::All),
                ("hull", Extent::Hull),
                ("box", Extent::Box),
                ("boundary", Extent::Boundary),
            ];
            options.extent = choice(name, value, &names)?;
        }
        "crossings" => {
            let names = [("refuse", Crossings::Refuse), ("split", Crossings::Split)];
            options.crossings = choice(name, value, &names)?;
        }
        "interior" => {
            let names = [
                ("auto", Interior::Auto),
                ("seeds", Interior::Seeds),
                ("parity", Interior::Parity),
                ("winding", Interior::Winding),
            ];
            options.interior = choice(name, value, &names)?;
        }
        "threads" => options.threads = whole(name, value, u32::MAX)?,
        "quality_bound" => options.quality_bound = number(name, value)?,
        "epsilon" => options.epsilon = number(name, value)?,
        "delta" => options.delta = number(name, value)?,
        "gamma" => options.gamma = number(name, value)?,
        "yield_radius" => options.yield_radius = number(name, value)?,
        "encroachment" => options.encroachment = number(name, value)?,
        "cage_scale" => options.cage_scale = number(name, value)?,
        "root_scale" => options.root_scale = number(name, value)?,
        "distance_ratio" => options.distance_ratio = number(name, value)?,
        "seed" => options.seed = whole(name, value, u64::MAX)?,
        "max_vertices" => options.max_vertices = whole(name, value, u64::MAX)?,
        "min_angle" => options.min_angle = number(name, value)?,
        "instruments" => options.instruments = value.is_truthy()?,
        "min_dihedral" => options.min_dihedral = number(name, value)?,
        "max_edge" => options.max_edge = number(name, value)?,
        // They are no numbers alone: see `sizes`.
        "size" | "background" => {}
        "gives_way" => {
            let names = [("angle", GivesWay::Angle), ("bound", GivesWay::Bound)];
            options.gives_way = choice(name, value, &names)?;
        }
        _ => return Err(PyTypeError::new_err(format!("there is no option {name}"))),
    }
    Ok(())
}

/// One of the values that have names.
pub fn choice<T: Copy>(name: &str, value: &Bound<'_, PyAny>, names: &[(&str, T)]) -> PyResult<T> {
    let text = value.extract::<String>().ok();
    if let Some((_, found)) = names.iter().find(|(known, _)| Some(*known) == text.as_deref()) {
        return Ok(*found);
    }
    let known: Vec<String> = names.iter().map(|(known, _)| format!("'{known}'")).collect();
    let message = format!("{name} is {}; it must be {}", value.repr()?, known.join(" or "));
    Err(invalid(value.py(), message))
}

/// A double.
pub fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    value.extract().map_err(|_| wrong_type(name, value, "a number"))
}

/// A whole number from 0 to `largest`.
pub fn whole<'py, T>(name: &str, value: &Bound<'py, PyAny>, largest: T) -> PyResult<T>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr> + std::fmt::Display,
{
    value.extract().map_err(|error: PyErr| {
        if error.is_instance_of::<PyOverflowError>(value.py()) {
            let message = format!("{name} is {value}; it must be 0 to {largest}");
            return invalid(value.py(), message);
        }
        wrong_type(name, value, "a whole number")
    })
}

fn wrong_type(name: &str, value: &Bound<'_, PyAny>, wanted: &str) -> PyErr {
    let kind = value.get_type().name().map_or_else(|_| "unknown".into(), |name| name.to_string());
    PyTypeError::new_err(format!("{name} is of type {kind}; it must be {wanted}"))
}

//! Options by keyword.

use crate::errors::{self, invalid};
use netmesh::error::Choice;
use netmesh::{
    Algorithm, Criterion, Crossings, Extent, GivesWay, Interior, NetOrdering, Options, Output,
};
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

// The words for values of options.
const OUTPUTS: [(&str, Output); 3] = [
    ("auto", Output::Auto),
    ("hierarchical", Output::Hierarchical),
    ("well_spaced", Output::WellSpaced),
];
const ALGORITHMS: [(&str, Algorithm); 3] =
    [("netmesh", Algorithm::Netmesh), ("svr", Algorithm::Svr), ("delaunay", Algorithm::Delaunay)];
const ORDERINGS: [(&str, NetOrdering); 2] = [
    ("sampled_net", NetOrdering::SampledNet),
    ("deterministic_net", NetOrdering::DeterministicNet),
];
const CRITERIA: [(&str, Criterion); 2] =
    [("voronoi_aspect", Criterion::VoronoiAspect), ("radius_edge", Criterion::RadiusEdge)];
const EXTENTS: [(&str, Extent); 5] = [
    ("auto", Extent::Auto),
    ("all", Extent::All),
    ("hull", Extent::Hull),
    ("box", Extent::Box),
    ("boundary", Extent::Boundary),
];
const CROSSINGS: [(&str, Crossings); 2] =
    [("refuse", Crossings::Refuse), ("split", Crossings::Split)];
const INTERIORS: [(&str, Interior); 4] = [
    ("auto", Interior::Auto),
    ("seeds", Interior::Seeds),
    ("parity", Interior::Parity),
    ("winding", Interior::Winding),
];
const GIVE_WAYS: [(&str, GivesWay); 2] = [("angle", GivesWay::Angle), ("bound", GivesWay::Bound)];

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
        "output" => options.output = choice(name, value, &OUTPUTS)?,
        "algorithm" => options.algorithm = choice(name, value, &ALGORITHMS)?,
        "ordering" => options.ordering = choice(name, value, &ORDERINGS)?,
        "criterion" => options.criterion = choice(name, value, &CRITERIA)?,
        "extent" => options.extent = choice(name, value, &EXTENTS)?,
        "crossings" => options.crossings = choice(name, value, &CROSSINGS)?,
        "interior" => options.interior = choice(name, value, &INTERIORS)?,
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
        "gives_way" => options.gives_way = choice(name, value, &GIVE_WAYS)?,
        _ => return Err(PyTypeError::new_err(format!("there is no option {name}"))),
    }
    Ok(())
}

/// Returns options by keyword, with the words of Python for their values.
pub fn by_keyword<'py>(py: Python<'py>, options: &Options) -> PyResult<Bound<'py, PyDict>> {
    let by_name = PyDict::new(py);
    by_name.set_item("output", word(&OUTPUTS, options.output))?;
    by_name.set_item("algorithm", word(&ALGORITHMS, options.algorithm))?;
    by_name.set_item("ordering", word(&ORDERINGS, options.ordering))?;
    by_name.set_item("criterion", word(&CRITERIA, options.criterion))?;
    by_name.set_item("threads", options.threads)?;
    by_name.set_item("quality_bound", options.quality_bound)?;
    by_name.set_item("epsilon", options.epsilon)?;
    by_name.set_item("delta", options.delta)?;
    by_name.set_item("gamma", options.gamma)?;
    by_name.set_item("yield_radius", options.yield_radius)?;
    by_name.set_item("encroachment", options.encroachment)?;
    by_name.set_item("cage_scale", options.cage_scale)?;
    by_name.set_item("root_scale", options.root_scale)?;
    by_name.set_item("seed", options.seed)?;
    by_name.set_item("max_vertices", options.max_vertices)?;
    by_name.set_item("instruments", options.instruments)?;
    by_name.set_item("distance_ratio", options.distance_ratio)?;
    by_name.set_item("min_angle", options.min_angle)?;
    by_name.set_item("min_dihedral", options.min_dihedral)?;
    by_name.set_item("max_edge", options.max_edge)?;
    by_name.set_item("gives_way", word(&GIVE_WAYS, options.gives_way))?;
    by_name.set_item("extent", word(&EXTENTS, options.extent))?;
    by_name.set_item("crossings", word(&CROSSINGS, options.crossings))?;
    by_name.set_item("interior", word(&INTERIORS, options.interior))?;
    Ok(by_name)
}

/// Returns an option with its value, as a caller writes it.
pub fn keyword_argument(choice: Choice) -> String {
    let (name, word) = match choice {
        Choice::Output(value) => ("output", word(&OUTPUTS, value)),
        Choice::Algorithm(value) => ("algorithm", word(&ALGORITHMS, value)),
        Choice::Criterion(value) => ("criterion", word(&CRITERIA, value)),
        Choice::Extent(value) => ("extent", word(&EXTENTS, value)),
        Choice::Crossings(value) => ("crossings", word(&CROSSINGS, value)),
        Choice::Interior(value) => ("interior", word(&INTERIORS, value)),
    };
    format!("{name}='{word}'")
}

/// Returns the word for a value.
fn word<T: Copy + PartialEq>(names: &[(&'static str, T)], value: T) -> &'static str {
    names.iter().find(|(_, known)| *known == value).map_or("", |(word, _)| word)
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

pub fn wrong_type(name: &str, value: &Bound<'_, PyAny>, wanted: &str) -> PyErr {
    let kind = value.get_type().name().map_or_else(|_| "unknown".into(), |name| name.to_string());
    errors::wrong_type(value.py(), format!("{name} is of type {kind}; it must be {wanted}"))
}

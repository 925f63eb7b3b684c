//! The options `size`, a number, a value for each point, or a function, and `background`, values at
//! the vertices of another mesh.

use crate::core::Core;
use crate::errors::{OfPython, exception, in_default_environment, invalid, raised, wrong_type};
use crate::options;
use netmesh::options::SizeFn;
use netmesh::{Error, Mesh};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat};
use std::sync::{Mutex, PoisonError};

/// Source of sizes during a run. Values for the points are the mesh's own.
pub enum Sizes {
    Given,
    Constant(f64),
    Function(Function),
}

/// A callable of Python.
pub struct Function {
    callable: Py<PyAny>,
    environment: OfPython,
    /// Exception that the callable has raised.
    exception: Mutex<Option<PyErr>>,
}

impl Sizes {
    /// Takes the options `size` and `background` of `given`; values for the points and on a
    /// background go to `mesh`.
    pub fn new(mesh: &mut Mesh, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        let py = given.py();
        if let Some(background) = given.get_item("background")?.filter(|it| !it.is_none()) {
            set_background(mesh, &background)?;
        }
        let Some(size) = given.get_item("size")?.filter(|size| !size.is_none()) else {
            return Ok(Self::Given);
        };
        if size.is_callable() {
            let function = Function {
                callable: size.unbind(),
                environment: OfPython::current(),
                exception: Mutex::default(),
            };
            return Ok(Self::Function(function));
        }
        if let Ok(size) = size.extract::<f64>() {
            return match in_default_environment(|| size > 0.0) {
                true => Ok(Self::Constant(size)),
                false => Err(invalid(py, format!("size is {size}; it must be above 0"))),
            };
        }
        let values = values_of("size", &size, mesh.inputs().count(), "points")?;
        let values = values.as_slice()?;
        in_default_environment(|| mesh.set_sizes(values))
            .map_err(|error| named("size", py, &error))?;
        Ok(Self::Given)
    }

    /// Calls `run` with what the library asks.
    pub fn with<T>(&self, run: impl FnOnce(Option<&SizeFn<'_>>) -> T) -> T {
        match self {
            Self::Given => run(None),
            Self::Constant(size) => run(Some(&|_| *size)),
            Self::Function(function) => run(Some(&|x| function.at(x))),
        }
    }

    /// Returns the exception that ended a run.
    pub fn exception(self) -> Option<PyErr> {
        match self {
            Self::Function(function) => {
                function.exception.into_inner().unwrap_or_else(PoisonError::into_inner)
            }
            _ => None,
        }
    }
}

/// Takes the option `background`, a pair of a mesh and an array.
fn set_background(mesh: &mut Mesh, background: &Bound<'_, PyAny>) -> PyResult<()> {
    let py = background.py();
    let pair = background.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>().ok();
    let core = |other: &Bound<'_, PyAny>| other.getattr("_core").ok()?.extract::<Py<Core>>().ok();
    let Some((core, values)) = pair.and_then(|(other, values)| Some((core(&other)?, values)))
    else {
        let wanted = "a Mesh and values at its vertices, as a pair";
        return Err(options::wrong_type("background", background, wanted));
    };
    let other = core.get().triangulation();
    let values = values_of("background", &values, other.vertex_count(), "vertices of it")?;
    let values = values.as_slice()?;
    let set = in_default_environment(|| mesh.set_background(Some((other, values))));
    set.map_err(|error| named("background", py, &error))
}

/// Returns the exception for an error that the library says of `values`, by Python's name for them.
fn named(name: &str, py: Python<'_>, error: &Error) -> PyErr {
    match error.message().strip_prefix("values") {
        Some(rest) => raised(py, error.kind(), format!("{name}{rest}")),
        None => exception(py, error),
    }
}

/// Returns an array with `count` doubles, one after the other.
fn values_of<'py>(
    name: &str,
    given: &Bound<'py, PyAny>,
    count: usize,
    things: &str,
) -> PyResult<PyReadonlyArray1<'py, f64>> {
    let numpy = given.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (given, "float64"))?;
    let shape = array.getattr("shape")?;
    if shape.extract::<(usize,)>().ok() != Some((count,)) {
        let message = format!(
            "{name} has shape {shape}; it must have one value for each of {count} {things}"
        );
        return Err(invalid(given.py(), message));
    }
    numpy.call_method1("ascontiguousarray", (array,))?.extract()
}

/// Returns the number that a function has answered at the point `x`.
fn size_of_answer(answer: &Bound<'_, PyAny>, x: &Bound<'_, PyArray1<f64>>) -> PyResult<f64> {
    // Interpolators answer with an array of one element, of which Python makes no float without a
    // warning.
    let has_axes = || answer.getattr("ndim").is_ok_and(|ndim| ndim.gt(0).unwrap_or(false));
    let size = match answer.is_instance_of::<PyFloat>() || !has_axes() {
        true => answer.extract(),
        false => answer.call_method0("item").and_then(|element| element.extract()),
    };
    if let Ok(size) = size {
        return Ok(size);
    }
    let message = format!("size answered {} at {x}; it must be a number", answer.repr()?);
    Err(wrong_type(answer.py(), message))
}

impl Function {
    /// Returns the size at a point; NaN after an exception, which ends the run.
    fn at(&self, x: &[f64]) -> f64 {
        let ask = |py: Python<'_>| {
            let x = PyArray1::from_slice(py, x);
            let answer = self.callable.bind(py).call1((&x,))?;
            size_of_answer(&answer, &x)
        };
        self.environment.call(|| Python::attach(ask)).unwrap_or_else(|raised| {
            *self.exception.lock().unwrap_or_else(PoisonError::into_inner) = Some(raised);
            f64::NAN
        })
    }
}

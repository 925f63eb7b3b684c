//! The library's errors as Python's exceptions, and Python's locks let go while the library works.

use netmesh::{Error, ErrorKind, Result};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The class in `netmesh._errors` for a kind of error.
fn class(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::NullArgument | ErrorKind::InvalidArgument => "InvalidArgumentError",
        ErrorKind::NonFinite => "NonFiniteError",
        ErrorKind::Dimension => "DimensionError",
        ErrorKind::Capacity => "CapacityError",
        ErrorKind::DegenerateInput => "DegenerateInputError",
        ErrorKind::Limit => "LimitError",
        ErrorKind::Cancelled => "CancelledError",
        ErrorKind::Io => "FileError",
        ErrorKind::Format => "FormatError",
        ErrorKind::State => "StateError",
        ErrorKind::OutOfMemory => "OutOfMemoryError",
        ErrorKind::Panic => "InternalError",
    }
}

/// The exception for an error. Its message names options and what selects as Python's callers do.
pub fn exception(py: Python<'_>, error: &Error) -> PyErr {
    let structs = ["options.", "selection."];
    let name = structs.iter().find_map(|name| error.message().strip_prefix(name));
    let message = name.unwrap_or(error.message());
    raised(py, error.kind(), message.to_owned())
}

pub fn invalid(py: Python<'_>, message: String) -> PyErr {
    raised(py, ErrorKind::InvalidArgument, message)
}

pub fn raised(py: Python<'_>, kind: ErrorKind, message: String) -> PyErr {
    let class = py.import("netmesh._errors").and_then(|errors| errors.getattr(class(kind)));
    match class.and_then(|class| class.call1((&message,))) {
        Ok(exception) => PyErr::from_value(exception),
        Err(_) => PyRuntimeError::new_err(message),
    }
}

/// Does work of the library that other threads of Python need not wait for. A panic, which is a
/// defect of the library, becomes an exception too.
pub fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T> + Send) -> PyResult<T> {
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    let done = done.unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<&str>().copied();
        let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        let message = format!("an internal check failed: {}", text.unwrap_or("no message"));
        Err(Error::new(ErrorKind::Panic, message))
    });
    done.map_err(|error| exception(py, &error))
}

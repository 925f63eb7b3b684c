//! The library's errors as Python's exceptions, and Python's locks let go while the library works.

use crate::options::keyword_argument;
use netmesh::error::{Name, Words};
use netmesh::{Error, ErrorKind, Region, Result};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

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

/// The words of Python for what the library's messages name.
struct InPython<'a> {
    regions: &'a [Region],
}

impl Words for InPython<'_> {
    fn write(&self, name: Name, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match name {
            Name::Chosen(choice) => f.write_str(&keyword_argument(choice)),
            Name::Size | Name::Sizes => f.write_str("size"),
            Name::Background => f.write_str("background"),
            Name::SizeAt(at) => write!(f, "size[{at}]"),
            Name::BackgroundSizeAt(at) => write!(f, "background[1][{at}]"),
            Name::Interpolation => f.write_str("interpolation"),
            Name::Seed(number) => {
                let (is_hole, at) = Region::number_among_its_kind(self.regions, number as usize);
                write!(f, "{}[{at}]", if is_hole { "holes" } else { "regions" })
            }
            Name::SelectedDomain => f.write_str("domain"),
            other => match other.option() {
                Some(option) => f.write_str(option),
                None => write!(f, "{other}"),
            },
        }
    }
}

/// The exception for an error.
pub fn exception(py: Python<'_>, error: &Error) -> PyErr {
    exception_with(py, error, &[])
}

/// The exception for an error of a mesh with `regions`.
pub fn exception_with(py: Python<'_>, error: &Error, regions: &[Region]) -> PyErr {
    raised(py, error.kind(), error.in_words(InPython { regions }).to_string())
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
    unlocked(py, work).map_err(|error| exception(py, &error))
}

/// As [`detached`], with the error of the library.
pub fn unlocked<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T> + Send) -> Result<T> {
    py.detach(|| caught(work))
}

/// How long a signal may wait.
const PATIENCE: Duration = Duration::from_millis(30);

/// As [`detached`], for work that the library cannot stop: a thread of its own does it, and goes on
/// when a signal ends the wait for it.
pub fn abandonable<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let (sender, mut receiver) = mpsc::channel();
    // Nobody may be left to receive it.
    let worker = move || drop(sender.send(caught(work)));
    if let Err(error) = thread::Builder::new().spawn(worker) {
        return Err(raised(py, ErrorKind::OutOfMemory, format!("cannot start a thread: {error}")));
    }
    loop {
        let received;
        (received, receiver) = py.detach(move || (receiver.recv_timeout(PATIENCE), receiver));
        match received {
            Ok(done) => return done.map_err(|error| exception(py, &error)),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(RecvTimeoutError::Disconnected) => {
                let message = "an internal check failed: a thread has no result";
                return Err(raised(py, ErrorKind::Panic, message.into()));
            }
        }
    }
}

fn caught<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<&str>().copied();
        let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        let message = format!("an internal check failed: {}", text.unwrap_or("no message"));
        Err(Error::new(ErrorKind::Panic, message))
    })
}

//! The library's errors as Python's exceptions, and Python's locks let go while the library works.

use netmesh::capi::shared::Environment;
use netmesh::{Error, ErrorKind, Result};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
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

/// Does work of the library that other threads of Python need not wait for, in the default
/// floating-point environment. A panic, which is a defect of the library, becomes an exception too.
pub fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T> + Send) -> PyResult<T> {
    py.detach(|| caught(work)).map_err(|error| exception(py, &error))
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

/// Does work of the library in the default floating-point environment, whatever a shared object or
/// the program has set, and restores the thread's own.
pub fn in_default_environment<T>(work: impl FnOnce() -> T) -> T {
    Environment::DEFAULT.run(work)
}

/// The floating-point environment of Python, in which its functions are called during work.
#[derive(Clone, Copy)]
pub struct OfPython(Environment);

impl OfPython {
    /// Returns the calling thread's.
    pub fn current() -> Self {
        Self(Environment::current())
    }

    /// Calls a function of Python's.
    pub fn call<T>(self, function: impl FnOnce() -> T) -> T {
        self.0.run(function)
    }
}

fn caught<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
    let work = || in_default_environment(work);
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<&str>().copied();
        let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        let message = format!("an internal check failed: {}", text.unwrap_or("no message"));
        Err(Error::new(ErrorKind::Panic, message))
    })
}

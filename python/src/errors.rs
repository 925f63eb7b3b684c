//! The library's errors as Python's exceptions, and Python's locks let go while the library works.

use netmesh::query::Stop;
use netmesh::{Error, ErrorKind, Result};
use pyo3::call::PyCallArgs;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
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

/// The exception for an argument whose type is wrong.
pub fn wrong_type(py: Python<'_>, message: String) -> PyErr {
    of_class(py, "ArgumentTypeError", (&message,), &message)
}

pub fn raised(py: Python<'_>, kind: ErrorKind, message: String) -> PyErr {
    of_class(py, class(kind), (&message,), &message)
}

fn of_class<'py>(
    py: Python<'py>,
    name: &str,
    arguments: impl PyCallArgs<'py>,
    message: &str,
) -> PyErr {
    let class = py.import("netmesh._errors").and_then(|errors| errors.getattr(name));
    match class.and_then(|class| class.call1(arguments)) {
        Ok(exception) => PyErr::from_value(exception),
        Err(_) => PyRuntimeError::new_err(message.to_owned()),
    }
}

/// The number of an error of input or output for which the system gave none: EIO everywhere.
const EIO: i32 = 5;

/// The exception for an error of work on the file `path`: Python's callers find the system's number
/// and the path in it.
fn exception_of_file(py: Python<'_>, error: &Error, path: &Path) -> PyErr {
    if error.kind() != ErrorKind::Io {
        return exception(py, error);
    }
    let message = error.message();
    let arguments = (error.system_code().unwrap_or(EIO), message, path.as_os_str());
    of_class(py, class(ErrorKind::Io), arguments, message)
}

/// Does work of the library that other threads of Python need not wait for. A panic, which is a
/// defect of the library, becomes an exception too.
pub fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T> + Send) -> PyResult<T> {
    py.detach(|| caught(work)).map_err(|error| exception(py, &error))
}

/// As [`detached`], for work on the file `path`.
pub fn detached_on_file<T: Send>(
    py: Python<'_>,
    path: &Path,
    work: impl FnOnce() -> Result<T> + Send,
) -> PyResult<T> {
    py.detach(|| caught(work)).map_err(|error| exception_of_file(py, &error, path))
}

/// How long a signal may wait.
const PATIENCE: Duration = Duration::from_millis(30);

/// As [`detached`], for work that ends soon after what it is given is set: a thread of its own does
/// it, and a signal ends it, however long it would take.
pub fn stoppable<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Stop<'_>) -> Result<T> + Send,
) -> PyResult<T> {
    let switch = &AtomicBool::new(false);
    let mut signal = Ok(());
    let done = py.detach(|| {
        let (sender, receiver) = mpsc::channel();
        thread::scope(|scope| {
            let worker = move || drop(sender.send(caught(|| work(Stop::new(switch)))));
            thread::Builder::new().spawn_scoped(scope, worker).map_err(|_| no_thread())?;
            loop {
                match receiver.recv_timeout(PATIENCE) {
                    Ok(done) => return done,
                    Err(RecvTimeoutError::Disconnected) => return Err(no_result()),
                    Err(RecvTimeoutError::Timeout) if signal.is_ok() => {
                        signal = Python::attach(|py| py.check_signals());
                        switch.store(signal.is_err(), Ordering::Relaxed);
                    }
                    Err(RecvTimeoutError::Timeout) => (),
                }
            }
        })
    });
    signal?;
    done.map_err(|error| exception(py, &error))
}

/// What a worker ends with that the system has no room for.
fn no_thread() -> Error {
    Error::new(ErrorKind::OutOfMemory, "cannot start a thread")
}

fn no_result() -> Error {
    Error::new(ErrorKind::Panic, "an internal check failed: a thread has no result")
}

/// As [`detached`], for work that the library cannot stop: a thread of its own does it, and goes on
/// when a signal ends the wait for it.
pub fn abandonable<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> PyResult<T> {
    abandonable_until(py, |_| work())
}

/// As [`abandonable`], for work that also ends soon after what it is given is set, which a signal
/// does.
pub fn abandonable_until<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(Stop<'_>) -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let (sender, mut receiver) = mpsc::channel();
    let switch = Arc::new(AtomicBool::new(false));
    let of_worker = Arc::clone(&switch);
    // Nobody may be left to receive it.
    let worker = move || drop(sender.send(caught(|| work(Stop::new(&of_worker)))));
    if thread::Builder::new().spawn(worker).is_err() {
        return Err(exception(py, &no_thread()));
    }
    loop {
        let received;
        (received, receiver) = py.detach(move || (receiver.recv_timeout(PATIENCE), receiver));
        match received {
            Ok(done) => return done.map_err(|error| exception(py, &error)),
            Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| {
                switch.store(true, Ordering::Relaxed);
            })?,
            Err(RecvTimeoutError::Disconnected) => return Err(exception(py, &no_result())),
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

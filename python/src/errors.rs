//! The library's errors as Python's exceptions, and Python's locks let go while the library works.

use netmesh::capi::shared::Environment;
use netmesh::error::{Name, Words};
use netmesh::options::Chosen;
use netmesh::query::Stop;
use netmesh::{Error, ErrorKind, Region, Result};
use pyo3::call::PyCallArgs;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// Returns the class in `netmesh._errors` for a kind of error.
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
            Name::Chosen(choice) => {
                let Chosen { option, word, .. } = choice.chosen();
                write!(f, "{option}='{}'", word.word)
            }
            Name::Size | Name::Sizes => f.write_str("size"),
            Name::Background => f.write_str("background"),
            Name::SizeAt(at) => write!(f, "size[{at}]"),
            Name::BackgroundSizeAt(at) => write!(f, "background[1][{at}]"),
            Name::Interpolation => f.write_str("interpolation"),
            Name::Seed(number) => {
                let (is_hole, at) = Region::number_among_its_kind(self.regions, number as usize);
                write!(f, "{}[{at}]", if is_hole { "holes" } else { "regions" })
            }
            Name::Triangle(at) => write!(f, "facets[{at}]"),
            Name::SelectedDomain => f.write_str("domain"),
            other => match other.option() {
                Some(option) => f.write_str(option),
                None => write!(f, "{other}"),
            },
        }
    }
}

/// Returns the exception for an error.
pub fn exception(py: Python<'_>, error: &Error) -> PyErr {
    exception_with(py, error, &[])
}

/// Returns the exception for an error of a mesh with `regions`.
pub fn exception_with(py: Python<'_>, error: &Error, regions: &[Region]) -> PyErr {
    raised(py, error.kind(), error.in_words(InPython { regions }).to_string())
}

pub fn invalid(py: Python<'_>, message: String) -> PyErr {
    raised(py, ErrorKind::InvalidArgument, message)
}

/// Returns the exception for an argument whose type is wrong.
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

/// Returns the exception for an error of work on the file `path`: Python's callers find the
/// system's number and the path in it.
fn exception_of_file(py: Python<'_>, error: &Error, path: &Path) -> PyErr {
    if error.kind() != ErrorKind::Io {
        return exception(py, error);
    }
    let message = error.message();
    let arguments = (error.system_code().unwrap_or(EIO), message, path.as_os_str());
    of_class(py, class(ErrorKind::Io), arguments, message)
}

/// Does work of the library that other threads of Python need not wait for, in the default
/// floating-point environment. A panic, which is a defect of the library, becomes an exception too.
pub fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T> + Send) -> PyResult<T> {
    unlocked(py, work).map_err(|error| exception(py, &error))
}

/// Does work as [`detached`] does, and answers the error of the library.
pub fn unlocked<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T> + Send) -> Result<T> {
    py.detach(|| caught(work))
}

/// Does work on the file `path` as [`detached`] does; the exception has the path.
pub fn detached_on_file<T: Send>(
    py: Python<'_>,
    path: &Path,
    work: impl FnOnce() -> Result<T> + Send,
) -> PyResult<T> {
    py.detach(|| caught(work)).map_err(|error| exception_of_file(py, &error, path))
}

/// Time that a signal may have to wait.
const PATIENCE: Duration = Duration::from_millis(30);

/// The most results that [`stoppable`] computes on the thread that asks. A thread takes longer to
/// start than a hundred points to locate.
const FEW: usize = 256;

/// Questions after which work for [`FEW`] results goes on elsewhere: some milliseconds.
const QUESTIONS: u32 = 1 << 13;

/// Does work for `results` that a signal ends: a thread of its own does it, and it must end soon
/// after the stop that it is given is set. Where there are few and they take little work, the
/// thread that asks does it. Otherwise as [`detached`].
pub fn stoppable<T: Send>(
    py: Python<'_>,
    results: usize,
    mut work: impl FnMut(Stop<'_>) -> Result<T> + Send,
) -> PyResult<T> {
    if results <= FEW {
        let left = AtomicU32::new(QUESTIONS);
        let done = unlocked(py, || work(Stop::after(&left)));
        if left.into_inner() > 0 {
            return done.map_err(|error| exception(py, &error));
        }
    }
    stoppable_elsewhere(py, work)
}

/// Does work as [`stoppable`] does, on a thread of its own.
fn stoppable_elsewhere<T: Send>(
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

/// Returns the error of a worker that the system has no room for.
fn no_thread() -> Error {
    Error::new(ErrorKind::OutOfMemory, "cannot start a thread")
}

fn no_result() -> Error {
    Error::new(ErrorKind::Panic, "an internal check failed: a thread has no result")
}

/// Does work that the library cannot stop: a thread of its own does it, and goes on when a signal
/// ends the wait for it. Otherwise as [`detached`].
pub fn abandonable<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> PyResult<T> {
    abandonable_until(py, |_| work())
}

/// Does work as [`abandonable`] does, which ends soon after the stop that it is given is set. A
/// signal sets it.
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

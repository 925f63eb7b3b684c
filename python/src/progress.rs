//! Progress of a run, and the ways to stop it: the caller's function, its exception, a signal.

use crate::errors::OfPython;
use netmesh::Phase;
use pyo3::prelude::*;

/// Report of a run's progress.
#[pyclass(frozen, get_all, module = "netmesh")]
pub struct Progress {
    /// `'prepare'`, `'insert'`, `'finish'` or `'export'`.
    phase: &'static str,
    /// The fraction that is done, from 0 to 1 and never falling; -1 if unknown.
    fraction: f64,
    /// Distinct inputs that are vertices by now.
    inputs_inserted: u64,
    /// Vertices by now, inputs included.
    vertices: u64,
    /// Simplices by now.
    simplices: u64,
}

#[pymethods]
impl Progress {
    fn __repr__(&self) -> String {
        let Self { phase, fraction, inputs_inserted, vertices, simplices } = self;
        format!(
            "Progress(phase='{phase}', fraction={fraction:.3}, \
             inputs_inserted={inputs_inserted}, vertices={vertices}, simplices={simplices})"
        )
    }
}

impl From<&netmesh::Progress> for Progress {
    fn from(progress: &netmesh::Progress) -> Self {
        let &netmesh::Progress { phase, fraction, inputs_inserted, vertices, simplices } = progress;
        let phase = match phase {
            Phase::Prepare => "prepare",
            Phase::Insert => "insert",
            Phase::Finish => "finish",
            Phase::Export => "export",
        };
        Self { phase, fraction, inputs_inserted, vertices, simplices }
    }
}

/// Caller's function that a run reports its progress to, and what it has raised.
pub struct Reporter {
    callback: Option<Py<PyAny>>,
    environment: OfPython,
    /// Why the run was stopped, if not by the callback's answer.
    pub exception: Option<PyErr>,
}

impl Reporter {
    pub fn new(callback: Option<Py<PyAny>>) -> Self {
        Self { callback, environment: OfPython::current(), exception: None }
    }

    /// Reports progress; returns true if the run shall go on.
    pub fn report(&mut self, progress: &netmesh::Progress) -> bool {
        let asked = self.environment.call(|| Python::attach(|py| self.ask(py, progress)));
        asked.unwrap_or_else(|exception| {
            self.exception = Some(exception);
            false
        })
    }

    /// Asks the caller's function. A signal that has arrived is handled first: Ctrl-C raises
    /// `KeyboardInterrupt`.
    fn ask(&self, py: Python<'_>, progress: &netmesh::Progress) -> PyResult<bool> {
        py.check_signals()?;
        let Some(callback) = &self.callback else { return Ok(true) };
        let answer = callback.bind(py).call1((Progress::from(progress),))?;
        Ok(answer.is_none() || answer.is_truthy()?)
    }
}

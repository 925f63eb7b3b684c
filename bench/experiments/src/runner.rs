//! Runs of netmesh with limits, and many runs in two threads.

use netmesh::{Algorithm, ErrorKind, Mesh, Options, Triangulation};
use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::inputs::Points;

/// A run that ended in time and in size, or why it did not.
pub enum Outcome {
    Done(Box<Mesh>),
    /// In the words of a table's cell.
    Stopped(&'static str),
}

impl Outcome {
    pub fn mesh(&self) -> Option<&Triangulation> {
        match self {
            Outcome::Done(mesh) => mesh.triangulation(),
            Outcome::Stopped(_) => None,
        }
    }
}

/// Meshes `points` within `limit`.
pub fn mesh(points: &Points, options: &Options, limit: Duration) -> Outcome {
    let begun = Instant::now();
    let mut mesh = Mesh::new(points.dim, points.len(), &points.coordinates, 0)
        .unwrap_or_else(|error| panic!("{error}"));
    match mesh.run(options, Some(&mut |_| begun.elapsed() < limit)) {
        Ok(()) => Outcome::Done(Box::new(mesh)),
        Err(error) if error.kind() == ErrorKind::Cancelled => Outcome::Stopped("timeout"),
        Err(error) if error.kind() == ErrorKind::Limit => Outcome::Stopped("too large"),
        // A defect of the library, and no figure to put into a table.
        Err(error) => panic!("{error}"),
    }
}

/// SVR's size grows with the logarithm of the spread: let no run eat the others' time.
pub fn svr(largest: u64) -> Options {
    Options { algorithm: Algorithm::Svr, max_vertices: largest, ..Options::default() }
}

/// The least seconds of each variant: other work on the machine can only add to them. The variants
/// take turns, so that a machine whose speed drifts does not favour one.
pub fn least_seconds(turns: usize, variants: &mut [&mut dyn FnMut() -> f64]) -> Vec<f64> {
    let mut seconds = vec![Vec::new(); variants.len()];
    for _ in 0..turns {
        for (variant, times) in variants.iter_mut().zip(&mut seconds) {
            times.push(variant());
        }
    }
    seconds.iter().map(|times| times.iter().copied().fold(f64::NAN, f64::min)).collect()
}

/// The results of `work` for each of `tasks`, in their order, at most `jobs` at a time.
pub fn in_parallel<T: Send, R: Send>(
    jobs: usize,
    tasks: Vec<T>,
    work: impl Fn(T) -> R + Sync,
) -> Vec<R> {
    let count = tasks.len();
    let queue = Mutex::new(tasks.into_iter().enumerate().collect::<VecDeque<_>>());
    let results = Mutex::new((0..count).map(|_| None).collect::<Vec<Option<R>>>());
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
    std::thread::scope(|scope| {
        for _ in 0..jobs.min(count) {
            scope.spawn(|| {
                while let Some((index, task)) = next() {
                    let result = work(task);
                    results.lock().unwrap_or_else(PoisonError::into_inner)[index] = Some(result);
                }
            });
        }
    });
    let results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.into_iter().map(|result| result.expect("every task was run")).collect()
}

/// The most memory that the process has held so far, in bytes; nothing where the system does not
/// say so.
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024 * kib)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs;

    #[test]
    fn results_keep_the_order_of_their_tasks() {
        for jobs in [1, 2, 9] {
            let results = in_parallel(jobs, (0..20).collect(), |i: u64| {
                std::thread::sleep(Duration::from_micros(500 * (20 - i)));
                i * i
            });
            assert_eq!(results, (0..20).map(|i| i * i).collect::<Vec<_>>());
        }
    }

    #[test]
    fn limits_stop_a_run() {
        let points = inputs::uniform(2, 20_000, 1);
        let stopped = mesh(&points, &Options::default(), Duration::ZERO);
        assert!(matches!(stopped, Outcome::Stopped("timeout")));
        let small = Options { max_vertices: 20_001, ..Options::default() };
        let stopped = mesh(&points, &small, Duration::from_secs(60));
        assert!(matches!(stopped, Outcome::Stopped("too large")));
    }

    #[test]
    fn variants_take_turns() {
        let order = std::cell::RefCell::new(Vec::new());
        let mut times = [3.0, 2.0, 4.0].into_iter();
        let mut a = || {
            order.borrow_mut().push('a');
            times.next().unwrap()
        };
        let mut b = || {
            order.borrow_mut().push('b');
            5.0
        };
        assert_eq!(least_seconds(3, &mut [&mut a, &mut b]), [2.0, 5.0]);
        assert_eq!(order.into_inner(), ['a', 'b', 'a', 'b', 'a', 'b']);
    }
}

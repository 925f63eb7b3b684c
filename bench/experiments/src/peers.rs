//! The other meshers. Each input is a process of its own with a limit of time and of memory, since
//! they crash, hang and exit.

use crate::inputs::Points;
use crate::simplicial::Simplicial;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

const MEMORY_MIB: u64 = 6144;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Peer {
    TetGen,
    Mesh2,
    Triangle,
    /// CGAL's plain Delaunay triangulation.
    CgalDelaunay,
}

impl Peer {
    pub fn name(self) -> &'static str {
        match self {
            Peer::TetGen => "TetGen",
            Peer::Mesh2 => "CGAL Mesh_2",
            Peer::Triangle => "Triangle",
            Peer::CgalDelaunay => "CGAL Delaunay",
        }
    }

    fn argument(self) -> &'static str {
        match self {
            Peer::TetGen => "tetgen",
            Peer::Mesh2 => "mesh_2",
            Peer::Triangle => "triangle",
            Peer::CgalDelaunay => "delaunay",
        }
    }
}

/// Returns the peers that mesh in `dim` dimensions with a bound.
pub fn meshers(dim: usize) -> &'static [Peer] {
    match dim {
        2 => &[Peer::Mesh2, Peer::Triangle],
        3 => &[Peer::TetGen],
        _ => &[],
    }
}

pub enum PeerOutcome {
    Done {
        mesh: Simplicial,
        seconds: f64,
    },
    /// "crashed", "timeout", "failed": a cell of a table.
    Failed(String),
    /// The program is not there.
    Absent,
}

/// Places of the peers.
#[derive(Clone, Debug, Default)]
pub struct Peers {
    /// The program that this package's CMake target builds.
    pub program: Option<PathBuf>,
    /// A Python that has the module `triangle`, and the script that calls it.
    pub triangle: Option<(PathBuf, PathBuf)>,
    pub scratch: PathBuf,
    pub limit: Duration,
}

impl Peers {
    pub fn has(&self, peer: Peer) -> bool {
        match peer {
            Peer::Triangle => self.triangle.is_some(),
            _ => self.program.is_some(),
        }
    }

    /// Meshes the points in a box of three times their bounding box, to the radius-edge bound.
    pub fn mesh(&self, peer: Peer, points: &Points, bound: f64) -> PeerOutcome {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let Some(mut command) = self.command(peer) else { return PeerOutcome::Absent };
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let file =
            |kind: &str| self.scratch.join(format!("{}-{number}.{kind}", std::process::id()));
        let (input, output) = (file("points"), file("mesh"));
        let bytes: Vec<u8> = points.coordinates.iter().flat_map(|x| x.to_le_bytes()).collect();
        std::fs::write(&input, bytes)
            .unwrap_or_else(|error| panic!("{}: {error}", input.display()));
        command.arg(points.dim.to_string()).arg(bound.to_string()).arg(MEMORY_MIB.to_string());
        command.arg(&input).arg(&output).stdin(Stdio::null()).stdout(Stdio::null());
        command.stderr(Stdio::null());
        let outcome = match run(&mut command, self.limit) {
            Ok(()) => read_mesh(points.dim, &output),
            Err(why) => PeerOutcome::Failed(why.to_string()),
        };
        for path in [input, output] {
            // There is nothing to remove if the peer wrote nothing.
            let _ = std::fs::remove_file(path);
        }
        outcome
    }

    fn command(&self, peer: Peer) -> Option<Command> {
        let mut command = match peer {
            Peer::Triangle => {
                let (python, script) = self.triangle.as_ref()?;
                let mut command = Command::new(python);
                command.arg(script);
                command
            }
            _ => Command::new(self.program.as_ref()?),
        };
        command.arg(peer.argument());
        Some(command)
    }
}

/// Waits for the end of `command`, at most `limit`.
fn run(command: &mut Command, limit: Duration) -> Result<(), &'static str> {
    let mut child = command.spawn().map_err(|_| "failed")?;
    let status = wait(&mut child, limit).ok_or("timeout")?;
    match status.code() {
        Some(0) => Ok(()),
        Some(_) => Err("failed"),
        None => Err("crashed"),
    }
}

fn wait(child: &mut Child, limit: Duration) -> Option<std::process::ExitStatus> {
    let begun = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Some(status),
            Ok(None) if begun.elapsed() < limit => std::thread::sleep(Duration::from_millis(5)),
            _ => {
                let _ = child.kill();
                let _ = child.wait();
                return None;
            }
        }
    }
}

/// Little-endian: seconds; the number of vertices and their coordinates; the number of simplices
/// and their ids.
fn read_mesh(dim: usize, path: &Path) -> PeerOutcome {
    let parsed = std::fs::read(path).ok().and_then(|bytes| parse(dim, &bytes));
    parsed.unwrap_or_else(|| PeerOutcome::Failed("failed".to_string()))
}

fn parse(dim: usize, bytes: &[u8]) -> Option<PeerOutcome> {
    let word = |at: usize| bytes.get(at..at + 8)?.try_into().ok();
    let seconds = f64::from_le_bytes(word(0)?);
    let vertices = u64::from_le_bytes(word(8)?) as usize;
    let points_end = vertices.checked_mul(8 * dim)?.checked_add(16)?;
    let points = bytes.get(16..points_end)?;
    let simplices = u64::from_le_bytes(word(points_end)?) as usize;
    let ids = bytes.get(points_end + 8..)?;
    if ids.len() != simplices.checked_mul(4 * (dim + 1))? {
        return None;
    }
    let mesh = Simplicial {
        dim,
        points: points
            .chunks_exact(8)
            .map(|x| f64::from_le_bytes(x.try_into().expect("8")))
            .collect(),
        simplices: ids
            .chunks_exact(4)
            .map(|v| u32::from_le_bytes(v.try_into().expect("4")))
            .collect(),
    };
    mesh.simplices.iter().all(|&v| (v as usize) < vertices).then_some(())?;
    Some(PeerOutcome::Done { mesh, seconds })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    fn shell(script: &str, limit: Duration) -> Result<(), &'static str> {
        run(Command::new("sh").args(["-c", script]), limit)
    }

    #[cfg(unix)]
    #[test]
    fn ends_of_processes_are_told_apart() {
        let long = Duration::from_secs(20);
        assert_eq!(shell("exit 0", long), Ok(()));
        assert_eq!(shell("exit 3", long), Err("failed"));
        assert_eq!(shell("kill -SEGV $$", long), Err("crashed"));
        assert_eq!(shell("exec sleep 30", Duration::from_millis(50)), Err("timeout"));
    }

    #[test]
    fn meshes_are_read_whole_or_not_at_all() {
        let mut bytes = 0.5f64.to_le_bytes().to_vec();
        bytes.extend(3u64.to_le_bytes());
        bytes.extend([0.0, 0.0, 1.0, 0.0, 0.0, 1.0].iter().flat_map(|x: &f64| x.to_le_bytes()));
        bytes.extend(1u64.to_le_bytes());
        bytes.extend([0u32, 1, 2].iter().flat_map(|v| v.to_le_bytes()));
        let Some(PeerOutcome::Done { mesh, seconds }) = parse(2, &bytes) else { panic!("refused") };
        assert_eq!((seconds, mesh.points.len(), mesh.simplices), (0.5, 6, vec![0, 1, 2]));
        assert!((0..bytes.len()).all(|length| parse(2, &bytes[..length]).is_none()));
        *bytes.last_mut().unwrap() = 1;
        assert!(parse(2, &bytes).is_none(), "an id beyond the vertices");
    }

    #[test]
    fn what_is_not_there_is_absent() {
        let points = crate::inputs::uniform(2, 10, 1);
        let none = Peers::default();
        assert!(!none.has(Peer::Triangle));
        assert!(matches!(none.mesh(Peer::TetGen, &points, 2.0), PeerOutcome::Absent));
    }
}

//! The certificate of a mesh of several ranks: a checker that recomputes what must hold of it from
//! what each rank has, its points, simplices and ghosts. It shares neither code nor arithmetic with
//! what makes meshes or their parts; signs and radii are those of the core's certificate
//! ([`netmesh::validate::parts`]).
//!
//! - Level 1, topology: lengths and ids; each facet of an own simplex is that of the neighbour that
//!   it names, an own simplex or a ghost; each ghost is what its owner has under its id, and each
//!   rank has the whole star of each vertex of its own simplices; all ranks have the same
//!   coordinates, kind, domain, cage and owner of a vertex, and the same of a domain; stars are
//!   connected, links are spheres or balls, all is a ball by its Euler characteristic; the sizes of
//!   the whole are those of the parts.
//! - Level 2, geometry: all orientations are positive, no simplex is folded onto a neighbour, every
//!   facet is locally Delaunay, by both sides where it is between ranks, and the hull is closed and
//!   convex at every ridge, whoever has the two facets there. Exact for all finite coordinates.
//! - Level 3, the paper: inputs are vertices with their bits, duplicates those of the first; kinds;
//!   the domains are a tree of balls in balls, every vertex is in that of its label; cages are
//!   complete and near their spheres, no domain is encroached, union cells are bounded, whoever has
//!   the parts of a cage; a finished mesh has one domain; the bound of the run.
//!
//! Data that several ranks have is compared by them, or by a keeper that its ids choose: no rank
//! has the whole, and no rank's word is taken for another's.
//!
//! **Not checked** beside what the core's certificate checks: that simplices go round each face of
//! codimension two once, that all are connected, and that the hull is a sphere (levels 1 and 2). Of
//! level 3: that balls beside each other are disjoint, which follows if the centre of neither
//! encroaches the other, but where `encroachment` is below 2 `epsilon`; where `epsilon` is above
//! 0.8 `cage_scale` cells of meshes of several domains; and whatever has an edge of at most 2^-40
//! of its coordinates, where precision may be what limits a cell.

mod arrays;
mod cages;
mod complex;
mod domains;
mod exchange;
mod facets;
mod geometry;
mod ghosts;
mod hierarchy;
mod hull;
mod inputs;
mod limits;
mod links;
mod paper;
mod report;
mod totals;
mod vertices;

pub use netmesh::validate::ViolationKind;
pub use report::{Report, Violation};

use crate::agreement::{Arguments, require_same};
use crate::comm::{Communicator, agreed};
use crate::distributed::DistributedMesh;
use complex::Complex;
use netmesh::mesh::MIN_DIM;
use netmesh::{Error, Result};
use report::Findings;

/// The highest dimension of meshes of several ranks.
const MAX_DIM: usize = 3;

/// Collective. Checks levels `1..=level` (1 topology, 2 geometry, 3 the paper). All ranks answer
/// one report.
///
/// Accepts any contents of `mesh`, however broken. Level 2 and 3 are checked only where level 1
/// holds; level 3 also where level 2 does not. O(m log m) for the m simplices and ghosts of a rank;
/// all that it knows of its vertices goes to others once.
///
/// # Errors
/// `InvalidArgument`, the same on all ranks: `level` is not 1, 2 or 3 or not the same on all ranks,
/// or the mesh is none of these ranks. `OutOfMemory`.
pub fn validate(comm: &dyn Communicator, mesh: &DistributedMesh, level: u32) -> Result<Report> {
    require_same(comm, "", || {
        check_arguments(comm, mesh, level)?;
        let arguments = Arguments::of_call("nm_mpi_validate").and("level", level);
        Ok(arguments.and("the mesh's dimension", mesh.dim))
    })?;
    agreed(comm, || match mesh.dim {
        2 => check::<2>(comm, mesh, level),
        _ => check::<3>(comm, mesh, level),
    })
}

fn check_arguments(comm: &dyn Communicator, mesh: &DistributedMesh, level: u32) -> Result<()> {
    let invalid = |message: String| Err(Error::invalid(message));
    if !(1..=3).contains(&level) {
        return invalid(format!("level is {level}; it must be 1, 2 or 3"));
    }
    let (rank, ranks) = (comm.rank(), comm.size());
    if (mesh.rank, mesh.ranks) != (rank, ranks) {
        let (found, of) = (mesh.rank, mesh.ranks);
        return invalid(format!("the mesh is that of rank {found} of {of}, not {rank} of {ranks}"));
    }
    if !(MIN_DIM..=MAX_DIM).contains(&mesh.dim) {
        return invalid(format!("dim is {}; it must be {MIN_DIM} or {MAX_DIM}", mesh.dim));
    }
    Ok(())
}

/// Collective. Checks the levels one after another, of which all ranks tell each other.
fn check<const D: usize>(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    level: u32,
) -> Result<Report> {
    let mut report = Report::default();
    let mut findings = Findings::default();
    let complex = check_topology(comm, mesh, &mut findings)?;
    if findings.of_all(comm)?.enter(&mut report) {
        report.level = 1;
    }
    let Some(complex) = complex.filter(|_| report.level == 1) else { return Ok(report) };
    if level >= 2 {
        let mut findings = Findings::default();
        geometry::check::<D>(&complex, &mut findings)?;
        if findings.clean_everywhere(comm)? {
            hull::check::<D>(comm, &complex, &mut findings)?;
        }
        if findings.of_all(comm)?.enter(&mut report) {
            report.level = 2;
        }
    }
    if level >= 3 {
        let mut findings = Findings::default();
        inputs::check(comm, &complex, &mut findings)?;
        paper::check_kinds(&complex, &mut findings);
        let is_limited = limits::vertices::<D>(&complex)?;
        if let Some(hierarchy) = hierarchy::check::<D>(comm, &complex, &mut findings)? {
            cages::check(comm, &complex, &hierarchy, &is_limited, &mut findings)?;
        }
        paper::check_cells::<D>(&complex, &is_limited, &mut findings)?;
        if findings.of_all(comm)?.enter(&mut report) && report.level == 2 {
            report.level = 3;
        }
    }
    Ok(report)
}

/// Collective. Checks level 1. Returns the simplices that a rank knows, where its arrays hold on
/// all ranks.
fn check_topology<'a>(
    comm: &dyn Communicator,
    mesh: &'a DistributedMesh,
    findings: &mut Findings,
) -> Result<Option<Complex<'a>>> {
    arrays::check(mesh, findings)?;
    if !findings.clean_everywhere(comm)? {
        return Ok(None);
    }
    totals::check_ids(comm, mesh, findings)?;
    ghosts::check(comm, mesh, findings)?;
    // What is broken there is broken wherever a ghost is looked at.
    if !findings.clean_everywhere(comm)? {
        return Ok(None);
    }
    let complex = Complex::new(mesh)?;
    let kept = vertices::check(comm, &complex, findings)?;
    totals::check_vertices(comm, mesh, kept, findings)?;
    domains::check(comm, mesh, findings)?;
    facets::check(&complex, findings);
    if findings.clean_everywhere(comm)? {
        links::check(comm, &complex, findings)?;
    }
    Ok(Some(complex))
}

//! Certificate of `--validate`: all of it holds, or the exit code is 7.

use crate::exit_code::{ExitCode, Failure};
use crate::numbers::counted;
use netmesh::Mesh;
use netmesh::surface::Surface;
use netmesh::validate::{Report, validate_mesh};

/// Topology, geometry and the paper's promises.
const LEVEL: u32 = 3;

pub fn check(mesh: &Mesh) -> Result<Report, Failure> {
    Ok(validate_mesh(mesh, LEVEL)?)
}

/// Checks the triangulation and the surface in it.
pub fn check_surface(mesh: &Mesh, surface: &Surface) -> Result<Report, Failure> {
    let triangulation = mesh.result()?;
    Ok(surface.validate(mesh.inputs(), triangulation)?)
}

pub fn holds(report: &Report) -> bool {
    report.violations == 0 && report.level == LEVEL
}

/// Fails unless the certificate holds; names the first violation.
pub fn require(report: &Report) -> Result<(), Failure> {
    if holds(report) {
        return Ok(());
    }
    let first = report.first.as_ref().map_or("none is named", |first| &first.message);
    let message = format!(
        "the certificate is violated: level {} of {LEVEL} holds, {}, the first: {first}",
        report.level,
        counted(report.violations, "violation", "violations")
    );
    Err(Failure::new(ExitCode::CertificateViolated, message))
}

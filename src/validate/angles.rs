//! Level 3: no tetrahedron with all vertices in one domain has a smaller dihedral angle than was
//! asked for, but those that the run says it has left.

use super::boundary::Promised;
use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::AllocResult;
use crate::quality::slivers::survey;
use crate::quality::view::View;

pub(super) fn check<const D: usize>(
    view: View<'_, D>,
    promised: Promised<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let asked = view.mesh.parameters.min_dihedral;
    let left = &view.mesh.below_min_dihedral;
    survey(view, asked, |simplex, angle, is_of_one_domain| {
        if !promised.includes(simplex) {
            return;
        }
        let is_left = left.binary_search(&(simplex as u32)).is_ok();
        findings.check(is_left || !is_of_one_domain, || {
            let message = message!(
                "simplex {simplex} has a dihedral angle of {angle} degrees, below {asked}"
            );
            Violation::new(ViolationKind::DihedralAngle, message).simplex(simplex)
        });
    })
}

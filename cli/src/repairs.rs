//! Repairs of the input's surface before anything else is done with it: those that were asked for,
//! and polygons as triangles where there is no mesh without that.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::input::Input;
use crate::numbers::counted;
use crate::{holes, merging, part, standard};
use netmesh::io::Merged;
use netmesh::{Error, ErrorKind, HoleFilling, Mesh};
use std::fmt::{Display, Formatter};

/// Results of the repairs; `None` where one was not asked for.
pub struct Repairs {
    pub merged: Option<Merged>,
    pub triangulated: Option<Split>,
    pub closed: Option<HoleFilling>,
}

impl Repairs {
    /// Returns a line about each repair that was asked for, with its label.
    pub fn lines(&self, arguments: &Arguments) -> impl Iterator<Item = (&'static str, String)> {
        let ratio = arguments.merge.unwrap_or_default();
        let merged = self.merged.as_ref().map(|merged| ("merged", merging::told(merged, ratio)));
        let triangulated = self.triangulated.as_ref().map(|split| ("split", split.to_string()));
        let closed = self.closed.as_ref().map(|closed| ("holes", holes::told(closed)));
        merged.into_iter().chain(triangulated).chain(closed)
    }
}

/// Polygons that have become triangles.
pub struct Split {
    pub polygons: usize,
    reason: Reason,
}

enum Reason {
    Asked,
    /// Other files have triangles.
    Mixed,
    /// The polygon with this number is not plane.
    Bent(u32),
}

impl Display for Split {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} split into triangles", counted(self.polygons as u64, "polygon", "polygons"))?;
        match self.reason {
            Reason::Asked => Ok(()),
            Reason::Mixed => write!(f, ", as the other facets are"),
            Reason::Bent(facet) => write!(f, ": facets[{facet}] is not plane"),
        }
    }
}

/// Repairs what was read.
pub fn repair(input: &mut Input, arguments: &Arguments) -> Result<Repairs, Failure> {
    let triangulated = triangulate(&mut input.mesh, input.mixed, arguments)?;
    let closed = holes::close(&mut input.mesh, arguments)?;
    Ok(Repairs { merged: input.merged.take(), triangulated, closed })
}

/// Makes triangles of polygons if that is asked for, or if one is not plane; `mixed` have become
/// some as they were read. A diagnosis tells of polygons that have no triangles as they are.
fn triangulate(
    mesh: &mut Mesh,
    mixed: usize,
    arguments: &Arguments,
) -> Result<Option<Split>, Failure> {
    let name = standard::input_name(&arguments.input);
    let refused = |error: Error| Failure::reading(&name, &error.of_content());
    if mesh.given_facets().count() == 0 {
        return match arguments.triangulate {
            true => Err(Failure::new(
                ExitCode::Usage,
                format!("{name}: has no facets; --triangulate is for surfaces"),
            )),
            false => Ok(None),
        };
    }
    if arguments.triangulate {
        let polygons = mesh.triangulate_facets().map_err(refused)? + mixed;
        return Ok(Some(Split { polygons, reason: Reason::Asked }));
    }
    if mixed > 0 {
        return Ok(Some(Split { polygons: mixed, reason: Reason::Mixed }));
    }
    let coplanar = part::options(arguments, mesh).coplanar;
    let Some(facet) = mesh.bent_polygon(coplanar)? else { return Ok(None) };
    match mesh.triangulate_facets() {
        Ok(polygons) => Ok(Some(Split { polygons, reason: Reason::Bent(facet) })),
        Err(error)
            if error.kind() == ErrorKind::InvalidArgument && arguments.diagnose.is_some() =>
        {
            Ok(None)
        }
        Err(error) => {
            let Failure { code, message } = refused(error);
            let why =
                format!("polygons have to become triangles, since facets[{facet}] is not plane");
            Err(Failure::new(code, format!("{message}; {why}")))
        }
    }
}

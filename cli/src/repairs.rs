//! Repairs of the input's surface before anything else is done with it: those that were asked for,
//! and polygons as triangles where there is no mesh without that.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::input::{self, Input, Mixed};
use crate::numbers::counted;
use crate::origins::InFiles;
use crate::words::CommandLine;
use crate::{holes, merging, part, standard};
use netmesh::io::Merged;
use netmesh::{Feature, HoleFilling};
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
    /// Number of these without an area, each of which is one triangle without one.
    pub without_area: usize,
    pub reason: Reason,
}

/// Reason why polygons have become triangles, or have not.
pub enum Reason {
    Asked,
    /// Other files have triangles.
    Mixed,
    /// The polygon with this name is not plane.
    Bent(String),
    /// A diagnosis tells of polygons that have no triangles as they are.
    Refused {
        refusal: String,
        /// Number of triangles of other files that have a corner twice, and are left out.
        without_corners: usize,
    },
}

impl Reason {
    /// Returns the word for it in a record.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Asked => "asked",
            Self::Mixed => "other triangles",
            Self::Bent(_) => "not plane",
            Self::Refused { .. } => "refused",
        }
    }
}

impl Display for Split {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let polygons = counted(self.polygons as u64, "polygon", "polygons");
        match (&self.reason, self.polygons) {
            (Reason::Asked, 0) => return f.write_str("nothing, as all facets are triangles"),
            (Reason::Refused { .. }, 0) => f.write_str("nothing")?,
            _ => write!(f, "{polygons} split into triangles")?,
        }
        if self.without_area > 0 {
            write!(f, ", {} of them without an area", self.without_area)?;
        }
        match &self.reason {
            Reason::Asked => Ok(()),
            Reason::Mixed => write!(f, ", as the other facets are"),
            Reason::Bent(facet) => write!(f, ": {facet} is not plane"),
            Reason::Refused { refusal, without_corners: 0 } => write!(f, "; {refusal}"),
            Reason::Refused { refusal, without_corners } => {
                let triangles = counted(*without_corners as u64, "triangle", "triangles");
                write!(f, "; {refusal}; {triangles} with a corner twice left out")
            }
        }
    }
}

/// Repairs what was read.
pub fn repair(input: &mut Input, arguments: &Arguments) -> Result<Repairs, Failure> {
    let triangulated = triangulate(input, arguments)?;
    let closed = holes::close(&mut input.mesh, arguments)?;
    Ok(Repairs { merged: input.merged.take(), triangulated, closed })
}

/// Makes triangles of polygons if that is asked for, or if one is not plane; some may have become
/// triangles as they were read.
fn triangulate(input: &mut Input, arguments: &Arguments) -> Result<Option<Split>, Failure> {
    let Input { mesh, origins, mixed, .. } = input;
    if mesh.given_facets().count() == 0 {
        let name = standard::input_name(&arguments.input);
        return match arguments.triangulate {
            true => Err(Failure::new(
                ExitCode::Usage,
                format!("{name}: has no facets; --triangulate is for surfaces"),
            )),
            false => Ok(None),
        };
    }
    let Mixed { polygons, without_area, without_corners, refusal } = std::mem::take(mixed);
    if let Some(refusal) = refusal {
        let reason = Reason::Refused { refusal, without_corners };
        return Ok(Some(Split { polygons, without_area, reason }));
    }
    let coplanar = part::options(arguments, mesh).coplanar;
    let bent = match arguments.triangulate || polygons > 0 {
        true => None,
        false => mesh.bent_polygon(coplanar)?.map(|facet| origins.name(Feature::Facet(facet))),
    };
    let (reason, why) = match bent {
        _ if arguments.triangulate => (Reason::Asked, String::new()),
        _ if polygons > 0 => {
            return Ok(Some(Split { polygons, without_area, reason: Reason::Mixed }));
        }
        None => return Ok(None),
        Some(facet) => {
            let why = format!("; polygons have to become triangles, since {facet} is not plane");
            (Reason::Bent(facet), why)
        }
    };
    if mesh.given_facets().are_triangles {
        return Ok(Some(Split { polygons, without_area, reason }));
    }
    let before = polygons + mesh.given_facets().count();
    match mesh.split_facets() {
        Ok(made) => {
            origins.split(&made.parents);
            let without_area = without_area + made.without_area;
            Ok(Some(Split { polygons: before, without_area, reason }))
        }
        Err(error) => {
            let words = InFiles { words: CommandLine::default(), origins };
            let failure = Failure::reading_in(&input::names(arguments), &error.of_content(), words);
            let Failure { code, message } = failure;
            // The reason is there already where the polygon that is not plane has no triangles.
            let message = if message.contains(" is not plane") { message } else { message + &why };
            match code == ExitCode::InputRefused && arguments.diagnose.is_some() {
                true => {
                    let reason = Reason::Refused { refusal: message, without_corners: 0 };
                    Ok(Some(Split { polygons: 0, without_area: 0, reason }))
                }
                false => Err(Failure::new(code, message)),
            }
        }
    }
}

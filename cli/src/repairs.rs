//! Repairs of the input's surface before anything else is done with it, as they were asked for.

use crate::arguments::Arguments;
use crate::numbers::counted;
use crate::{holes, merging};
use netmesh::HoleFilling;
use netmesh::io::Merged;

/// Results of the repairs; `None` where one was not asked for.
pub struct Repairs {
    pub merged: Option<Merged>,
    /// Number of polygons that have become triangles.
    pub triangulated: Option<usize>,
    pub closed: Option<HoleFilling>,
}

impl Repairs {
    /// Returns a line about each repair that was asked for, with its label.
    pub fn lines(&self, arguments: &Arguments) -> impl Iterator<Item = (&'static str, String)> {
        let ratio = arguments.merge.unwrap_or_default();
        let merged = self.merged.as_ref().map(|merged| ("merged", merging::told(merged, ratio)));
        let triangulated = self.triangulated.map(|polygons| {
            let polygons = counted(polygons as u64, "polygon", "polygons");
            ("split", format!("{polygons} split into triangles"))
        });
        let closed = self.closed.as_ref().map(|closed| ("holes", holes::told(closed)));
        merged.into_iter().chain(triangulated).chain(closed)
    }
}

//! Arrays of a part that are made together, by one type for all of them: for callers that ask for
//! one array after the other.

use super::{Cells, Circumcenters, Facets, Hull, Lists, Part, Ridges};
use crate::error::Result;
use crate::memory::collected;

/// Which arrays: those of a group are made together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// [`Part::simplices`]: ids.
    Simplices,
    /// [`Part::edges`]: ids.
    Edges,
    /// [`Part::facets`]: ids of vertices, simplices.
    Facets,
    /// [`Part::hull`]: ids of vertices, simplices.
    Hull,
    /// [`Part::vertex_simplices`]: starts, ids.
    VertexSimplices,
    /// [`Part::vertex_neighbors`]: starts, ids.
    VertexNeighbors,
    /// [`Part::circumcenters`]: centers, radii.
    Circumcenters,
    /// [`Part::volumes`]: volumes.
    Volumes,
    /// [`Part::regions`]: starts, ids.
    Regions,
    /// [`Part::cells`]: volumes, shares.
    Cells,
    /// [`Part::ridges`] without the edges: starts, ids, is_bounded.
    Ridges,
}

/// Arrays by name; `None` for those that a group does not have, or that have been taken out.
#[derive(Debug, Default, PartialEq)]
pub struct Arrays {
    pub ids: Option<Vec<u32>>,
    pub simplices: Option<Vec<u32>>,
    pub starts: Option<Vec<usize>>,
    pub is_bounded: Option<Vec<bool>>,
    pub centers: Option<Vec<f64>>,
    pub radii: Option<Vec<f64>>,
    pub volumes: Option<Vec<f64>>,
    pub shares: Option<Vec<f64>>,
}

impl Arrays {
    /// Whether there is no array.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    fn of_ids(ids: Vec<u32>) -> Self {
        Self { ids: Some(ids), ..Self::default() }
    }

    fn of_facets(vertices: Vec<u32>, simplices: Vec<u32>) -> Self {
        Self { simplices: Some(simplices), ..Self::of_ids(vertices) }
    }

    fn of_lists(lists: Lists) -> Self {
        Self { starts: Some(lists.starts), ..Self::of_ids(lists.ids) }
    }
}

impl Part<'_> {
    /// The arrays of a group.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn group(&self, group: Group) -> Result<Arrays> {
        Ok(match group {
            Group::Simplices => Arrays::of_ids(collected(self.simplices())?),
            Group::Edges => Arrays::of_ids(self.edges()?),
            Group::Facets => {
                let Facets { vertices, simplices } = self.facets()?;
                Arrays::of_facets(vertices, simplices)
            }
            Group::Hull => {
                let Hull { vertices, simplices } = self.hull()?;
                Arrays::of_facets(vertices, simplices)
            }
            Group::VertexSimplices => Arrays::of_lists(self.vertex_simplices()?),
            Group::VertexNeighbors => Arrays::of_lists(self.vertex_neighbors()?),
            Group::Circumcenters => {
                let Circumcenters { centers, radii } = self.circumcenters()?;
                Arrays { centers: Some(centers), radii: Some(radii), ..Arrays::default() }
            }
            Group::Volumes => Arrays { volumes: Some(self.volumes()?), ..Arrays::default() },
            Group::Regions => Arrays::of_lists(self.regions()?),
            Group::Cells => {
                let Cells { volumes, shares, .. } = self.cells()?;
                Arrays { volumes: Some(volumes), shares: Some(shares), ..Arrays::default() }
            }
            Group::Ridges => {
                let Ridges { corners, is_bounded, .. } = self.ridges()?;
                Arrays { is_bounded: Some(is_bounded), ..Arrays::of_lists(corners) }
            }
        })
    }
}

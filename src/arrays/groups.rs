//! Groups of arrays that are made together, in one type for all groups: for callers that ask for
//! one array after the other.

use super::{Cells, Circumcenters, Facets, Hull, Lists, Part, Ridges};
use crate::error::Result;
use crate::memory::collected;

/// Group of arrays that are made together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Ids of [`Part::simplices`].
    Simplices,
    /// Ids of [`Part::edges`].
    Edges,
    /// Vertex ids and simplices of [`Part::facets`].
    Facets,
    /// Vertex ids and simplices of [`Part::hull`].
    Hull,
    /// Starts and ids of [`Part::vertex_simplices`].
    VertexSimplices,
    /// Starts and ids of [`Part::vertex_neighbors`].
    VertexNeighbors,
    /// Centres and radii of [`Part::circumcenters`].
    Circumcenters,
    /// Volumes of [`Part::volumes`].
    Volumes,
    /// Starts and ids of [`Part::regions`].
    Regions,
    /// Volumes and shares of [`Part::cells`].
    Cells,
    /// Starts, ids and `is_bounded` of [`Part::ridges`], without the edges.
    Ridges,
}

/// Arrays of a group by name; `None` for arrays that the group does not have, or that have been
/// taken out.
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
    /// Returns true if no array is left.
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
    /// Returns the arrays of a group.
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

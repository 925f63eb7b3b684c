//! The kinds of violations, with the values of the certificate's own enum.

use crate::certificate::Rule;

/// nm_mpi_report.kind: the rule that the first violation breaks. 1 to 99 are rules of level 1
/// (topology), 101 to 199 of level 2 (geometry), 201 to 299 of level 3 (the promises). A rule of
/// nm_violation has its value; those from 51 on are of what ranks have in common. Later versions may
/// append kinds.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_mpi_violation {
    /// Nothing was found broken.
    NM_MPI_VIOLATION_NONE = 0,
    /// An array does not have the length that the others ask for.
    NM_MPI_VIOLATION_ARRAY_LENGTH = 1,
    /// A coordinate is infinite or not a number.
    NM_MPI_VIOLATION_NON_FINITE = 2,
    /// A simplex names a vertex that does not exist.
    NM_MPI_VIOLATION_VERTEX_OUT_OF_RANGE = 3,
    /// A simplex names a vertex twice.
    NM_MPI_VIOLATION_REPEATED_VERTEX = 4,
    /// A vertex is in no simplex.
    NM_MPI_VIOLATION_UNUSED_VERTEX = 5,
    /// A simplex names a neighbour that is neither an own simplex nor a ghost.
    NM_MPI_VIOLATION_NEIGHBOR_OUT_OF_RANGE = 6,
    /// Two simplices have the same vertices.
    NM_MPI_VIOLATION_DUPLICATE_SIMPLEX = 7,
    /// A facet is in more than two simplices.
    NM_MPI_VIOLATION_OVERFULL_FACET = 8,
    /// A simplex shares a facet with another one but names no neighbour there.
    NM_MPI_VIOLATION_MISSING_NEIGHBOR = 9,
    /// A simplex names another neighbour than the one that shares its facet.
    NM_MPI_VIOLATION_NEIGHBOR_FACET = 11,
    /// The numbers of faces of each dimension do not add up to a ball's.
    NM_MPI_VIOLATION_EULER_CHARACTERISTIC = 13,
    /// The simplices round a vertex are not connected through facets at that vertex.
    NM_MPI_VIOLATION_VERTEX_STAR = 14,
    /// The link of a vertex is not a sphere, or on the hull a ball, by its Euler characteristic.
    NM_MPI_VIOLATION_VERTEX_LINK = 15,
    /// A hull ridge is not in exactly two hull facets.
    NM_MPI_VIOLATION_HULL_RIDGE = 16,
    /// Ids do not rise, or are out of range, or two ranks count them from different numbers.
    NM_MPI_VIOLATION_IDS = 51,
    /// Two ranks have different coordinates, kinds, domains or cages of a vertex.
    NM_MPI_VIOLATION_SHARED_VERTEX = 52,
    /// The owner of a vertex is not the lowest rank that has a simplex with it.
    NM_MPI_VIOLATION_VERTEX_OWNER = 53,
    /// A ghost is not what its owner has under its id, or shares no vertex with the rank.
    NM_MPI_VIOLATION_GHOST = 54,
    /// A simplex that shares a vertex with the rank is not among its ghosts.
    NM_MPI_VIOLATION_MISSING_GHOST = 55,
    /// The interface is not the facets whose neighbours are ghosts.
    NM_MPI_VIOLATION_INTERFACE = 56,
    /// The sizes of the whole mesh are not those of all parts.
    NM_MPI_VIOLATION_TOTALS = 57,
    /// Two ranks have different centres, radii or parents of a domain.
    NM_MPI_VIOLATION_SHARED_DOMAIN = 58,
    /// A simplex is flat or negatively oriented.
    NM_MPI_VIOLATION_ORIENTATION = 101,
    /// Two neighbours lie on the same side of the facet that they share.
    NM_MPI_VIOLATION_FOLDED_FACET = 102,
    /// The opposite vertex of a neighbour is strictly inside a simplex's circumball.
    NM_MPI_VIOLATION_DELAUNAY = 103,
    /// The hull is not convex at a ridge.
    NM_MPI_VIOLATION_NON_CONVEX_HULL = 104,
    /// An input's vertex does not exist, or is not that of the first of equal inputs.
    NM_MPI_VIOLATION_INPUT_VERTEX = 201,
    /// The vertex of a distinct input does not have that input's bits.
    NM_MPI_VIOLATION_INPUT_BITS = 202,
    /// A vertex's kind contradicts its id: those of inputs are below the number of inputs.
    NM_MPI_VIOLATION_VERTEX_KIND = 203,
    /// The domains are not a tree: the root is not the only one without a parent, or a ball is
    /// larger than its parent's.
    NM_MPI_VIOLATION_DOMAIN_TREE = 205,
    /// A domain's radius is not positive and finite.
    NM_MPI_VIOLATION_DOMAIN_BALL = 206,
    /// The vertex at a domain's centre is elsewhere, or not labelled as in that domain's subtree.
    NM_MPI_VIOLATION_DOMAIN_CENTER = 207,
    /// A domain's ball reaches out of its parent's.
    NM_MPI_VIOLATION_DOMAIN_OUTSIDE_PARENT = 208,
    /// A vertex is labelled with a domain that does not exist, or that does not contain it.
    NM_MPI_VIOLATION_VERTEX_DOMAIN = 210,
    /// A vertex's kind contradicts the cage that it is part of, or it is outside of that cage's
    /// domain.
    NM_MPI_VIOLATION_CAGE_OF = 211,
    /// A cage vertex is not near its cage's sphere.
    NM_MPI_VIOLATION_CAGE_RADIUS = 212,
    /// A cage has too few vertices to enclose its domain's centre.
    NM_MPI_VIOLATION_CAGE_INCOMPLETE = 213,
    /// A vertex on the hull is not of the root's cage.
    NM_MPI_VIOLATION_HULL_VERTEX = 214,
    /// An input inside a domain's ball encroaches its cage (Definition 2).
    NM_MPI_VIOLATION_INNER_ENCROACHMENT = 215,
    /// A vertex outside a domain's ball encroaches its cage (Definition 2).
    NM_MPI_VIOLATION_OUTER_ENCROACHMENT = 216,
    /// Simplices span more domains than un-encroached cages allow.
    NM_MPI_VIOLATION_DOMAIN_SPAN = 217,
    /// The Voronoi cell of a vertex has a worse aspect than the bound.
    NM_MPI_VIOLATION_VERTEX_ASPECT = 218,
    /// The union cell of a cage has a worse aspect than the bound.
    NM_MPI_VIOLATION_CAGE_ASPECT = 219,
    /// A simplex has a larger ratio of circumradius to shortest edge than the bound.
    NM_MPI_VIOLATION_RADIUS_EDGE = 220,
    /// A finished mesh has other domains than the root.
    NM_MPI_VIOLATION_NOT_FINISHED = 221,
}

impl From<Rule> for nm_mpi_violation {
    fn from(rule: Rule) -> Self {
        match rule {
            Rule::ArrayLength => Self::NM_MPI_VIOLATION_ARRAY_LENGTH,
            Rule::NonFinite => Self::NM_MPI_VIOLATION_NON_FINITE,
            Rule::VertexOutOfRange => Self::NM_MPI_VIOLATION_VERTEX_OUT_OF_RANGE,
            Rule::RepeatedVertex => Self::NM_MPI_VIOLATION_REPEATED_VERTEX,
            Rule::UnusedVertex => Self::NM_MPI_VIOLATION_UNUSED_VERTEX,
            Rule::NeighborOutOfRange => Self::NM_MPI_VIOLATION_NEIGHBOR_OUT_OF_RANGE,
            Rule::DuplicateSimplex => Self::NM_MPI_VIOLATION_DUPLICATE_SIMPLEX,
            Rule::OverfullFacet => Self::NM_MPI_VIOLATION_OVERFULL_FACET,
            Rule::MissingNeighbor => Self::NM_MPI_VIOLATION_MISSING_NEIGHBOR,
            Rule::NeighborFacet => Self::NM_MPI_VIOLATION_NEIGHBOR_FACET,
            Rule::EulerCharacteristic => Self::NM_MPI_VIOLATION_EULER_CHARACTERISTIC,
            Rule::VertexStar => Self::NM_MPI_VIOLATION_VERTEX_STAR,
            Rule::VertexLink => Self::NM_MPI_VIOLATION_VERTEX_LINK,
            Rule::HullRidge => Self::NM_MPI_VIOLATION_HULL_RIDGE,
            Rule::Ids => Self::NM_MPI_VIOLATION_IDS,
            Rule::SharedVertex => Self::NM_MPI_VIOLATION_SHARED_VERTEX,
            Rule::VertexOwner => Self::NM_MPI_VIOLATION_VERTEX_OWNER,
            Rule::Ghost => Self::NM_MPI_VIOLATION_GHOST,
            Rule::MissingGhost => Self::NM_MPI_VIOLATION_MISSING_GHOST,
            Rule::Interface => Self::NM_MPI_VIOLATION_INTERFACE,
            Rule::Totals => Self::NM_MPI_VIOLATION_TOTALS,
            Rule::SharedDomain => Self::NM_MPI_VIOLATION_SHARED_DOMAIN,
            Rule::Orientation => Self::NM_MPI_VIOLATION_ORIENTATION,
            Rule::FoldedFacet => Self::NM_MPI_VIOLATION_FOLDED_FACET,
            Rule::Delaunay => Self::NM_MPI_VIOLATION_DELAUNAY,
            Rule::NonConvexHull => Self::NM_MPI_VIOLATION_NON_CONVEX_HULL,
            Rule::InputVertex => Self::NM_MPI_VIOLATION_INPUT_VERTEX,
            Rule::InputBits => Self::NM_MPI_VIOLATION_INPUT_BITS,
            Rule::VertexKind => Self::NM_MPI_VIOLATION_VERTEX_KIND,
            Rule::DomainTree => Self::NM_MPI_VIOLATION_DOMAIN_TREE,
            Rule::DomainBall => Self::NM_MPI_VIOLATION_DOMAIN_BALL,
            Rule::DomainCenter => Self::NM_MPI_VIOLATION_DOMAIN_CENTER,
            Rule::DomainOutsideParent => Self::NM_MPI_VIOLATION_DOMAIN_OUTSIDE_PARENT,
            Rule::VertexDomain => Self::NM_MPI_VIOLATION_VERTEX_DOMAIN,
            Rule::CageOf => Self::NM_MPI_VIOLATION_CAGE_OF,
            Rule::CageRadius => Self::NM_MPI_VIOLATION_CAGE_RADIUS,
            Rule::CageIncomplete => Self::NM_MPI_VIOLATION_CAGE_INCOMPLETE,
            Rule::HullVertex => Self::NM_MPI_VIOLATION_HULL_VERTEX,
            Rule::InnerEncroachment => Self::NM_MPI_VIOLATION_INNER_ENCROACHMENT,
            Rule::OuterEncroachment => Self::NM_MPI_VIOLATION_OUTER_ENCROACHMENT,
            Rule::DomainSpan => Self::NM_MPI_VIOLATION_DOMAIN_SPAN,
            Rule::VertexAspect => Self::NM_MPI_VIOLATION_VERTEX_ASPECT,
            Rule::CageAspect => Self::NM_MPI_VIOLATION_CAGE_ASPECT,
            Rule::RadiusEdge => Self::NM_MPI_VIOLATION_RADIUS_EDGE,
            Rule::NotFinished => Self::NM_MPI_VIOLATION_NOT_FINISHED,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_have_the_values_of_the_rules() {
        for rule in Rule::ALL {
            assert_eq!(nm_mpi_violation::from(rule) as u32, rule as u32);
        }
    }
}

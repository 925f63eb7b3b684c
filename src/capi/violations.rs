//! The kinds of violations, with the values of the certificate's own enum.

use crate::validate::ViolationKind;

/// nm_report.kind: the rule that the first violation breaks. 1 to 99 are rules of level 1
/// (topology), 101 to 199 of level 2 (geometry), 201 to 299 of level 3 (the promises). Those from
/// 51 to 58 are of meshes on several ranks (netmesh_mpi.h). Later versions may append kinds.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_violation {
    /// Nothing was found broken.
    NM_VIOLATION_NONE = 0,
    /// An array does not have the length that the number of vertices or simplices asks for.
    NM_VIOLATION_ARRAY_LENGTH = 1,
    /// A coordinate is infinite or not a number.
    NM_VIOLATION_NON_FINITE = 2,
    /// A simplex names a vertex that does not exist.
    NM_VIOLATION_VERTEX_OUT_OF_RANGE = 3,
    /// A simplex names a vertex twice.
    NM_VIOLATION_REPEATED_VERTEX = 4,
    /// A vertex is in no simplex.
    NM_VIOLATION_UNUSED_VERTEX = 5,
    /// A simplex names a neighbour that does not exist.
    NM_VIOLATION_NEIGHBOR_OUT_OF_RANGE = 6,
    /// Two simplices have the same vertices.
    NM_VIOLATION_DUPLICATE_SIMPLEX = 7,
    /// A facet is in more than two simplices.
    NM_VIOLATION_OVERFULL_FACET = 8,
    /// A simplex shares a facet with another one but names no neighbour there.
    NM_VIOLATION_MISSING_NEIGHBOR = 9,
    /// A simplex names a neighbour that does not name it back.
    NM_VIOLATION_ASYMMETRIC_NEIGHBOR = 10,
    /// Two neighbours name each other, but not across the facet that they share.
    NM_VIOLATION_NEIGHBOR_FACET = 11,
    /// The simplices are not connected through facets.
    NM_VIOLATION_DISCONNECTED = 12,
    /// The numbers of faces of each dimension do not add up to a ball's.
    NM_VIOLATION_EULER_CHARACTERISTIC = 13,
    /// The simplices round a vertex are not connected through facets at that vertex.
    NM_VIOLATION_VERTEX_STAR = 14,
    /// The link of a vertex is not a sphere, or on the hull a ball, by its Euler characteristic.
    NM_VIOLATION_VERTEX_LINK = 15,
    /// The mesh has no hull facet, or a hull ridge is not in exactly two hull facets.
    NM_VIOLATION_HULL_RIDGE = 16,
    /// The hull is not connected.
    NM_VIOLATION_HULL_DISCONNECTED = 17,
    /// The hull facets round a vertex are not connected through ridges at that vertex.
    NM_VIOLATION_HULL_LINK = 18,
    /// The arrays of segments and regions do not fit each other or the mesh.
    NM_VIOLATION_BOUNDARY_ARRAYS = 19,
    /// The arrays of a domain that is cut out are not the first parts of those of the whole, or its
    /// subsegments are not those that are edges of its simplices.
    NM_VIOLATION_DOMAIN_ARRAYS = 20,
    /// Ids of a mesh on several ranks do not rise, are out of range, or are counted from different
    /// numbers by two ranks.
    NM_VIOLATION_IDS = 51,
    /// Two ranks have different coordinates, kinds, domains or cages of a vertex.
    NM_VIOLATION_SHARED_VERTEX = 52,
    /// The owner of a vertex is not the lowest rank that has a simplex with it.
    NM_VIOLATION_VERTEX_OWNER = 53,
    /// A ghost is not what its owner has under its id, or shares no vertex with the rank.
    NM_VIOLATION_GHOST = 54,
    /// A simplex that shares a vertex with the rank is not among its ghosts.
    NM_VIOLATION_MISSING_GHOST = 55,
    /// The interface is not the facets whose neighbours are ghosts.
    NM_VIOLATION_INTERFACE = 56,
    /// The sizes of the whole mesh are not those of all parts.
    NM_VIOLATION_TOTALS = 57,
    /// Two ranks have different centres, radii or parents of a domain.
    NM_VIOLATION_SHARED_DOMAIN = 58,
    /// A simplex is flat or negatively oriented.
    NM_VIOLATION_ORIENTATION = 101,
    /// Two neighbours lie on the same side of the facet that they share.
    NM_VIOLATION_FOLDED_FACET = 102,
    /// The opposite vertex of a neighbour is strictly inside a simplex's circumball.
    NM_VIOLATION_DELAUNAY = 103,
    /// The hull is not convex at a ridge.
    NM_VIOLATION_NON_CONVEX_HULL = 104,
    /// The simplices round a face of codimension two go round it more than once.
    NM_VIOLATION_WINDING = 105,
    /// A subsegment is no edge of the mesh.
    NM_VIOLATION_SUBSEGMENT_EDGE = 106,
    /// A vertex is strictly inside the circle of which a subsegment is a diameter.
    NM_VIOLATION_SUBSEGMENT_GABRIEL = 107,
    /// Subsegments do not lead from one end of a segment to the other, or go back on the way.
    NM_VIOLATION_SEGMENT_CHAIN = 108,
    /// A vertex on a segment is farther from it than rounding makes it.
    NM_VIOLATION_SEGMENT_LINE = 109,
    /// An input's vertex does not exist or has other coordinates.
    NM_VIOLATION_INPUT_VERTEX = 201,
    /// The vertex of a distinct input does not have that input's bits.
    NM_VIOLATION_INPUT_BITS = 202,
    /// A vertex's kind contradicts its id: vertices 0, 1, ... up to the number of distinct inputs
    /// are inputs, and no others are.
    NM_VIOLATION_VERTEX_KIND = 203,
    /// A plain Delaunay triangulation has domains, labels or vertices that are no inputs.
    NM_VIOLATION_PLAIN_DELAUNAY = 204,
    /// The domains are not a tree: domain 0 the only root, parents before their children.
    NM_VIOLATION_DOMAIN_TREE = 205,
    /// A domain's radius is not positive and finite, or its centre is no vertex.
    NM_VIOLATION_DOMAIN_BALL = 206,
    /// The vertex at a domain's centre is not labelled as in that domain's subtree.
    NM_VIOLATION_DOMAIN_CENTER = 207,
    /// A child's ball reaches outside its parent's.
    NM_VIOLATION_DOMAIN_OUTSIDE_PARENT = 208,
    /// The balls of two siblings overlap.
    NM_VIOLATION_DOMAINS_OVERLAP = 209,
    /// A vertex is labelled with a domain that does not exist, that does not contain it, or that
    /// has a child which contains it.
    NM_VIOLATION_VERTEX_DOMAIN = 210,
    /// A cage vertex's kind contradicts the domain that it is labelled with.
    NM_VIOLATION_CAGE_OF = 211,
    /// A cage vertex is not near the cage's sphere.
    NM_VIOLATION_CAGE_RADIUS = 212,
    /// A cage has too few vertices to enclose its domain's centre.
    NM_VIOLATION_CAGE_INCOMPLETE = 213,
    /// A vertex on the hull is not in the root's cage.
    NM_VIOLATION_HULL_VERTEX = 214,
    /// An input inside a domain's ball encroaches its cage (Definition 2).
    NM_VIOLATION_INNER_ENCROACHMENT = 215,
    /// A vertex outside a domain's ball encroaches its cage (Definition 2).
    NM_VIOLATION_OUTER_ENCROACHMENT = 216,
    /// Simplices span more levels of the hierarchy than un-encroached cages allow.
    NM_VIOLATION_DOMAIN_SPAN = 217,
    /// The Voronoi cell of a non-cage vertex has a worse aspect than the bound (Definition 4).
    NM_VIOLATION_VERTEX_ASPECT = 218,
    /// The union cell of a cage has a worse aspect than the bound (Definition 4).
    NM_VIOLATION_CAGE_ASPECT = 219,
    /// A simplex has a larger ratio of circumradius to shortest edge than the bound.
    NM_VIOLATION_RADIUS_EDGE = 220,
    /// A finished mesh has other domains than the root.
    NM_VIOLATION_NOT_FINISHED = 221,
    /// A tetrahedron with all vertices in one domain has a smaller dihedral angle than was asked
    /// for, and the run did not say so.
    NM_VIOLATION_DIHEDRAL_ANGLE = 222,
    /// A simplex that meets the box of the inputs is larger than nm_options.max_edge or
    /// nm_options.size asked for.
    NM_VIOLATION_SIMPLEX_SIZE = 223,
    /// Neighbours without a subsegment between them have different labels, the label of a region is
    /// not that of its seed, or a seed has no region of its own.
    NM_VIOLATION_REGION_LABEL = 224,
    /// The domain ends between two neighbours where no subsegment is.
    NM_VIOLATION_DOMAIN_END = 225,
    /// The domain has a region that is outside or a hole, or lacks one that is neither.
    NM_VIOLATION_DOMAIN_PLACE = 226,
    /// The simplices with one label have another area than the polygons about them.
    NM_VIOLATION_REGION_AREA = 227,
    /// A simplex is marked as forced by a small angle between segments, and is not.
    NM_VIOLATION_FORCED_SIMPLEX = 228,
}

impl From<ViolationKind> for nm_violation {
    fn from(kind: ViolationKind) -> Self {
        match kind {
            ViolationKind::None => Self::NM_VIOLATION_NONE,
            ViolationKind::ArrayLength => Self::NM_VIOLATION_ARRAY_LENGTH,
            ViolationKind::NonFinite => Self::NM_VIOLATION_NON_FINITE,
            ViolationKind::VertexOutOfRange => Self::NM_VIOLATION_VERTEX_OUT_OF_RANGE,
            ViolationKind::RepeatedVertex => Self::NM_VIOLATION_REPEATED_VERTEX,
            ViolationKind::UnusedVertex => Self::NM_VIOLATION_UNUSED_VERTEX,
            ViolationKind::NeighborOutOfRange => Self::NM_VIOLATION_NEIGHBOR_OUT_OF_RANGE,
            ViolationKind::DuplicateSimplex => Self::NM_VIOLATION_DUPLICATE_SIMPLEX,
            ViolationKind::OverfullFacet => Self::NM_VIOLATION_OVERFULL_FACET,
            ViolationKind::MissingNeighbor => Self::NM_VIOLATION_MISSING_NEIGHBOR,
            ViolationKind::AsymmetricNeighbor => Self::NM_VIOLATION_ASYMMETRIC_NEIGHBOR,
            ViolationKind::NeighborFacet => Self::NM_VIOLATION_NEIGHBOR_FACET,
            ViolationKind::Disconnected => Self::NM_VIOLATION_DISCONNECTED,
            ViolationKind::EulerCharacteristic => Self::NM_VIOLATION_EULER_CHARACTERISTIC,
            ViolationKind::VertexStar => Self::NM_VIOLATION_VERTEX_STAR,
            ViolationKind::VertexLink => Self::NM_VIOLATION_VERTEX_LINK,
            ViolationKind::HullRidge => Self::NM_VIOLATION_HULL_RIDGE,
            ViolationKind::HullDisconnected => Self::NM_VIOLATION_HULL_DISCONNECTED,
            ViolationKind::HullLink => Self::NM_VIOLATION_HULL_LINK,
            ViolationKind::Orientation => Self::NM_VIOLATION_ORIENTATION,
            ViolationKind::FoldedFacet => Self::NM_VIOLATION_FOLDED_FACET,
            ViolationKind::Delaunay => Self::NM_VIOLATION_DELAUNAY,
            ViolationKind::NonConvexHull => Self::NM_VIOLATION_NON_CONVEX_HULL,
            ViolationKind::Winding => Self::NM_VIOLATION_WINDING,
            ViolationKind::InputVertex => Self::NM_VIOLATION_INPUT_VERTEX,
            ViolationKind::InputBits => Self::NM_VIOLATION_INPUT_BITS,
            ViolationKind::VertexKind => Self::NM_VIOLATION_VERTEX_KIND,
            ViolationKind::PlainDelaunay => Self::NM_VIOLATION_PLAIN_DELAUNAY,
            ViolationKind::DomainTree => Self::NM_VIOLATION_DOMAIN_TREE,
            ViolationKind::DomainBall => Self::NM_VIOLATION_DOMAIN_BALL,
            ViolationKind::DomainCenter => Self::NM_VIOLATION_DOMAIN_CENTER,
            ViolationKind::DomainOutsideParent => Self::NM_VIOLATION_DOMAIN_OUTSIDE_PARENT,
            ViolationKind::DomainsOverlap => Self::NM_VIOLATION_DOMAINS_OVERLAP,
            ViolationKind::VertexDomain => Self::NM_VIOLATION_VERTEX_DOMAIN,
            ViolationKind::CageOf => Self::NM_VIOLATION_CAGE_OF,
            ViolationKind::CageRadius => Self::NM_VIOLATION_CAGE_RADIUS,
            ViolationKind::CageIncomplete => Self::NM_VIOLATION_CAGE_INCOMPLETE,
            ViolationKind::HullVertex => Self::NM_VIOLATION_HULL_VERTEX,
            ViolationKind::InnerEncroachment => Self::NM_VIOLATION_INNER_ENCROACHMENT,
            ViolationKind::OuterEncroachment => Self::NM_VIOLATION_OUTER_ENCROACHMENT,
            ViolationKind::DomainSpan => Self::NM_VIOLATION_DOMAIN_SPAN,
            ViolationKind::VertexAspect => Self::NM_VIOLATION_VERTEX_ASPECT,
            ViolationKind::CageAspect => Self::NM_VIOLATION_CAGE_ASPECT,
            ViolationKind::RadiusEdge => Self::NM_VIOLATION_RADIUS_EDGE,
            ViolationKind::NotFinished => Self::NM_VIOLATION_NOT_FINISHED,
            ViolationKind::DihedralAngle => Self::NM_VIOLATION_DIHEDRAL_ANGLE,
            ViolationKind::SimplexSize => Self::NM_VIOLATION_SIMPLEX_SIZE,
            ViolationKind::BoundaryArrays => Self::NM_VIOLATION_BOUNDARY_ARRAYS,
            ViolationKind::DomainArrays => Self::NM_VIOLATION_DOMAIN_ARRAYS,
            ViolationKind::Ids => Self::NM_VIOLATION_IDS,
            ViolationKind::SharedVertex => Self::NM_VIOLATION_SHARED_VERTEX,
            ViolationKind::VertexOwner => Self::NM_VIOLATION_VERTEX_OWNER,
            ViolationKind::Ghost => Self::NM_VIOLATION_GHOST,
            ViolationKind::MissingGhost => Self::NM_VIOLATION_MISSING_GHOST,
            ViolationKind::Interface => Self::NM_VIOLATION_INTERFACE,
            ViolationKind::Totals => Self::NM_VIOLATION_TOTALS,
            ViolationKind::SharedDomain => Self::NM_VIOLATION_SHARED_DOMAIN,
            ViolationKind::SubsegmentEdge => Self::NM_VIOLATION_SUBSEGMENT_EDGE,
            ViolationKind::SubsegmentGabriel => Self::NM_VIOLATION_SUBSEGMENT_GABRIEL,
            ViolationKind::SegmentChain => Self::NM_VIOLATION_SEGMENT_CHAIN,
            ViolationKind::SegmentLine => Self::NM_VIOLATION_SEGMENT_LINE,
            ViolationKind::RegionLabel => Self::NM_VIOLATION_REGION_LABEL,
            ViolationKind::DomainEnd => Self::NM_VIOLATION_DOMAIN_END,
            ViolationKind::DomainPlace => Self::NM_VIOLATION_DOMAIN_PLACE,
            ViolationKind::RegionArea => Self::NM_VIOLATION_REGION_AREA,
            ViolationKind::ForcedSimplex => Self::NM_VIOLATION_FORCED_SIMPLEX,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_the_certificates() {
        for kind in ViolationKind::ALL {
            assert_eq!(nm_violation::from(kind) as u32, kind as u32);
        }
    }
}

//! Findings of the checker: kinds of violations, the first one in words, and counts.

use crate::mesh::NONE;
use std::borrow::Cow;

/// Bytes of a message that fit the C ABI's `char[160]` with its NUL.
const MESSAGE_BYTES: usize = 159;

/// Rule that a violation breaks. 1 to 99 are rules of level 1 (topology), 101 to 199 of level 2
/// (geometry), 201 to 299 of level 3 (the promises). Those from 51 to 58 are of meshes on several
/// ranks of MPI. Later versions may append kinds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum ViolationKind {
    /// Nothing was found broken.
    None = 0,

    /// An array does not have the length that the number of vertices or simplices asks for.
    ArrayLength = 1,
    /// A coordinate is infinite or not a number.
    NonFinite = 2,
    /// A simplex names a vertex that does not exist.
    VertexOutOfRange = 3,
    /// A simplex names a vertex twice.
    RepeatedVertex = 4,
    /// A vertex is in no simplex.
    UnusedVertex = 5,
    /// A simplex names a neighbour that does not exist.
    NeighborOutOfRange = 6,
    /// Two simplices have the same vertices.
    DuplicateSimplex = 7,
    /// A facet is in more than two simplices.
    OverfullFacet = 8,
    /// A simplex shares a facet with another one but names no neighbour there.
    MissingNeighbor = 9,
    /// A simplex names a neighbour that does not name it back.
    AsymmetricNeighbor = 10,
    /// Two neighbours name each other, but not across the facet that they share.
    NeighborFacet = 11,
    /// The simplices are not connected through facets.
    Disconnected = 12,
    /// The numbers of faces of each dimension do not add up to a ball's.
    EulerCharacteristic = 13,
    /// The simplices round a vertex are not connected through facets at that vertex.
    VertexStar = 14,
    /// The link of a vertex is not a sphere, or on the hull a ball, by its Euler characteristic.
    VertexLink = 15,
    /// The mesh has no hull facet, or a hull ridge is not in exactly two hull facets.
    HullRidge = 16,
    /// The hull is not connected.
    HullDisconnected = 17,
    /// The hull facets round a vertex are not connected through ridges at that vertex.
    HullLink = 18,
    /// The arrays of segments, facets and regions do not fit each other or the mesh.
    BoundaryArrays = 19,
    /// The arrays of a domain that is cut out are not the first parts of those of the whole, or its
    /// subsegments and subfacets are not those that are edges and faces of its simplices.
    DomainArrays = 20,
    /// The simplices that are given for a subfacet are not those that have it, on these sides.
    SubfacetSimplices = 21,

    /// A ridge of a surface, an edge in space, is not between two facets that have it in opposite
    /// directions.
    SurfaceRidge = 22,
    /// The facets of a surface round a vertex are not connected at that vertex.
    SurfaceFan = 23,
    /// A vertex is on a surface and said to be left out, or neither.
    SurfaceVertices = 24,

    /// Ids of a mesh on several ranks do not rise, are out of range, or are counted from different
    /// numbers by two ranks.
    Ids = 51,
    /// Two ranks have different coordinates, kinds, domains or cages of a vertex.
    SharedVertex = 52,
    /// The owner of a vertex is not the lowest rank that has a simplex with it.
    VertexOwner = 53,
    /// A ghost is not what its owner has under its id, or shares no vertex with the rank.
    Ghost = 54,
    /// A simplex that shares a vertex with the rank is not among its ghosts.
    MissingGhost = 55,
    /// The interface is not the facets whose neighbours are ghosts.
    Interface = 56,
    /// The sizes of the whole mesh are not those of all parts.
    Totals = 57,
    /// Two ranks have different centres, radii or parents of a domain.
    SharedDomain = 58,

    /// A simplex is flat or negatively oriented.
    Orientation = 101,
    /// Two neighbours lie on the same side of the facet that they share.
    FoldedFacet = 102,
    /// The opposite vertex of a neighbour is strictly inside a simplex's circumball.
    Delaunay = 103,
    /// The hull is not convex at a ridge.
    NonConvexHull = 104,
    /// The simplices round a face of codimension two go round it more than once.
    Winding = 105,
    /// A subsegment is no edge of the mesh.
    SubsegmentEdge = 106,
    /// In the plane, a vertex is strictly inside the circle of which a subsegment is a diameter.
    SubsegmentGabriel = 107,
    /// Subsegments do not lead from one end of a segment or of a facet's edge to the other, or go
    /// back on the way.
    SegmentChain = 108,
    /// A vertex on a segment or on a facet's edge is farther from it than rounding makes it, or a
    /// subsegment is on none.
    SegmentLine = 109,
    /// A subfacet is no face of the mesh.
    SubfacetFace = 110,
    /// A subfacet is flat or turned round in the projection of its facet.
    FacetTriangle = 111,
    /// The subfacets of a facet do not meet along their edges, or do not end at its loops.
    FacetTiling = 112,
    /// The subfacets of a facet have another area than the facet.
    FacetArea = 113,
    /// A vertex on a facet is farther from its plane than rounding makes it.
    FacetPlane = 114,
    /// Triangles of the caller's are one facet and may not be, or subfacets belong to no facet of
    /// the caller's and are not on the boundary of a hull or box.
    FacetGroup = 115,
    /// A facet of a surface is no face of the mesh, or is there twice.
    SurfaceFace = 116,

    /// An input's vertex does not exist or has other coordinates.
    InputVertex = 201,
    /// The vertex of a distinct input does not have that input's bits.
    InputBits = 202,
    /// A vertex's kind contradicts its id: vertices 0, 1, ... up to the number of distinct inputs
    /// are inputs, and no others are.
    VertexKind = 203,
    /// A plain Delaunay triangulation has domains, labels or vertices that are no inputs.
    PlainDelaunay = 204,
    /// The domains are not a tree: domain 0 the only root, parents before their children.
    DomainTree = 205,
    /// A domain's radius is not positive and finite, or its centre is no vertex.
    DomainBall = 206,
    /// The vertex at a domain's centre is not labelled as in that domain's subtree.
    DomainCenter = 207,
    /// A child's ball reaches outside its parent's.
    DomainOutsideParent = 208,
    /// The balls of two siblings overlap.
    DomainsOverlap = 209,
    /// A vertex is labelled with a domain that does not exist, that does not contain it, or that
    /// has a child which contains it.
    VertexDomain = 210,
    /// A cage vertex's kind contradicts the domain that it is labelled with.
    CageOf = 211,
    /// A cage vertex is not near the cage's sphere.
    CageRadius = 212,
    /// A cage has too few vertices to enclose its domain's centre.
    CageIncomplete = 213,
    /// A vertex on the hull is not in the root's cage.
    HullVertex = 214,
    /// An input inside a domain's ball encroaches its cage (Definition 2).
    InnerEncroachment = 215,
    /// A vertex outside a domain's ball encroaches its cage (Definition 2).
    OuterEncroachment = 216,
    /// Simplices span more levels of the hierarchy than un-encroached cages allow.
    DomainSpan = 217,
    /// The Voronoi cell of a non-cage vertex has a worse aspect than the bound (Definition 4).
    VertexAspect = 218,
    /// The union cell of a cage has a worse aspect than the bound (Definition 4).
    CageAspect = 219,
    /// A simplex has a larger ratio of circumradius to shortest edge than the bound.
    RadiusEdge = 220,
    /// A finished mesh has other domains than the root.
    NotFinished = 221,
    /// A tetrahedron with all vertices in one domain has a smaller dihedral angle than was asked
    /// for, and the run did not say so.
    DihedralAngle = 222,
    /// A simplex that meets the box of the inputs is larger than the sizes that were asked for.
    SimplexSize = 223,
    /// Neighbours without a subsegment or subfacet between them have different labels, the label of
    /// a region is not that of its seed, or a seed has no region of its own.
    RegionLabel = 224,
    /// The domain ends between two neighbours where no subsegment or subfacet is.
    DomainEnd = 225,
    /// The domain has a region that is outside or a hole, or lacks one that is neither, or an input
    /// is outside of the hull or box.
    DomainPlace = 226,
    /// The simplices with one label have another area than the polygons about them.
    RegionArea = 227,
    /// A simplex is marked as forced by a small angle between segments or facets, and is not.
    ForcedSimplex = 228,
    /// The simplices with one label have another volume than the facets about them enclose, or what
    /// the boundary of a hull or box encloses is not of its volume.
    RegionVolume = 229,
    /// A simplex is marked as flat in a facet without all of its vertices on one, or is not marked
    /// with them.
    FlatSimplex = 230,
}

impl ViolationKind {
    /// Every kind, in the order of the values.
    pub const ALL: [Self; 79] = [
        Self::None,
        Self::ArrayLength,
        Self::NonFinite,
        Self::VertexOutOfRange,
        Self::RepeatedVertex,
        Self::UnusedVertex,
        Self::NeighborOutOfRange,
        Self::DuplicateSimplex,
        Self::OverfullFacet,
        Self::MissingNeighbor,
        Self::AsymmetricNeighbor,
        Self::NeighborFacet,
        Self::Disconnected,
        Self::EulerCharacteristic,
        Self::VertexStar,
        Self::VertexLink,
        Self::HullRidge,
        Self::HullDisconnected,
        Self::HullLink,
        Self::BoundaryArrays,
        Self::DomainArrays,
        Self::SubfacetSimplices,
        Self::SurfaceRidge,
        Self::SurfaceFan,
        Self::SurfaceVertices,
        Self::Ids,
        Self::SharedVertex,
        Self::VertexOwner,
        Self::Ghost,
        Self::MissingGhost,
        Self::Interface,
        Self::Totals,
        Self::SharedDomain,
        Self::Orientation,
        Self::FoldedFacet,
        Self::Delaunay,
        Self::NonConvexHull,
        Self::Winding,
        Self::SubsegmentEdge,
        Self::SubsegmentGabriel,
        Self::SegmentChain,
        Self::SegmentLine,
        Self::SubfacetFace,
        Self::FacetTriangle,
        Self::FacetTiling,
        Self::FacetArea,
        Self::FacetPlane,
        Self::FacetGroup,
        Self::SurfaceFace,
        Self::InputVertex,
        Self::InputBits,
        Self::VertexKind,
        Self::PlainDelaunay,
        Self::DomainTree,
        Self::DomainBall,
        Self::DomainCenter,
        Self::DomainOutsideParent,
        Self::DomainsOverlap,
        Self::VertexDomain,
        Self::CageOf,
        Self::CageRadius,
        Self::CageIncomplete,
        Self::HullVertex,
        Self::InnerEncroachment,
        Self::OuterEncroachment,
        Self::DomainSpan,
        Self::VertexAspect,
        Self::CageAspect,
        Self::RadiusEdge,
        Self::NotFinished,
        Self::DihedralAngle,
        Self::SimplexSize,
        Self::RegionLabel,
        Self::DomainEnd,
        Self::DomainPlace,
        Self::RegionArea,
        Self::ForcedSimplex,
        Self::RegionVolume,
        Self::FlatSimplex,
    ];

    /// Returns the level whose rule it is; 0 for `None`.
    pub fn level(self) -> u32 {
        match self as u32 {
            0 => 0,
            value => value / 100 + 1,
        }
    }
}

/// One broken rule, with the ids it concerns ([`crate::NONE`] where none).
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    pub kind: ViolationKind,
    pub simplex: u32,
    pub vertex: u32,
    pub domain: u32,
    /// One sentence that names the rule and the values, at most 159 bytes.
    pub message: Cow<'static, str>,
}

impl Violation {
    pub(super) fn new(kind: ViolationKind, message: impl Into<Cow<'static, str>>) -> Self {
        let mut message: Cow<'static, str> = message.into();
        let mut end = message.len().min(MESSAGE_BYTES);
        while !message.is_char_boundary(end) {
            end -= 1;
        }
        match &mut message {
            Cow::Borrowed(text) => *text = &text[..end],
            Cow::Owned(text) => text.truncate(end),
        }
        Self { kind, simplex: NONE, vertex: NONE, domain: NONE, message }
    }

    pub(super) fn simplex(self, simplex: usize) -> Self {
        Self { simplex: simplex as u32, ..self }
    }

    pub(super) fn vertex(self, vertex: usize) -> Self {
        Self { vertex: vertex as u32, ..self }
    }

    pub(super) fn domain(self, domain: usize) -> Self {
        Self { domain: domain as u32, ..self }
    }
}

/// Findings of the certificate checker.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The highest level that holds in full, with all below it; 0 if level 1 does not. Never above
    /// the level that was asked for.
    pub level: u32,
    /// Violations found. Checks that would stand on a broken array or a broken tree are not made.
    pub violations: u64,
    /// Number of single checks made.
    pub checked: u64,
    /// The first violation of the lowest level that does not hold.
    pub first: Option<Violation>,
}

/// Counts checks and keeps the first violation. Messages are made for that one only.
#[derive(Default)]
pub(super) struct Findings {
    pub violations: u64,
    pub checked: u64,
    pub first: Option<Violation>,
    counts_only: bool,
}

impl Findings {
    /// Returns findings that keep no violation: a message needs memory, and nobody would read it.
    pub fn counting() -> Self {
        Self { counts_only: true, ..Self::default() }
    }

    /// Records one check; returns whether it held.
    pub fn check(&mut self, holds: bool, violation: impl FnOnce() -> Violation) -> bool {
        self.checked += 1;
        if !holds {
            self.violations += 1;
            if self.first.is_none() && !self.counts_only {
                self.first = Some(violation());
            }
        }
        holds
    }

    /// Takes the findings of a later part of a check into account.
    pub fn merge(&mut self, later: Self) {
        self.violations += later.violations;
        self.checked += later.checked;
        self.first = self.first.take().or(later.first);
    }

    /// Returns true if everything so far held.
    pub fn clean(&self) -> bool {
        self.violations == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_fit_the_c_struct() {
        let violation = Violation::new(ViolationKind::Delaunay, "é".repeat(200));
        assert_eq!(violation.message.len(), 158);
        assert_eq!(Violation::new(ViolationKind::Delaunay, "short").message, "short");
    }

    #[test]
    fn all_kinds_are_listed_by_rising_value() {
        let header = include_str!("../../include/netmesh.h");
        let value = |line: &str| -> Option<u32> {
            let (_, value) = line.trim().strip_prefix("NM_VIOLATION_")?.split_once(" = ")?;
            value.trim_end_matches(',').parse().ok()
        };
        let mut expected: Vec<u32> = header.lines().filter_map(value).collect();
        expected.sort_unstable();
        assert_eq!(ViolationKind::ALL.map(|kind| kind as u32).to_vec(), expected);
    }

    #[test]
    fn kinds_know_their_level() {
        assert_eq!(ViolationKind::None.level(), 0);
        assert_eq!(ViolationKind::HullLink.level(), 1);
        assert_eq!(ViolationKind::Orientation.level(), 2);
        assert_eq!(ViolationKind::NotFinished.level(), 3);
    }

    #[test]
    fn the_first_violation_is_kept() {
        let mut findings = Findings::default();
        assert!(findings.check(true, || unreachable!()));
        assert!(!findings.check(false, || Violation::new(ViolationKind::Winding, "w").simplex(4)));
        assert!(!findings.check(false, || unreachable!()));
        assert_eq!((findings.checked, findings.violations), (3, 2));
        assert_eq!(findings.first.unwrap().simplex, 4);
        let mut counting = Findings::counting();
        assert!(!counting.check(false, || unreachable!()));
        assert_eq!((counting.violations, counting.first), (1, None));
    }
}

"""Named tuples that a mesh answers with, and the values that its arrays have."""

import enum
from typing import NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray


class VertexKind(enum.IntEnum):
    """Origin of a vertex: the values of `Mesh.kinds`.

    Examples
    --------
    >>> import netmesh
    >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
    >>> int((m.kinds == netmesh.VertexKind.INPUT).sum())
    3
    """

    INPUT = 0
    STEINER = 1
    CAGE = 2


class Placement(enum.IntEnum):
    """Place of a simplex with respect to a hull or box: the values of `Mesh.placements`."""

    INSIDE = 0
    ACROSS = 1
    OUTSIDE = 2


#: One element of `Mesh.domains`.
DOMAIN = np.dtype([("center", np.int32), ("parent", np.int32), ("radius", np.float64)])


class Intersection(NamedTuple):
    """Pair of facets and segments that meet in more than they share: of `netmesh.intersections`."""

    #: 'cross': the interior of one goes through the other; 'touch': they meet on the boundary of one;
    #: 'overlap': they share an area or a length; 'zero_area': a facet has none, and is both.
    kind: str
    #: 'facet' or 'segment', and the number among the facets or segments.
    first: Tuple[str, int]
    #: Likewise; the same as the first where a facet meets itself.
    second: Tuple[str, int]
    #: A point of the intersection: float64, shape (3,).
    point: NDArray[np.float64]


class OddEdge(NamedTuple):
    """Edge of facets that is not between two of them: of `netmesh.odd_edges`."""

    #: 'open': one facet ends there; 'crowded': three or more meet there; 'turned': two run through it in
    #: one direction, so that their normals point to different sides.
    fault: str
    #: The points at its ends, the smaller number first; of equal points the first.
    ends: Tuple[int, int]
    #: The number of facets that have the edge.
    facets: int


class CSR(NamedTuple):
    """Lists of ids, one for each of several things: list i is ``indices[indptr[i]:indptr[i+1]]``."""

    #: Beginnings of the lists, and the end of the last: int64, one more than there are lists.
    indptr: NDArray[np.int64]
    #: Ids of all lists, one list after another: int32.
    indices: NDArray[np.int32]


class Facets(NamedTuple):
    """Facets with the simplices that have them."""

    #: Vertices of each facet: int32, shape (facets, dim).
    vertices: NDArray[np.int32]
    #: Simplices at each facet: int32, shape (facets, 2), -1 for none; on the hull shape (facets,).
    simplices: NDArray[np.int32]


class VoronoiCells(NamedTuple):
    """The Voronoi diagram of the vertices. The corner that belongs to a simplex is its circumcentre."""

    #: Simplices whose corners the cell of each vertex has; in 2D counterclockwise.
    regions: CSR
    #: True for vertices whose cells are bounded: bool, shape (vertices,).
    is_bounded: NDArray[np.bool_]
    #: Volumes of the cells: float64, shape (vertices,); infinite where they are not bounded.
    volumes: NDArray[np.float64]
    #: Shares of the cells in the volume of the mesh, which is their sum: float64, shape (vertices,).
    shares: NDArray[np.float64]
    #: Vertices between which each ridge lies: int32, shape (ridges, 2). They are the edges.
    ridges: NDArray[np.int32]
    #: Simplices whose corners each ridge has; in 3D in their order round it.
    ridge_corners: CSR
    #: True for bounded ridges: bool, shape (ridges,).
    is_ridge_bounded: NDArray[np.bool_]


class Violation(NamedTuple):
    """Rule that does not hold, and where. Ids are None where the rule concerns none."""

    kind: str
    number: int
    simplex: Optional[int]
    vertex: Optional[int]
    domain: Optional[int]
    message: str


class Report(NamedTuple):
    """Answer of `Mesh.validate`. The mesh is right if `violations` is 0."""

    #: The highest level that holds in full, with all below it.
    level: int
    violations: int
    #: Number of single checks made.
    checked: int
    #: The first violation of the lowest level that does not hold.
    first: Optional[Violation]


class Quality(NamedTuple):
    """Figures of how good a mesh is: the answer of `Mesh.quality`.

    The aspect of a Voronoi cell is the distance from its vertex to its farthest corner over half the
    distance to the nearest other vertex. A figure over no cells at all is 0, infinity stands for
    ratios beyond the doubles.
    """

    #: Largest number of vertices that share an edge with one vertex.
    max_degree: int
    #: Worst aspect of the cells of vertices in no cage, off the hull and not precision-limited.
    worst_aspect: float
    #: Worst aspect over all corners, the cells of cages and precision-limited ones among them.
    worst_aspect_anywhere: float
    #: Mean of the aspects of which worst_aspect is the largest.
    mean_aspect: float
    #: Worst aspect of a cage other than the root's.
    worst_cage_aspect: float
    #: Worst circumradius over shortest edge of the simplices without a vertex on the hull.
    worst_radius_edge: float
    #: Smallest angle (2D) or dihedral angle of the same simplices, in degrees.
    min_angle_degrees: float
    #: Vertices whose cells cannot be improved, because doubles are too coarse there.
    precision_limited: int
    #: Tetrahedra with a smaller dihedral angle than `min_dihedral`, all vertices in one domain.
    below_min_dihedral: int
    #: Tetrahedra below it with vertices of several domains, of which `min_dihedral` says nothing.
    below_min_dihedral_between_domains: int
    #: Cells, or simplices, beyond the bound where that gave way to the angle.
    beyond_bound: int
    #: Simplices that a small angle between segments or facets forces; the figures above leave them
    #: out.
    forced: int
    #: Smallest angle (2D) or dihedral angle of the forced simplices, in degrees.
    least_forced_angle_degrees: float
    #: Triangles that miss the angle and that nothing forces: beside cages, in hierarchical meshes.
    below_min_angle: int
    #: Tetrahedra with all vertices on one facet, flat but for roundings; the figures leave them out.
    flat: int


class Stats(NamedTuple):
    """Figures of what a run did. `include/netmesh.h` explains each one (`nm_stats`)."""

    rounds: int
    touches: int
    max_touches: int
    input_vertices: int
    steiner_vertices: int
    cage_vertices: int
    cages_created: int
    cages_grown: int
    cages_released: int
    exact_fallbacks: int
    precision_limited: int
    seconds: float
    passes: int
    worst_halving: float
    cage_points: int
    far_corners: int
    off_centers: int
    yields: int
    closing_points: int
    near_inputs: int
    farthest_near_input: float
    simplices_created: int
    # From here on 0 without the option `instruments`.
    ply_probes: int
    max_ply: int
    mean_ply: float
    max_ball_intersections: int
    mean_ball_intersections: float
    feature_size_constant: float
    insertion_constant_input: float
    insertion_constant_corner: float
    insertion_constant_cage: float

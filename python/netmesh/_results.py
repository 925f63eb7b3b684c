"""What a mesh tells of itself: tuples with names."""

from typing import NamedTuple, Optional


class Violation(NamedTuple):
    """A rule that does not hold. Ids are None where the rule concerns none."""

    kind: str
    number: int
    simplex: Optional[int]
    vertex: Optional[int]
    domain: Optional[int]
    message: str


class Report(NamedTuple):
    """What `Mesh.validate` found. The mesh is right if `violations` is 0."""

    #: The highest level that holds in full, with all below it.
    level: int
    violations: int
    #: Number of single checks made.
    checked: int
    #: The first violation of the lowest level that does not hold.
    first: Optional[Violation]


class Quality(NamedTuple):
    """How good a mesh is.

    The aspect of a Voronoi cell is the distance from its vertex to its farthest corner over half the
    distance to the nearest other vertex. A figure over no cells at all is 0, infinity stands for
    ratios beyond the doubles.
    """

    #: Largest number of vertices that share an edge with one vertex.
    max_degree: int
    #: Worst aspect of the cells of vertices in no cage, off the hull and not precision-limited.
    worst_aspect: float
    #: As worst_aspect over all corners, with the cells of cages and precision-limited ones.
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


class Stats(NamedTuple):
    """What a run did. `include/netmesh.h` explains each figure (`nm_stats`)."""

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
    ply_probes: int
    max_ply: int
    mean_ply: float
    max_ball_intersections: int
    mean_ball_intersections: float
    feature_size_constant: float
    insertion_constant_input: float
    insertion_constant_corner: float
    insertion_constant_cage: float
    simplices_created: int

"""Meshes for spatial statistics: fine where the data are, coarse in a ring round them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _netmesh
from ._arrays import contiguous, doubles, number, point_rows, require_finite
from ._errors import ArgumentTypeError, InvalidArgumentError
from ._mesh import Mesh, mesh
from ._scaling import scaled, unscaled

#: Arguments of `mesh` that `spatial_mesh` gives itself.
_TAKEN = ("points", "segments", "facets", "markers", "facet_markers", "regions", "holes", "extent")


class SpatialMesh(NamedTuple):
    """A mesh for spatial statistics, and where the caller's points are in it.

    Attributes
    ----------
    mesh : Mesh
        Its `simplex_regions` are 1 in the inner domain and 2 in the ring.
    representatives : ndarray of int32, shape (n,)
        For each point the one that stands for it, itself if it has been meshed.
    vertices : ndarray of int32, shape (n,)
        For each point the vertex that stands for it.
    inner, outer : ndarray of float64, shape (corners, 2)
        The boundaries of the inner domain and of the ring, counterclockwise.
    """

    mesh: Mesh
    representatives: NDArray[np.int32]
    vertices: NDArray[np.int32]
    inner: NDArray[np.float64]
    outer: NDArray[np.float64]


def spatial_mesh(
    points: Any,
    *,
    max_edge: Any,
    offset: Any,
    cutoff: float = 0.0,
    corners: int = 16,
    min_angle: float = 25.0,
    **options: Any,
) -> SpatialMesh:
    """Mesh points of the plane with a coarse ring round them, as INLA and fmesher do.

    The inner domain reaches to a distance from the convex hull of the points, the ring round it
    farther, so that conditions at the outer boundary do not reach the data.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
    max_edge : (float, float)
        Longest edge in the inner domain, and in the ring.
    offset : (float, float)
        Width of the inner domain beyond the hull of the points, and width of the ring: see
        `offset_hull`.
    cutoff : float
        Points nearer than this to another one are not meshed but represented by it: see
        `representatives`.
    corners : int
        Number of sides with which the boundaries go round a point, as of `offset_hull`.
    min_angle : float
        Smallest angle of the triangles in degrees.
    **options
        Other options of `mesh`.

    Returns
    -------
    SpatialMesh

    Raises
    ------
    Error
        Errors of `mesh`.

    Examples
    --------
    >>> import numpy as np, netmesh
    >>> points = np.random.default_rng(1).random((200, 2))
    >>> made = netmesh.spatial_mesh(points, max_edge=(0.1, 0.5), offset=(0.1, 0.6), cutoff=0.02)
    >>> m = made.mesh
    >>> is_meshed = made.representatives == np.arange(200)
    >>> bool((m.points[made.vertices[is_meshed]] == points[is_meshed]).all())
    True
    >>> lengths = np.linalg.norm(m.points[m.edges[:, 0]] - m.points[m.edges[:, 1]], axis=1)
    >>> bool(lengths.max() <= 0.5), m.quality().min_angle_degrees >= 25
    (True, True)
    >>> A = m.projector(points)
    >>> np.allclose(A @ m.points, points)
    True
    """
    points = plane_points(points)
    taken = sorted(set(options) & set(_TAKEN))
    if taken:
        raise ArgumentTypeError(f"{taken[0]} is given by spatial_mesh itself")
    edges, widths = _pair(max_edge, "max_edge"), _pair(offset, "offset")
    if min(edges) <= 0:
        raise InvalidArgumentError(f"max_edge is {max_edge}; both lengths must be above 0")
    if min(widths) <= 0:
        raise InvalidArgumentError(f"offset is {offset}; both widths must be above 0")
    standing = representatives(points, cutoff)
    meshed = np.flatnonzero(standing == np.arange(len(points)))
    inner = offset_hull(points, widths[0], corners)
    outer = offset_hull(inner, widths[1], corners)
    made = mesh(
        np.concatenate([points[meshed], inner, outer]),
        np.concatenate([_loop(len(inner), len(meshed)), _loop(len(outer), len(meshed) + len(inner))]),
        regions=_regions(inner, widths[1], edges),
        extent="boundary",
        min_angle=min_angle,
        **options,
    )
    numbers = np.zeros(len(points), np.int64)
    numbers[meshed] = np.arange(len(meshed))
    return SpatialMesh(made, standing, made.input_vertices[numbers[standing]], inner, outer)


def representatives(points: Any, cutoff: float) -> NDArray[np.int32]:
    """Choose points no two of which are nearer than a distance, and tell which stand for the others.

    Points are taken in their order. Each that has no chosen one nearer than `cutoff` is chosen; the
    others are represented by the nearest chosen one, of equally near ones the first. Distances are
    rounded to doubles.

    Parameters
    ----------
    points : array_like of float, shape (n, dim)
    cutoff : float
        At least 0, where all points are chosen.

    Returns
    -------
    ndarray of int32, shape (n,)
        For each point the one that stands for it; of a chosen one itself.

    Examples
    --------
    >>> import netmesh
    >>> netmesh.representatives([[0, 0], [0.3, 0], [0.6, 0], [2, 0]], cutoff=0.5)
    array([0, 0, 2, 3], dtype=int32)
    """
    return _netmesh.representatives(contiguous(point_rows(points)), number(cutoff, "cutoff"))


def offset_hull(points: Any, distance: float, corners: int = 16) -> NDArray[np.float64]:
    """Make a convex polygon with few corners round points of the plane, at a distance from them.

    Its sides touch the set of all places within `distance` of the hull of the points. Some are parallel
    to the longest edges of the hull, as far as these differ in direction by ``180 / corners`` degrees or
    more; others stand between them, so that sides that meet differ by at most ``360 / corners``.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        At least one.
    distance : float
        Above 0.
    corners : int
        Number of sides round a single point, at least 3.

    Returns
    -------
    ndarray of float64, shape (m, 2)
        Counterclockwise; m is from `corners` to twice that.

    Examples
    --------
    >>> import netmesh
    >>> netmesh.offset_hull([[0, 0], [1, 0]], 0.5, corners=4).round(12).tolist()
    [[-0.5, 0.5], [-0.5, -0.5], [1.5, -0.5], [1.5, 0.5]]
    """
    points, distance = plane_points(points), number(distance, "distance")
    if not 0 < distance < math.inf:
        raise InvalidArgumentError(f"distance is {distance}; it must be above 0 and finite")
    if isinstance(corners, bool) or not isinstance(corners, (int, np.integer)):
        raise ArgumentTypeError(f"corners is of type {type(corners).__name__}; it must be a whole number")
    if corners < 3:
        raise InvalidArgumentError(f"corners is {corners}; it must be at least 3")
    places, exponent = scaled(np.append(points, [[distance, 0]], axis=0))
    points, reach = places[:-1], places[-1, 0]
    hull = _hull(points)
    center = hull.mean(axis=0)
    angles = _side_angles(hull, int(corners))
    normals = np.column_stack([np.cos(angles), np.sin(angles)])
    # Lines n.x = h touch what is within the distance; neighbouring ones meet in a corner.
    heights = ((hull - center) @ normals.T).max(axis=0) + reach
    pairs = np.stack([normals, np.roll(normals, -1, axis=0)], axis=1)
    right = np.stack([heights, np.roll(heights, -1)], axis=1)
    found = unscaled(center + np.linalg.solve(pairs, right[:, :, None])[:, :, 0], exponent)
    if not np.isfinite(found).all():
        raise InvalidArgumentError(f"distance is {distance}; the hull must be within the range of doubles")
    return found


def plane_points(points: Any) -> NDArray[np.float64]:
    """Make doubles of shape (n, 2) of at least one point of the plane, all finite."""
    found = point_rows(points)
    if found.shape[1] != 2 or len(found) == 0:
        raise InvalidArgumentError(f"points has shape {found.shape}; it must be (n, 2), n at least 1")
    require_finite(found, "points")
    return found


def _pair(given: Any, name: str) -> tuple[float, float]:
    found = doubles(given, name)
    if found.shape != (2,) or not np.isfinite(found).all():
        raise InvalidArgumentError(f"{name} is {given}; it must be two finite lengths, inner and outer")
    return float(found[0]), float(found[1])


def _hull(points: np.ndarray) -> np.ndarray:
    """Return the corners of the convex hull, counterclockwise."""
    rows = np.unique(points, axis=0).tolist()
    chains = []
    for ordered in (rows, rows[::-1]):
        chain: list = []
        for row in ordered:
            while len(chain) > 1 and not _turns_left(chain[-2], chain[-1], row):
                chain.pop()
            chain.append(row)
        chains.append(chain[:-1])
    return doubles(chains[0] + chains[1] or rows, "points")


def _turns_left(a: list, b: list, c: list) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])


def _side_angles(hull: np.ndarray, corners: int) -> np.ndarray:
    """Return the directions of the normals of an offset hull, ascending."""
    edges = np.roll(hull, -1, axis=0) - hull
    edges = edges[(edges != 0).any(axis=1)]
    order = np.argsort(-np.hypot(edges[:, 0], edges[:, 1]), kind="stable")
    of_edges = np.arctan2(-edges[order, 0], edges[order, 1])
    step = 2 * np.pi / corners
    chosen: list = []
    for angle in of_edges.tolist() or [0.0]:
        between = [abs(math.remainder(angle - other, 2 * math.pi)) for other in chosen]
        # Equal steps may differ by roundings.
        if min(between, default=math.pi) >= step / 2 * (1 - 1e-9):
            chosen.append(angle % (2 * math.pi))
    chosen.sort()
    found = []
    for first, second in zip(chosen, chosen[1:] + [chosen[0] + 2 * math.pi]):
        parts = math.ceil((second - first) / step * (1 - 1e-9))
        found.append(first + (second - first) / parts * np.arange(parts))
    return np.concatenate(found)


def _loop(count: int, first: int) -> np.ndarray:
    ring = np.arange(count)
    return first + np.column_stack([ring, (ring + 1) % count])


def _regions(inner: np.ndarray, width: float, edges: tuple[float, float]) -> list:
    """Return a point of the inner domain and one of the ring, with their labels and longest edges."""
    x, y = inner.mean(axis=0)
    rightmost = inner[inner[:, 0].argmax()]
    return [(x, y, 1, edges[0]), (rightmost[0] + 0.5 * width, rightmost[1], 2, edges[1])]

"""Surfaces before they are meshed: pairs that meet in more than they may, odd edges, holes, near points."""

from __future__ import annotations

import itertools
import numbers
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._arrays import point_rows
from ._errors import InvalidArgumentError
from ._input import boundary_of, domain_of
from ._netmesh import close_holes as _close_holes
from ._netmesh import intersections as _intersections
from ._netmesh import merge_points as _merge_points
from ._netmesh import odd_edges as _odd_edges
from ._netmesh import triangulate_facets as _triangulate_facets
from ._results import Intersection, OddEdge


def _input(points: Any, facets: Any, segments: Any = None) -> tuple[np.ndarray, tuple]:
    """Return points, and segments and facets in the form that the library takes."""
    given = domain_of(points, segments, facets)
    rows = point_rows(given.points)
    return rows, boundary_of(given, rows.shape[1])


def intersections(points: Any, facets: Any = None, segments: Any = None) -> list[Intersection]:
    """Find all pairs of facets and segments in space that meet in more than they share.

    They may share vertices and edges, by equal points. Facets that meet themselves or have no area
    are found, too. The test is exact. Where nothing is found, `mesh` can keep them; otherwise it
    refuses with the first.

    Parameters
    ----------
    points : array_like of float, shape (n, 3), a surface, or a `Domain`
    facets : optional
        Triangles, polygons or lists of loops, as those of `mesh`.
    segments : array_like of int, shape (segments, 2), optional

    Returns
    -------
    list of Intersection
        By their first features, facets before segments, and then by the second.

    Examples
    --------
    >>> import netmesh
    >>> points = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [2, 1, 1]]
    >>> found = netmesh.intersections(points, [[0, 1, 2]], segments=[[3, 4]])
    >>> [(one.kind, one.first, one.second) for one in found]
    [('cross', ('facet', 0), ('segment', 0))]
    >>> found[0].point.tolist()
    [1.0, 1.0, 0.0]
    """
    found = _intersections(*_input(points, facets, segments))
    return [Intersection(kind, first, second, np.fromiter(x, np.float64)) for kind, first, second, x in found]


def odd_edges(points: Any, facets: Any = None) -> list[OddEdge]:
    """Find all edges of facets in space that are not one of two that run through them both ways.

    A closed surface has none if its facets are oriented alike: each edge is between two facets, one of
    which runs through it one way and the other one the other way. Triangles without an area have no
    edges; equal points are one.

    Parameters
    ----------
    points : array_like of float, shape (n, 3), a surface, or a `Domain`
    facets : optional
        Triangles, polygons or lists of loops, as those of `mesh`.

    Returns
    -------
    list of OddEdge
        By their ends.

    Examples
    --------
    >>> import netmesh
    >>> points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> netmesh.odd_edges(points, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    []
    >>> for edge in netmesh.odd_edges(points, [[0, 2, 1], [0, 3, 1], [1, 2, 3]]):
    ...     print(edge.fault, edge.ends, edge.facets)
    turned (0, 1) 2
    open (0, 2) 1
    open (0, 3) 1
    turned (1, 3) 2
    open (2, 3) 1
    """
    return [OddEdge(*told) for told in _odd_edges(*_input(points, facets))]


def close_holes(points: Any, facets: Any = None, max_edges: int = 100) -> NDArray[np.int32]:
    """Find triangles that close the holes of a surface in space.

    A hole is a loop of edges at which one facet ends and no other begins. One of k edges is closed
    by k - 2 triangles between its points. Of all that could close it these are bent least, so that
    a flat facet that is missing is closed within its plane. A hole stays open if only a triangle
    that is there already, or one without an area, could close it. That the triangles do not cross
    others is not known before `intersections` or `mesh` are asked.

    Parameters
    ----------
    points : array_like of float, shape (n, 3), a surface, or a `Domain`
    facets : optional
        Triangles, polygons or lists of loops, as those of `mesh`.
    max_edges : int, default 100
        Number of edges of the largest hole that is closed, from 3 to 1000. The time grows with its
        third power.

    Returns
    -------
    ndarray of int32, shape (triangles, 3)
        Numbers of points. Their normals point to where those of the facets round the hole do.

    Examples
    --------
    >>> import netmesh, numpy as np
    >>> points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> open_surface = [[0, 2, 1], [0, 1, 3], [0, 3, 2]]
    >>> closing = netmesh.close_holes(points, open_surface)
    >>> closing.tolist()
    [[1, 2, 3]]
    >>> mesh = netmesh.mesh(points, facets=np.vstack([open_surface, closing]))
    >>> bool(np.isclose(mesh.volumes.sum(), 1 / 6))
    True
    """
    rows, boundary = _input(points, facets)
    if not isinstance(max_edges, numbers.Integral) or not 3 <= max_edges <= 1000:
        raise InvalidArgumentError(f"max_edges is {max_edges!r}; it must be a whole number from 3 to 1000")
    found = _close_holes(rows, boundary, int(max_edges))
    return np.fromiter(itertools.chain.from_iterable(found), np.int32).reshape(-1, 3)


def triangulate_facets(points: Any, facets: Any = None) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Find the triangles that polygons consist of.

    For polygons that are not plane, which `mesh` refuses. The view of a polygon along an axis decides
    which triangles between its points it becomes: that of its plane or, if it has none, the first in
    which it does not meet itself, beginning with that in which it is largest. A polygon without an
    area becomes one triangle without one, which `mesh` refuses, or leaves out with
    ``crossings="split"``.

    Parameters
    ----------
    points : array_like of float, shape (n, 3), a surface, or a `Domain`
    facets : optional
        Triangles, polygons or lists of loops, as those of `mesh`.

    Returns
    -------
    triangles : ndarray of int32, shape (triangles, 3)
        Numbers of points, turned as the polygons are.
    parents : ndarray of int32, shape (triangles,)
        The number of the facet that each is of: `markers[parents]` are their markers.

    Raises
    ------
    InvalidArgumentError
        If a polygon has segments within, or meets itself: if it is not plane, along each axis.

    Examples
    --------
    >>> import netmesh
    >>> points = [[0, 0, 0], [2, 0, 0], [2, 2, 0.5], [0, 2, 0]]
    >>> triangles, parents = netmesh.triangulate_facets(points, [[0, 1, 2, 3]])
    >>> len(triangles), parents.tolist()
    (2, [0, 0])
    """
    rows, boundary = _input(points, facets)
    triangles, parents = _triangulate_facets(rows, boundary)
    numbers_of_points = itertools.chain.from_iterable(triangles)
    return np.fromiter(numbers_of_points, np.int32).reshape(-1, 3), np.fromiter(parents, np.int32)


def merge_points(points: Any, ratio: float = 1e-9) -> NDArray[np.float64]:
    """Give points that are nearly others the coordinates of these.

    Programs write a point of a surface several times, with other roundings, so that it is open
    there and touches itself. Points that are at most `ratio` times the diagonal of the box of all
    from an earlier one take its place; so do chains of such points.

    Parameters
    ----------
    points : array_like of float, shape (n, dim), in 2D or 3D
    ratio : float, default 1e-9
        From 0 to 0.001.

    Returns
    -------
    ndarray of float64, shape (n, dim)
        As many points as before, in their order: `mesh` takes equal ones for one.

    Examples
    --------
    >>> import netmesh
    >>> netmesh.merge_points([[0, 0, 0], [1, 0, 0], [1e-17, 0, 3e-33], [0, 1, 0]]).tolist()
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    """
    rows = point_rows(points)
    if not isinstance(ratio, numbers.Real):
        raise InvalidArgumentError(f"ratio is {ratio!r}; it must be a number from 0 to 0.001")
    coordinates, _ = _merge_points(rows, float(ratio))
    return np.fromiter(coordinates, np.float64).reshape(rows.shape)

"""Facets in the form that the library takes, pairs that meet in more than they may, odd edges, holes."""

from __future__ import annotations

import collections.abc
import itertools
import numbers
from typing import Any

import numpy as np

from ._arrays import array, doubles, point_rows, whole_numbers
from ._boundary import boundary_of
from ._errors import InvalidArgumentError
from ._netmesh import close_holes as _close_holes
from ._netmesh import intersections as _intersections
from ._netmesh import merge_points as _merge_points
from ._netmesh import odd_edges as _odd_edges
from ._netmesh import triangulate_facets as _triangulate_facets
from ._results import Intersection, OddEdge

#: Rule that refused facets break.
_RULE = "it must be an array of triangles, or a sequence of polygons or of lists of loops"


def points_and_facets(points: Any, facets: Any) -> tuple[Any, Any]:
    """Return points and facets, of which either may be a surface that has both."""
    if facets is None and is_surface(points):
        return points.vertices, points.faces
    if not is_surface(facets):
        return points, facets
    own, given = doubles(facets.vertices, "facets.vertices"), doubles(points, "points")
    if given.ndim != 2 or own.ndim != 2 or not np.array_equal(given[: len(own)], own):
        rule = "they must begin with the vertices of facets, whose faces have their numbers"
        raise InvalidArgumentError(f"points has shape {given.shape}; {rule}")
    return points, facets.faces


def is_surface(thing: Any) -> bool:
    """Tell whether an object has vertices and faces, as meshes of trimesh have."""
    return hasattr(thing, "vertices") and hasattr(thing, "faces")


def facets_of(facets: Any, markers: Any) -> tuple | None:
    """Return starts of loops (None for triangles) and of their inputs, the inputs, and markers."""
    if facets is None:
        if markers is not None:
            raise InvalidArgumentError("facet_markers is given; it must come with facets")
        return None
    given = _as_array(facets)
    if given is not None and given.shape[1:] == (3,):
        return (None, None, given.reshape(-1), _markers_of(markers, len(given)))
    loops = list(_loops(facets if given is None else given))
    lists = [loop for of_facet in loops for loop in of_facet]
    starts = [_starts(map(len, loops)), _starts(map(len, lists))]
    inputs = np.concatenate([np.zeros(0, np.int64), *lists])
    return (*starts, inputs, _markers_of(markers, len(loops)))


def _as_array(facets: Any) -> np.ndarray | None:
    """Return an array of facets with as many inputs each; None if they are of several kinds."""
    if isinstance(facets, np.ndarray) and facets.dtype != object:
        found = whole_numbers(facets, "facets")
        if found.ndim != 2:
            raise InvalidArgumentError(f"facets has shape {found.shape}; {_RULE}")
        return found
    if isinstance(facets, (str, bytes)) or not isinstance(facets, collections.abc.Iterable):
        raise InvalidArgumentError(f"facets is {facets!r}; {_RULE}")
    if not isinstance(facets, collections.abc.Sequence) or not len(facets):
        return None
    is_triangle = [_is_list(facet) and len(facet) == 3 and not any(map(_is_list, facet)) for facet in facets]
    return whole_numbers(facets, "facets") if all(is_triangle) else None


def _loops(facets: Any) -> Any:
    """Yield the loops of each facet, each an array of inputs."""
    for at, facet in enumerate(facets):
        name = f"facets[{at}]"
        if not _is_list(facet):
            raise InvalidArgumentError(f"{name} is {facet!r}; it must be a polygon or a list of loops")
        if any(map(_is_list, facet)):
            yield [_loop(loop, f"{name}[{k}]") for k, loop in enumerate(facet)]
        else:
            yield [_loop(facet, name)]


def _loop(loop: Any, name: str) -> np.ndarray:
    if not _is_list(loop):
        raise InvalidArgumentError(f"{name} is {loop!r}; it must be a list of inputs")
    found = whole_numbers(loop, name)
    if found.ndim != 1 or not found.size:
        raise InvalidArgumentError(f"{name} has shape {found.shape}; it must be (inputs,), one at least")
    return found


def _is_list(thing: Any) -> bool:
    if isinstance(thing, np.ndarray):
        return thing.ndim > 0
    is_one = isinstance(thing, (str, bytes, numbers.Number))
    return not is_one and isinstance(thing, collections.abc.Sequence)


def _starts(lengths: Any) -> np.ndarray:
    return np.cumsum(np.fromiter((0, *lengths), np.int64))


def _markers_of(markers: Any, count: int) -> np.ndarray | None:
    if markers is None:
        return None
    found = whole_numbers(markers, "facet_markers")
    if found.shape != (count,):
        rule = f"it must be that of the facets, ({count},)"
        raise InvalidArgumentError(f"facet_markers has shape {found.shape}; {rule}")
    return found


def intersections(points: Any, facets: Any = None, segments: Any = None) -> list[Intersection]:
    """Find all pairs of facets and segments in space that meet in more than they share.

    They may share vertices and edges, by equal points. Facets that meet themselves or have no area
    are found, too. The test is exact. Where nothing is found, `mesh` can keep them; otherwise it
    refuses with the first.

    Parameters
    ----------
    points : array_like of float, shape (n, 3), or a surface
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
    found = _intersections(*_points_and_boundary(points, facets, segments))
    return [Intersection(kind, first, second, np.fromiter(x, np.float64)) for kind, first, second, x in found]


def odd_edges(points: Any, facets: Any = None) -> list[OddEdge]:
    """Find all edges of facets in space that are not one of two that run through them both ways.

    A closed surface has none if its facets are oriented alike: each edge is between two facets, one of
    which runs through it one way and the other one the other way. Triangles without an area have no
    edges; equal points are one.

    Parameters
    ----------
    points : array_like of float, shape (n, 3), or a surface
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
    return [OddEdge(*told) for told in _odd_edges(*_points_and_boundary(points, facets, None))]


def _points_and_boundary(points: Any, facets: Any, segments: Any) -> tuple[np.ndarray, tuple]:
    points, facets = points_and_facets(points, facets)
    rows = point_rows(points)
    boundary = boundary_of(segments, None, None, None, rows.shape[1])
    return rows, (*boundary, facets_of(facets, None))


def close_holes(points: Any, facets: Any = None, max_edges: int = 100) -> np.ndarray:
    """Find triangles that close the holes of a surface in space.

    A hole is a loop of edges at which one facet ends and no other begins. One of k edges is closed
    by k - 2 triangles between its points. Of all that could close it these are bent least, so that
    a flat facet that is missing is closed within its plane. A hole stays open if only a triangle
    that is there already, or one without an area, could close it. That the triangles do not cross
    others is not known before `intersections` or `mesh` are asked.

    Parameters
    ----------
    points : array_like of float, shape (n, 3), or a surface
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
    rows, boundary = _points_and_boundary(points, facets, None)
    if not isinstance(max_edges, numbers.Integral) or not 3 <= max_edges <= 1000:
        raise InvalidArgumentError(f"max_edges is {max_edges!r}; it must be a whole number from 3 to 1000")
    found = _close_holes(rows, boundary, int(max_edges))
    return np.fromiter(itertools.chain.from_iterable(found), np.int32).reshape(-1, 3)


def triangulate_facets(points: Any, facets: Any = None) -> tuple[np.ndarray, np.ndarray]:
    """Find the triangles that polygons consist of.

    For polygons that are not plane, which `mesh` refuses. The view of a polygon along an axis decides
    which triangles between its points it becomes: that of its plane or, if it has none, the first in
    which it does not meet itself, beginning with that in which it is largest. A polygon without an
    area becomes one triangle without one, which `mesh` refuses, or leaves out with
    ``crossings="split"``.

    Parameters
    ----------
    points : array_like of float, shape (n, 3), or a surface
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
    rows, boundary = _points_and_boundary(points, facets, None)
    triangles, parents = _triangulate_facets(rows, boundary)
    numbers_of_points = itertools.chain.from_iterable(triangles)
    return np.fromiter(numbers_of_points, np.int32).reshape(-1, 3), np.fromiter(parents, np.int32)


def merge_points(points: Any, ratio: float = 1e-9) -> np.ndarray:
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

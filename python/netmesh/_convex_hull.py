"""`ConvexHull`, with the names and meanings of SciPy's."""

from __future__ import annotations

import fractions
import functools
import math
from typing import Any, Optional

import numpy as np

from ._delaunay import Delaunay
from ._mesh import Mesh

#: Determinants below this part of their largest possible value have the sign of the exact one only.
_DOUBTFUL = 1e-12


class ConvexHull:
    """The convex hull of points in 2 to 8 dimensions, as `scipy.spatial.ConvexHull`.

    Which points are its vertices is decided exactly: none that is between others, and all that are
    not. It is made of Delaunay triangulations, which take longer than a hull alone, and far more
    memory above 4D.

    Parameters
    ----------
    points : array_like of float, shape (npoints, ndim)
    incremental, qhull_options
        Arguments with the meaning that `Delaunay` gives them.

    Attributes
    ----------
    points : ndarray of float64, shape (npoints, ndim)
    vertices : ndarray of int32, shape (nvertices,)
        The points that are vertices of the hull, of equal ones the first: ascending; in 2D
        counterclockwise.
    simplices : ndarray of int32, shape (nfacet, ndim)
        The points of the facets; those in one hyperplane are parted into simplices.
    neighbors : ndarray of int32, shape (nfacet, ndim)
        Entry k is the facet opposite vertex k.
    equations : ndarray of float64, shape (nfacet, ndim + 1)
        Outward normals and offsets of the facets: ``normal @ x + offset`` is negative inside.
    coplanar : ndarray of int32, shape (0, 3)
    volume, area : float
        Volume and surface area; in 2D area and perimeter.
    ndim, npoints, nsimplex : int
    min_bound, max_bound : ndarray of float64, shape (ndim,)

    Examples
    --------
    >>> import numpy as np
    >>> from netmesh import ConvexHull
    >>> hull = ConvexHull([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0], [0.3, 0.3]])
    >>> hull.vertices.tolist(), hull.volume, hull.area
    ([0, 1, 2, 3], 1.0, 4.0)
    """

    good = None

    def __init__(
        self, points: Any, incremental: bool = False, qhull_options: Optional[str] = None
    ) -> None:
        self._delaunay = Delaunay(points, False, incremental, qhull_options)
        self._make()

    def __repr__(self) -> str:
        return f"<netmesh.ConvexHull: dim {self.ndim}, {self.npoints} points, {self.nsimplex} facets>"

    def _make(self) -> None:
        tri = self._delaunay
        self.points = tri.points
        boundary = tri.mesh.hull.vertices
        corners = _corners(tri.mesh.points, boundary)
        if len(corners) == len(np.unique(boundary)):
            self._mesh, self._numbers = tri.mesh, tri._first_inputs
        else:
            self._mesh = Mesh._run(tri.mesh.points[corners], {"algorithm": "delaunay"})
            self._numbers = tri._first_inputs[corners]
        self._facets = self._mesh.hull.vertices
        self.simplices = self._numbers[self._facets]
        self.coplanar = np.zeros((0, 3), np.int32)

    @property
    def ndim(self) -> int:
        return self._delaunay.ndim

    @property
    def npoints(self) -> int:
        return self._delaunay.npoints

    @property
    def nsimplex(self) -> int:
        return len(self.simplices)

    @property
    def min_bound(self) -> np.ndarray:
        return self._delaunay.min_bound

    @property
    def max_bound(self) -> np.ndarray:
        return self._delaunay.max_bound

    @functools.cached_property
    def vertices(self) -> np.ndarray:
        if self.ndim != 2:
            return np.unique(self.simplices)
        # Facets of the plane have the inside on their left, or all of them on their right.
        after = dict(self.simplices.tolist())
        order = [min(after)]
        while after[order[-1]] != order[0]:
            order.append(after[order[-1]])
        around = self.points[order] - self.points[order[0]]
        x, y = (around / np.abs(around).max()).T
        turned = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
        found = order if turned > 0 else order[:1] + order[:0:-1]
        return np.fromiter(found, np.int32)

    @functools.cached_property
    def neighbors(self) -> np.ndarray:
        return _neighbors(self._facets)

    @functools.cached_property
    def equations(self) -> np.ndarray:
        corners = self.points[self.simplices]
        edges = corners[:, 1:] - corners[:, :1]
        # Squares of small lengths are no doubles.
        edges /= np.abs(edges).max(axis=2, keepdims=True)
        edges /= np.linalg.norm(edges, axis=2, keepdims=True)
        normals = np.linalg.svd(edges)[2][:, -1]
        # The middle of the vertices is inside.
        inside = self.points[self.vertices].mean(axis=0)
        normals *= -np.sign(np.einsum("fk,fk->f", normals, inside - corners[:, 0]))[:, None]
        return np.column_stack([normals, -np.einsum("fk,fk->f", normals, corners[:, 0])])

    @functools.cached_property
    def volume(self) -> float:
        return float(self._mesh.volumes.sum())

    @functools.cached_property
    def area(self) -> float:
        corners = self.points[self.simplices]
        edges = corners[:, 1:] - corners[:, :1]
        stretches = np.linalg.svd(edges, compute_uv=False)
        return float(stretches.prod(axis=1).sum()) / math.factorial(self.ndim - 1)

    def add_points(self, points: Any, restart: bool = False) -> None:
        """Add points: the hull of all is made anew, whatever `restart`.

        Examples
        --------
        >>> from netmesh import ConvexHull
        >>> hull = ConvexHull([[0, 0], [1, 0], [0, 1]], incremental=True)
        >>> hull.add_points([[1, 1]])
        >>> len(hull.vertices)
        4
        """
        self._delaunay.add_points(points, restart)
        for name in ("vertices", "neighbors", "equations", "volume", "area"):
            self.__dict__.pop(name, None)
        self._make()

    def close(self) -> None:
        """Accept no more points: `add_points` raises `StateError` from now on."""
        self._delaunay.close()


def _neighbors(facets: np.ndarray) -> np.ndarray:
    """Return the facet opposite each vertex of each facet of a hull."""
    count, ndim = facets.shape
    ridges = np.stack([np.delete(facets, k, axis=1) for k in range(ndim)], axis=1)
    rows = np.sort(ridges.reshape(-1, ndim - 1), axis=1)
    # Each ridge is one of two facets.
    pairs = np.lexsort(rows.T).reshape(-1, 2)
    found = np.empty(count * ndim, np.int32)
    found[pairs] = pairs[:, ::-1] // ndim
    return found.reshape(count, ndim)


def _corners(points: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Return the points on a hull, all of which its facets have, that are not between others.

    Facets in one hyperplane are a face. A point is a vertex of the hull if no other one is on all
    the faces that it is on.
    """
    faces = _faces(points, facets)
    of_points: dict = {}
    members: dict = {}
    for face, facet in zip(faces.tolist(), facets.tolist()):
        members.setdefault(face, set()).update(facet)
        for point in facet:
            of_points.setdefault(point, set()).add(face)
    ndim = points.shape[1]

    def is_corner(point: int) -> bool:
        own = of_points[point]
        # A face that is a simplex has vertices alone.
        if any(len(members[face]) == ndim for face in own):
            return True
        return len(set.intersection(*(members[face] for face in own))) == 1

    return np.fromiter((point for point in sorted(of_points) if is_corner(point)), np.int32)


def _faces(points: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Return for each facet of a hull the first one that is in the same face."""
    faces = np.arange(len(facets))
    neighbors = _neighbors(facets)
    first, k = np.nonzero(neighbors > np.arange(len(facets))[:, None])
    second = neighbors[first, k]
    # The vertex of the second facet that the first has not.
    is_shared = (facets[second][:, :, None] == facets[first][:, None, :]).any(axis=2)
    apex = facets[second, np.argmin(is_shared, axis=1)]
    edges = points[np.column_stack([facets[first][:, 1:], apex])] - points[facets[first][:, :1]]
    lengths = np.linalg.norm(edges, axis=2)
    doubtful = ~(np.abs(np.linalg.det(edges)) > _DOUBTFUL * lengths.prod(axis=1))
    for at in np.flatnonzero(doubtful):
        if _are_coplanar(points[facets[first[at]]], points[apex[at]]):
            a, b = sorted((_root(faces, first[at]), _root(faces, second[at])))
            faces[b] = a
    return np.fromiter((_root(faces, at) for at in range(len(faces))), np.int64)


def _root(faces: np.ndarray, at: int) -> int:
    while faces[at] != at:
        faces[at] = at = faces[faces[at]]
    return at


def _are_coplanar(facet: np.ndarray, point: np.ndarray) -> bool:
    """Tell exactly if a point is in the hyperplane of a facet."""
    last = [fractions.Fraction(x) for x in point.tolist()]
    rows = [[fractions.Fraction(x) - y for x, y in zip(row, last)] for row in facet.tolist()]
    for column in range(len(rows)):
        pivot = next((row for row in rows if row[column] != 0), None)
        if pivot is None:
            return True
        rows.remove(pivot)
        for row in rows:
            factor = row[column] / pivot[column]
            row[:] = [x - factor * y for x, y in zip(row, pivot)]
    return False

"""`ConvexHull`, with the names and meanings of SciPy's."""

from __future__ import annotations

import fractions
import functools
import math
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._delaunay import Delaunay
from ._incremental import Incremental
from ._mesh import Mesh
from ._scaling import scaled, scaled_rows, unscaled

#: Determinants below this part of their largest possible value have the sign of the exact one only.
_DOUBTFUL = 1e-12


class ConvexHull(Incremental):
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
    simplices: NDArray[np.int32]
    coplanar: NDArray[np.int32]

    def __init__(
        self, points: Any, incremental: bool = False, qhull_options: Optional[str] = None
    ) -> None:
        self._begin(points, False, incremental, qhull_options)

    def __repr__(self) -> str:
        return f"<netmesh.ConvexHull: dim {self.ndim}, {self.npoints} points, {self.nsimplex} facets>"

    def _make(self, points: np.ndarray) -> None:
        tri = Delaunay(points)
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
    def nsimplex(self) -> int:
        return len(self.simplices)

    @functools.cached_property
    def vertices(self) -> NDArray[np.int32]:
        if self.ndim != 2:
            return np.unique(self.simplices)
        # Facets of the plane have the inside on their left, or all of them on their right.
        after = dict(self.simplices.tolist())
        order = [min(after)]
        while after[order[-1]] != order[0]:
            order.append(after[order[-1]])
        corners = self._scaled[0][order]
        around = corners - corners[0]
        x, y = (around / np.abs(around).max()).T
        turned = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
        found = order if turned > 0 else order[:1] + order[:0:-1]
        return np.fromiter(found, np.int32)

    @functools.cached_property
    def neighbors(self) -> NDArray[np.int32]:
        return _neighbors(self._facets)

    @functools.cached_property
    def equations(self) -> NDArray[np.float64]:
        points, exponent = self._scaled
        corners = points[self.simplices]
        edges = scaled_rows(corners[:, 1:] - corners[:, :1])
        edges /= np.linalg.norm(edges, axis=2, keepdims=True)
        normals = np.linalg.svd(edges)[2][:, -1]
        # The middle of the vertices is inside.
        inside = points[self.vertices].mean(axis=0)
        normals *= -np.sign(np.einsum("fk,fk->f", normals, inside - corners[:, 0]))[:, None]
        offsets = -np.einsum("fk,fk->f", normals, corners[:, 0])
        return np.column_stack([normals, unscaled(offsets, exponent)])

    @functools.cached_property
    def volume(self) -> float:
        return float(self._mesh.volumes.sum())

    @functools.cached_property
    def area(self) -> float:
        points, exponent = self._scaled
        corners = points[self.simplices]
        stretches = np.linalg.svd(corners[:, 1:] - corners[:, :1], compute_uv=False)
        found = float(stretches.prod(axis=1).sum()) / math.factorial(self.ndim - 1)
        return float(unscaled(found, exponent * (self.ndim - 1)))

    @functools.cached_property
    def _scaled(self) -> tuple[np.ndarray, int]:
        return scaled(self.points)


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
    # Differences that are no doubles are infinite, their determinants not a number.
    with np.errstate(over="ignore", invalid="ignore"):
        edges = points[np.column_stack([facets[first][:, 1:], apex])] - points[facets[first][:, :1]]
        edges = scaled_rows(edges)
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

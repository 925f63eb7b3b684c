"""`Delaunay`, with the names and meanings of SciPy's."""

from __future__ import annotations

import functools
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._arrays import contiguous, query_points, tolerance
from ._errors import NonFiniteError
from ._incremental import Incremental
from ._mesh import Mesh
from ._scaling import scaled, unscaled


class Delaunay(Incremental):
    """The Delaunay triangulation of points in 2 to 8 dimensions, as `scipy.spatial.Delaunay`.

    It is exact: every point is a vertex unless it equals an earlier one, no simplex is flat, and
    `find_simplex` answers -1 outside the hull, there unless a tolerance is given, and nowhere else.

    Parameters
    ----------
    points : array_like of float, shape (npoints, ndim)
    furthest_site : bool
        Only False is supported.
    incremental : bool
        Allow `add_points`, which triangulates all points anew.
    qhull_options : str, optional
        Without effect: options that tell Qhull how to deal with rounding errors are accepted, others
        refused.
    threads : int
        Number of threads for queries; 0 for all cores.

    Attributes
    ----------
    points : ndarray of float64, shape (npoints, ndim)
    simplices : ndarray of int32, shape (nsimplex, ndim + 1)
        Indices of points, each simplex positively oriented (in 2D counterclockwise).
    neighbors : ndarray of int32, shape (nsimplex, ndim + 1)
        Entry k is the simplex opposite vertex k; -1 at the hull.
    equations : ndarray of float64, shape (nsimplex, ndim + 2)
        Normals and offsets of the hyperplanes through the lifted simplices.
    paraboloid_scale, paraboloid_shift : float
        Scale and shift of the paraboloid that points are lifted to.
    transform : ndarray of float64, shape (nsimplex, ndim + 1, ndim)
        ``transform[i, :ndim] @ (x - transform[i, ndim])`` are the first ndim barycentric coordinates
        of x in simplex i. NaN where the simplex is too flat for doubles.
    vertex_to_simplex : ndarray of int32, shape (npoints,)
        A simplex of each point, or of the point that it equals.
    convex_hull : ndarray of int32, shape (nfaces, ndim)
        The facets of the hull.
    coplanar : ndarray of int32, shape (ncoplanar, 3)
        Points that are no vertices because they equal an earlier one: the point, a simplex of that
        vertex, the vertex.
    vertex_neighbor_vertices : tuple of two ndarrays of int32, (indptr, indices)
        The neighbours of point k are ``indices[indptr[k]:indptr[k+1]]``.
    ndim, npoints, nsimplex : int
    min_bound, max_bound : ndarray of float64, shape (ndim,)
    mesh : Mesh
        The triangulation of the distinct points.

    Examples
    --------
    >>> import numpy as np
    >>> from netmesh import Delaunay
    >>> points = np.array([[0, 0], [0, 1.1], [1, 0], [1, 1]])
    >>> tri = Delaunay(points)
    >>> tri.simplices.shape, tri.neighbors.shape
    ((2, 3), (2, 3))
    >>> tri.find_simplex([[0.1, 0.2], [1.5, 0.5]]) >= 0
    array([ True, False])

    The barycentric coordinates of a point:

    >>> x = np.array([0.1, 0.2])
    >>> i = tri.find_simplex(x)
    >>> b = tri.transform[i, :2] @ (x - tri.transform[i, 2])
    >>> np.allclose(np.append(b, 1 - b.sum()) @ points[tri.simplices[i]], x)
    True
    """

    def __init__(
        self,
        points: Any,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: Optional[str] = None,
        *,
        threads: int = 1,
    ) -> None:
        self.furthest_site = False
        self.threads = threads
        self._begin(points, furthest_site, incremental, qhull_options)

    def __repr__(self) -> str:
        return f"<netmesh.Delaunay: dim {self.ndim}, {self.npoints} points, {self.nsimplex} simplices>"

    def _make(self, points: np.ndarray) -> None:
        self.mesh = Mesh._run(points, {"algorithm": "delaunay"})
        # The caller may change the array that was given.
        self.points = self.mesh.points if self._is_distinct else self.mesh._core.input_points()

    @property
    def _is_distinct(self) -> bool:
        return len(self.mesh.points) == len(self.mesh.input_vertices)

    @property
    def nsimplex(self) -> int:
        return len(self.mesh.simplices)

    @property
    def _first_inputs(self) -> NDArray[np.int32]:
        """Array from each vertex of the mesh to the first of the points that it is."""
        return self.mesh.vertex_inputs

    @functools.cached_property
    def simplices(self) -> NDArray[np.int32]:
        simplices = self.mesh.simplices
        return simplices.copy() if self._is_distinct else self._first_inputs[simplices]

    @functools.cached_property
    def neighbors(self) -> NDArray[np.int32]:
        return self.mesh.neighbors.copy()

    @functools.cached_property
    def vertex_to_simplex(self) -> NDArray[np.int32]:
        mesh = self.mesh
        of_vertices = np.empty(len(mesh.points), np.int32)
        # The first of several simplices remains.
        simplices = np.repeat(np.arange(self.nsimplex, dtype=np.int32), self.ndim + 1)
        of_vertices[mesh.simplices.ravel()[::-1]] = simplices[::-1]
        return of_vertices[mesh.input_vertices]

    @functools.cached_property
    def coplanar(self) -> NDArray[np.int32]:
        own = self._first_inputs[self.mesh.input_vertices]
        points = np.flatnonzero(own != np.arange(self.npoints)).astype(np.int32)
        return np.column_stack([points, self.vertex_to_simplex[points], own[points]])

    @functools.cached_property
    def convex_hull(self) -> NDArray[np.int32]:
        return self._first_inputs[self.mesh.hull.vertices]

    @functools.cached_property
    def vertex_neighbor_vertices(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        starts, neighbors = self.mesh.vertex_neighbors
        if self._is_distinct:
            return starts.astype(np.int32), neighbors.copy()
        # Points that are no vertices have none; the others keep the order of the vertices.
        counts = np.zeros(self.npoints + 1, np.int32)
        counts[self._first_inputs + 1] = np.diff(starts)
        return np.cumsum(counts, dtype=np.int32), self._first_inputs[neighbors]

    @functools.cached_property
    def _scaled(self) -> tuple[NDArray[np.float64], int]:
        """Vertices over a power of two, whose squares are doubles, and its exponent."""
        return scaled(self.mesh.points)

    @functools.cached_property
    def _inverse_edges(self) -> NDArray[np.float64]:
        """Inverses of the edges to the last corner of each simplex, of the scaled vertices."""
        corners = self._scaled[0][self.mesh.simplices]
        return _inverses(np.swapaxes(corners[:, :-1] - corners[:, -1:], 1, 2))

    @functools.cached_property
    def transform(self) -> NDArray[np.float64]:
        transform = np.empty((self.nsimplex, self.ndim + 1, self.ndim))
        transform[:, :-1] = unscaled(self._inverse_edges, -self._scaled[1])
        last = self.mesh.points[self.mesh.simplices[:, -1]]
        transform[:, -1] = np.where(np.isnan(transform[:, 0, :1]), np.nan, last)
        return transform

    @functools.cached_property
    def _paraboloid(self) -> tuple[float, float]:
        """Scale and shift that bring squares to the range of the scaled coordinates, as Qhull's Qbb does."""
        points = self._scaled[0]
        squares = np.einsum("ij,ij->i", points, points)
        # Qhull's point at infinity, which its Qz adds, is lifted a tenth higher than the others.
        low, high = squares.min(), 1.1 * squares.max()
        scale = np.abs(points).max() / (high - low)
        return float(scale), float(-low * scale)

    @property
    def paraboloid_scale(self) -> float:
        return float(unscaled(self._paraboloid[0], -self._scaled[1]))

    @property
    def paraboloid_shift(self) -> float:
        return float(unscaled(self._paraboloid[1], self._scaled[1]))

    @functools.cached_property
    def _scaled_equations(self) -> NDArray[np.float64]:
        scale, shift = self._paraboloid
        corners = self._scaled[0][self.mesh.simplices]
        last = corners[:, -1]
        # Squares of edges' ends differ by this product, of which less is lost than of the difference.
        products = np.einsum("sjk,sjk->sj", corners[:, :-1] - last[:, None], corners[:, :-1] + last[:, None])
        gradients = scale * np.einsum("sj,sjk->sk", products, self._inverse_edges)
        heights = scale * np.einsum("sk,sk->s", last, last) + shift
        offsets = heights - np.einsum("sk,sk->s", gradients, last)
        equations = np.column_stack([gradients, np.full(self.nsimplex, -1.0), offsets])
        return equations / np.linalg.norm(equations[:, :-1], axis=1, keepdims=True)

    @functools.cached_property
    def equations(self) -> NDArray[np.float64]:
        equations = self._scaled_equations.copy()
        equations[:, -1] = unscaled(equations[:, -1], self._scaled[1])
        return equations

    def lift_points(self, x: Any) -> NDArray[np.float64]:
        """Lift points to the paraboloid: shape (..., ndim) to (..., ndim + 1).

        Examples
        --------
        >>> from netmesh import Delaunay
        >>> Delaunay([[0, 0], [1, 0], [0, 1]]).lift_points([[0.5, 0.5]]).shape
        (1, 3)
        """
        x = query_points(x, self.ndim, "x")
        heights = unscaled(self._lifted(x)[..., -1:], self._scaled[1])
        return np.concatenate([x, heights], axis=-1)

    def _lifted(self, x: np.ndarray) -> NDArray[np.float64]:
        """Return the lifted points, all of it scaled."""
        x = unscaled(x, -self._scaled[1])
        scale, shift = self._paraboloid
        heights = scale * np.einsum("...i,...i->...", x, x) + shift
        return np.concatenate([x, heights[..., None]], axis=-1)

    def plane_distance(self, xi: Any) -> NDArray[np.float64]:
        """Measure how far lifted points are from the hyperplanes of all simplices.

        Shape (..., ndim) to (..., nsimplex). Positive where the simplex's circumball holds the point.

        Examples
        --------
        >>> from netmesh import Delaunay
        >>> Delaunay([[0, 0], [1, 0], [0, 1]]).plane_distance([[0.5, 0.5], [2, 2]]) > 0
        array([[ True],
               [False]])
        """
        lifted, equations = self._lifted(query_points(xi, self.ndim, "xi")), self._scaled_equations
        return unscaled(lifted @ equations[:, :-1].T + equations[:, -1], self._scaled[1])

    def find_simplex(
        self, xi: Any, bruteforce: bool = False, tol: Optional[float] = None
    ) -> NDArray[np.int32]:
        """Find the simplices that hold points, by exact signs.

        Parameters
        ----------
        xi : array_like of float, shape (..., ndim)
            In any order. A point with a coordinate that is not finite is outside.
        bruteforce
            Without effect: the answer does not depend on a path.
        tol : float, optional
            A point that no simplex holds belongs to the one in which its barycentric coordinates leave
            the range from 0 to 1 the least, if that is by at most `tol`. By default 0; SciPy's default
            is 2.2e-14.

        Returns
        -------
        ndarray of int32, shape (...)
            -1 outside. On a face that several simplices share, the least of them.

        Examples
        --------
        >>> from netmesh import Delaunay
        >>> tri = Delaunay([[0, 0], [1, 0], [0, 1]])
        >>> tri.find_simplex([[0.5, 0.5], [2, 2]])
        array([ 0, -1], dtype=int32)
        >>> tri.find_simplex([0.5, -0.01]), tri.find_simplex([0.5, -0.01], tol=0.02)
        (array(-1, dtype=int32), array(0, dtype=int32))
        """
        xi = query_points(xi, self.ndim, "xi")
        if tol is not None:
            allowed = tolerance(tol, "tol", 0.0)
            found, _ = self._places(xi.reshape(-1, self.ndim), allowed, self.threads)
            return found.reshape(xi.shape[:-1])
        try:
            return self.mesh.locate(xi, threads=self.threads)
        except NonFiniteError:
            finite = np.isfinite(xi).all(axis=-1)
            found = np.full(xi.shape[:-1], -1, np.int32)
            found[finite] = self.mesh.locate(xi[finite], threads=self.threads)
            return found

    def _places(
        self, rows: np.ndarray, allowed: float, threads: int
    ) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Return the simplices that hold points, -1 outside, and barycentric coordinates there."""
        weigh = self.mesh._core.weigh
        finite = np.isfinite(rows).all(axis=1)
        if finite.all():
            return weigh(rows, allowed, threads)
        simplices = np.full(len(rows), -1, np.int32)
        weights = np.full((len(rows), self.ndim + 1), np.nan)
        simplices[finite], weights[finite] = weigh(contiguous(rows[finite]), allowed, threads)
        return simplices, weights


def _inverses(matrices: np.ndarray) -> np.ndarray:
    """Return the inverse of each matrix; NaN where rounding errors would exceed a thousandth."""
    try:
        inverses = np.linalg.inv(matrices)
    except np.linalg.LinAlgError:
        # Determinants may be too small for doubles.
        singular = np.linalg.slogdet(matrices)[0] == 0
        inverses = np.full_like(matrices, np.nan)
        inverses[~singular] = np.linalg.inv(matrices[~singular])
    norms = [np.abs(of).sum(axis=1).max(axis=1) for of in (matrices, inverses)]
    ill = ~(norms[0] * norms[1] < 1e-3 / np.finfo(float).eps)
    inverses[ill] = np.nan
    return inverses

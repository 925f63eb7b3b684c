"""`LinearNDInterpolator`, with the names and meanings of SciPy's, and what it shares with others."""

from __future__ import annotations

import sys
from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ._arrays import array, contiguous, coordinates, number, point_rows, tolerance, value_columns
from ._delaunay import Delaunay
from ._errors import InvalidArgumentError, NonFiniteError
from ._point_index import PointIndex


class SimplexInterpolator:
    """Values at the vertices of a triangulation, elsewhere: what its two kinds share.

    The triangulation is a `Delaunay` or SciPy's.
    """

    points: NDArray[np.float64]
    values: NDArray[Any]

    def _take(self, points: Any, values: Any, fill_value: Any, rescale: bool) -> None:
        """Triangulate the points, unless they are a triangulation, and check the values."""
        self.offset: Optional[np.ndarray] = None
        self.scale: Optional[np.ndarray] = None
        if isinstance(points, Delaunay) or is_scipys(points):
            if rescale:
                message = "Rescaling is not supported when passing a Delaunay triangulation as "
                raise InvalidArgumentError(message + "``points``.")
            self.tri: Any = points
        else:
            points = coordinates((points,), "points")
            if points.ndim != 2:
                message = f"points has shape {points.shape}; it must be (npoints, ndim)"
                raise InvalidArgumentError(message)
            points, self.offset, self.scale = rescaled(point_rows(points), rescale)
            self.tri = Delaunay(points)
        self.points = self.tri.points
        columns = value_columns(values, len(self.points), "point")
        given = array(values, "values")
        self.is_complex = given.dtype.kind == "c"
        self.values_shape = given.shape[1:]
        self.values = columns.view(np.complex128) if self.is_complex else columns
        self.fill_value = self._fill_value(fill_value)
        self._of_vertices = self._at_vertices(columns)

    def _take_rules(self, tol: Any, name: str, outside: str, threads: int) -> None:
        """Check the rules for points at the hull and outside; SciPy's tolerance is the default."""
        self.simplex_tol = tolerance(tol, name, 100 * float(np.finfo(float).eps))
        if outside not in ("fill", "nearest"):
            raise InvalidArgumentError(f"outside is {outside!r}; it must be 'fill' or 'nearest'")
        self.outside = outside
        self.threads = threads

    def __call__(self, *args: Any) -> NDArray[Any]:
        """Evaluate at points.

        Parameters
        ----------
        x1, x2, ... xn : array_like of float, broadcastable; or one array of shape (..., ndim)

        Returns
        -------
        ndarray of float64 or complex128
            The shape of the points, then that of values without the first axis.
        """
        ndim = self.points.shape[1]
        xi = coordinates(args, "xi", ndim)
        if self.scale is not None:
            xi = (xi - self.offset) / self.scale
        if not self.values.shape[1]:
            return np.zeros(xi.shape[:-1] + self.values_shape, self.values.dtype)
        rows = contiguous(xi.reshape(-1, ndim))
        columns, outside = self._inside(rows)
        out = columns.view(np.complex128) if self.is_complex else columns
        out[outside] = self.fill_value
        # A question of the library has a cost of its own, however few points it has.
        if self.outside == "nearest" and len(outside):
            outside = outside[np.isfinite(rows[outside]).all(axis=1)]
            out[outside] = self.values[self._nearest_points(rows[outside])]
        return out.reshape(xi.shape[:-1] + self.values_shape)

    def __repr__(self) -> str:
        count, dim = self.points.shape
        return f"<netmesh.{type(self).__name__}: dim {dim}, {count} points>"

    def _inside(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the columns of values, and the numbers of the rows that are outside."""
        raise NotImplementedError

    def _fill_value(self, given: Any) -> Any:
        value = array(given, "fill_value")
        if value.ndim != 0:
            raise InvalidArgumentError(f"fill_value has shape {value.shape}; it must be a number")
        if self.is_complex and value.dtype.kind == "c":
            return value.astype(np.complex128)[()]
        return self.values.dtype.type(number(given, "fill_value"))

    @property
    def _is_scipys(self) -> bool:
        return not isinstance(self.tri, Delaunay)

    def _at_vertices(self, of_points: np.ndarray) -> np.ndarray:
        """Return what points have, at the vertices of the triangulation."""
        is_same = self._is_scipys or self.tri._is_distinct
        return of_points if is_same else of_points[self.tri._first_inputs]

    def _places(self, rows: np.ndarray) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Return the simplices that hold points, -1 outside, and barycentric coordinates inside."""
        if not self._is_scipys:
            return self.tri._places(rows, self.simplex_tol, self.threads)
        simplices = self.tri.find_simplex(rows, tol=self.simplex_tol)
        transform = self.tri.transform[simplices]
        first = np.einsum("nij,nj->ni", transform[:, :-1], rows - transform[:, -1])
        return simplices, np.column_stack([first, 1 - first.sum(axis=1)])

    def _nearest_points(self, rows: np.ndarray) -> NDArray[np.int32]:
        if not self._is_scipys:
            return self.tri._first_inputs[self.tri.mesh.nearest(rows, threads=self.threads)[0]]
        if not hasattr(self, "_index"):
            self._index = PointIndex(self.points)
        return self._index.nearest(rows, self.threads)[0]


class LinearNDInterpolator(SimplexInterpolator):
    """Piecewise linear interpolation in 2 to 8 dimensions, as `scipy.interpolate`'s.

    Parameters
    ----------
    points : array_like of float, shape (npoints, ndim); a tuple of ndim arrays; or a triangulation
        A `Delaunay`, or SciPy's: values are then linear in the simplices that it has.
    values : array_like of float or complex, shape (npoints, ...)
        Of points that are equal the first one's count.
    fill_value : float
        Value of points outside the hull.
    rescale : bool
        Bring the points to the unit cube first, for axes whose units have nothing to do with each
        other.
    tol : float, optional
        Barycentric coordinates from ``-tol`` to ``1 + tol`` count as inside: see
        `Delaunay.find_simplex`. By default 2.2e-14, as in SciPy, so that points which are on the hull
        but for a rounding have a value; 0 for exact answers.
    outside : {'fill', 'nearest'}
        Points outside get `fill_value`, or the value of the nearest point.
    threads : int
        0 for all cores.

    Attributes
    ----------
    tri : Delaunay or scipy.spatial.Delaunay
    points : ndarray of float64, shape (npoints, ndim)
        Points as they were triangulated: scaled, if `rescale` is given.
    values : ndarray of float64 or complex128, shape (npoints, components)

    Examples
    --------
    >>> import numpy as np
    >>> from netmesh import LinearNDInterpolator
    >>> rng = np.random.default_rng(1)
    >>> x, y = rng.random(50), rng.random(50)
    >>> f = LinearNDInterpolator(list(zip(x, y)), 3 * x - y)
    >>> np.allclose(f(0.5, 0.25), 1.25), bool(np.isnan(f([[7, 7]])[0]))
    (True, True)
    """

    def __init__(
        self,
        points: Any,
        values: Any,
        fill_value: Union[float, complex] = np.nan,
        rescale: bool = False,
        *,
        tol: Optional[float] = None,
        outside: Literal["fill", "nearest"] = "fill",
        threads: int = 1,
    ) -> None:
        self._take_rules(tol, "tol", outside, threads)
        self._take(points, values, fill_value, rescale)

    def _inside(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        if self._is_scipys:
            out = np.full((len(rows), self._of_vertices.shape[1]), np.nan)
            missing = np.arange(len(rows))
        else:
            out = self._interpolated(rows)
            # Values may be NaN inside the hull too.
            missing = np.flatnonzero(np.isnan(out).any(axis=1))
            if not len(missing):
                return out, missing
        simplices, weights = self._places(rows[missing])
        is_found = simplices != -1
        vertices = self._simplices[simplices[is_found]]
        out[missing[is_found]] = combined(weights[is_found], self._of_vertices[vertices])
        return out, missing[~is_found]

    @property
    def _simplices(self) -> np.ndarray:
        return self.tri.simplices if self._is_scipys else self.tri.mesh.simplices

    def _interpolated(self, rows: np.ndarray) -> np.ndarray:
        evaluate = self.tri.mesh._core.interpolate
        try:
            return evaluate(self._of_vertices, rows, "linear", "nan", self.threads)
        except NonFiniteError:
            finite = np.isfinite(rows).all(axis=1)
            out = np.full((len(rows), self._of_vertices.shape[1]), np.nan)
            out[finite] = evaluate(self._of_vertices, rows[finite], "linear", "nan", self.threads)
            return out


def is_scipys(value: Any) -> bool:
    """Tell if a value is a Delaunay triangulation of SciPy's, without importing that."""
    spatial = sys.modules.get("scipy.spatial")
    return spatial is not None and isinstance(value, spatial.Delaunay)


def rescaled(points: np.ndarray, rescale: bool) -> tuple:
    """Return points, brought to the unit cube if asked to, and the offset and scale of that."""
    if not rescale or len(points) == 0:
        return points, None, None
    offset, extent = points.mean(axis=0), np.ptp(points, axis=0)
    scale = np.where(extent > 0, extent, 1.0)
    return (points - offset) / scale, offset, scale


def combined(weights: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Combine values, shape (n, vertices, columns), by weights; a weight of zero hides NaN."""
    weights = weights[:, :, None]
    return np.where(weights == 0, 0.0, weights * values).sum(axis=1)

"""`LinearNDInterpolator`, with the names and meanings of SciPy's."""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np

from ._arrays import array, coordinates, number, point_rows, value_columns
from ._delaunay import Delaunay
from ._errors import InvalidArgumentError, NonFiniteError


class LinearNDInterpolator:
    """Piecewise linear interpolation in 2 to 8 dimensions, as `scipy.interpolate`'s.

    Parameters
    ----------
    points : array_like of float, shape (npoints, ndim); a tuple of ndim arrays; or Delaunay
    values : array_like of float or complex, shape (npoints, ...)
        Of points that are equal the first one's count.
    fill_value : float
        Value of points outside the hull.
    rescale : bool
        Bring the points to the unit cube first, for axes whose units have nothing to do with each
        other.
    threads : int
        0 for all cores.

    Attributes
    ----------
    tri : Delaunay
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
        threads: int = 1,
    ) -> None:
        self.offset: Optional[np.ndarray] = None
        self.scale: Optional[np.ndarray] = None
        if isinstance(points, Delaunay):
            if rescale:
                message = "Rescaling is not supported when passing a Delaunay triangulation as "
                raise InvalidArgumentError(message + "``points``.")
            self.tri = points
        else:
            points = coordinates((points,), "points")
            if points.ndim != 2:
                message = f"points has shape {points.shape}; it must be (npoints, ndim)"
                raise InvalidArgumentError(message)
            points = point_rows(points)
            if rescale and len(points) > 0:
                self.offset = points.mean(axis=0)
                extent = np.ptp(points, axis=0)
                self.scale = np.where(extent > 0, extent, 1.0)
                points = (points - self.offset) / self.scale
            self.tri = Delaunay(points)
        self.threads = threads
        self.points = self.tri.points
        columns = value_columns(values, len(self.points), "point")
        given = array(values, "values")
        self.is_complex = given.dtype.kind == "c"
        self.values_shape = given.shape[1:]
        self.values = columns.view(np.complex128) if self.is_complex else columns
        self.fill_value = self._fill_value(fill_value)
        tri = self.tri
        self._of_vertices = columns if tri._is_distinct else columns[tri._first_inputs]

    def __call__(self, *args: Any) -> np.ndarray:
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
        rows = np.ascontiguousarray(xi.reshape(-1, ndim))
        columns = self._at(rows)
        out = columns.view(np.complex128) if self.is_complex else columns
        if not np.isnan(self.fill_value):
            # Values may be NaN inside the hull too.
            missing = np.flatnonzero(np.isnan(out).any(axis=1))
            outside = missing[self.tri.find_simplex(rows[missing]) == -1]
            out[outside] = self.fill_value
        return out.reshape(xi.shape[:-1] + self.values_shape)

    def _fill_value(self, given: Any) -> Any:
        value = array(given, "fill_value")
        if value.ndim != 0:
            raise InvalidArgumentError(f"fill_value has shape {value.shape}; it must be a number")
        if self.is_complex and value.dtype.kind == "c":
            return value.astype(np.complex128)[()]
        return self.values.dtype.type(number(given, "fill_value"))

    def _at(self, rows: np.ndarray) -> np.ndarray:
        evaluate = self.tri.mesh._core.interpolate
        try:
            return evaluate(self._of_vertices, rows, "linear", "nan", self.threads)
        except NonFiniteError:
            finite = np.isfinite(rows).all(axis=1)
            out = np.full((len(rows), self._of_vertices.shape[1]), np.nan)
            out[finite] = evaluate(self._of_vertices, rows[finite], "linear", "nan", self.threads)
            return out

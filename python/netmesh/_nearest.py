"""`NearestNDInterpolator`, with the names and meanings of SciPy's."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._arrays import array, contiguous, coordinates, number, point_rows, require_finite, value_columns
from ._errors import ArgumentTypeError, DimensionError, InvalidArgumentError
from ._interpolator import rescaled
from ._point_index import PointIndex

#: Options of a query that SciPy's trees have, which change no exact answer, or are used here.
_QUERY_OPTIONS = ("eps", "p", "distance_upper_bound", "workers")


class NearestNDInterpolator:
    """The value of the nearest point, in 2 to 8 dimensions, as `scipy.interpolate`'s.

    Of points at the same exact distance the first one counts.

    Parameters
    ----------
    x : array_like of float, shape (npoints, ndim); or a tuple of ndim arrays
        They may be equal, and in one plane.
    y : array_like of float or complex, shape (npoints, ...)
    rescale : bool
        Bring the points to the unit cube first.
    tree_options : dict, optional
        Without effect: options of SciPy's tree, which is not the one that is used.
    threads : int
        0 for all cores.

    Attributes
    ----------
    points : ndarray of float64, shape (npoints, ndim)
        Points as they are searched: scaled, if `rescale` is given.
    values : ndarray of float64, complex128 or complex64, shape (npoints, ...)

    Examples
    --------
    >>> from netmesh import NearestNDInterpolator
    >>> f = NearestNDInterpolator([[0, 0], [1, 0], [0, 1]], [10, 20, 30])
    >>> f([[0.9, 0.2], [-5, 3]])
    array([20., 30.])
    """

    points: NDArray[np.float64]
    values: NDArray[Any]

    def __init__(
        self,
        x: Any,
        y: Any,
        rescale: bool = False,
        tree_options: Optional[dict] = None,
        *,
        threads: int = 1,
    ) -> None:
        points = coordinates((x,), "x")
        if points.ndim != 2 or len(points) == 0:
            raise InvalidArgumentError(f"x has shape {points.shape}; it must be (npoints, ndim)")
        if not 2 <= points.shape[1] <= 8:
            raise DimensionError(f"x has shape {points.shape}; points must have 2 to 8 coordinates")
        require_finite(points, "x")
        self.points, self.offset, self.scale = rescaled(point_rows(points), rescale)
        self._index = PointIndex(self.points)
        given = array(y, "y")
        columns = value_columns(y, len(points), "point", "y")
        found = columns.view(np.complex128) if given.dtype.kind == "c" else columns
        # As in SciPy single precision stays single, if it is complex.
        found = found.astype(np.complex64) if given.dtype == np.complex64 else found
        self.values = found.reshape(given.shape)
        self.threads = threads

    def __call__(self, *args: Any, **query_options: Any) -> NDArray[Any]:
        """Evaluate at points.

        Parameters
        ----------
        x1, x2, ... xn : array_like of float, broadcastable; or one array of shape (..., ndim)
        distance_upper_bound : float, optional
            Points whose nearest one is not nearer than this get NaN.
        workers : int, optional
            Number of threads for this call; -1 for all cores.
        eps, p : float, optional
            Answers are exact whatever `eps`; `p` must be 2.

        Returns
        -------
        ndarray of float64, complex128 or complex64
            The shape of the points, then that of values without the first axis.
        """
        bound, threads = self._options(query_options)
        ndim = self.points.shape[1]
        xi = coordinates(args, "xi", ndim)
        require_finite(xi.reshape(-1, ndim), "xi")
        if self.scale is not None:
            xi = (xi - self.offset) / self.scale
        found, distances = self._index.nearest(contiguous(xi.reshape(-1, ndim)), threads)
        out = self.values[found]
        out[~(distances < bound)] = np.nan
        return out.reshape(xi.shape[:-1] + self.values.shape[1:])

    def __repr__(self) -> str:
        count, dim = self.points.shape
        return f"<netmesh.NearestNDInterpolator: dim {dim}, {count} points>"

    def _options(self, given: dict) -> tuple[float, int]:
        for name in given:
            if name not in _QUERY_OPTIONS:
                known = ", ".join(_QUERY_OPTIONS)
                raise ArgumentTypeError(f"{name} is no option of a query; these are: {known}")
        if given.get("p", 2) != 2:
            raise InvalidArgumentError(f"p is {given['p']}; only 2, the Euclidean distance, is supported")
        # No distance is too large without a bound.
        bound = float(np.finfo(float).max)
        if "distance_upper_bound" in given:
            bound = min(number(given["distance_upper_bound"], "distance_upper_bound"), bound)
        workers = given.get("workers", None)
        if workers is None:
            return bound, self.threads
        if isinstance(workers, bool) or not isinstance(workers, (int, np.integer)):
            kind = type(workers).__name__
            raise ArgumentTypeError(f"workers is of type {kind}; it must be a whole number")
        if workers < -1:
            raise InvalidArgumentError(f"workers is {workers}; it must be -1 or more")
        return bound, max(int(workers), 0)

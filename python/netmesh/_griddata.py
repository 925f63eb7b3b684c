"""`griddata`, with the names and meanings of SciPy's."""

from __future__ import annotations

from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ._arrays import coordinates
from ._clough_tocher import CloughTocher2DInterpolator
from ._delaunay import Delaunay
from ._errors import InvalidArgumentError
from ._interpolator import LinearNDInterpolator, is_scipys
from ._nearest import NearestNDInterpolator


def griddata(
    points: Any,
    values: Any,
    xi: Any,
    method: Literal["linear", "nearest", "cubic"] = "linear",
    fill_value: Union[float, complex] = np.nan,
    rescale: bool = False,
    *,
    tol: Optional[float] = None,
    outside: Literal["fill", "nearest"] = "fill",
    threads: int = 1,
) -> NDArray[Any]:
    """Interpolate values at points elsewhere, as `scipy.interpolate.griddata`.

    Parameters
    ----------
    points : array_like of float, shape (npoints, ndim); a tuple of ndim arrays; or a triangulation
        In 2 to 8 dimensions; those of one are SciPy's own `griddata`, which must be installed for
        it. For 'linear' and 'cubic' a `Delaunay` will do, or SciPy's.
    values : array_like of float or complex, shape (npoints, ...)
    xi : array_like of float, shape (..., ndim); or a tuple of ndim arrays that broadcast
    method : {'linear', 'nearest', 'cubic'}
        `LinearNDInterpolator`, `NearestNDInterpolator` or, for points of the plane,
        `CloughTocher2DInterpolator`.
    fill_value : float
        Value outside the hull. Without effect for 'nearest'.
    rescale : bool
        Bring the points to the unit cube first.
    tol : float, optional
        Tolerance at the hull, as of `LinearNDInterpolator`.
    outside : {'fill', 'nearest'}
        Points outside get `fill_value`, or the value of the nearest point.
    threads : int
        0 for all cores.

    Returns
    -------
    ndarray of float64 or complex128
        The shape of the points `xi`, then that of values without the first axis.

    Examples
    --------
    >>> import numpy as np
    >>> from netmesh import griddata
    >>> points = np.random.default_rng(1).random((200, 2))
    >>> x, y = np.mgrid[0:1:5j, 0:1:5j]
    >>> grid = griddata(points, points @ [2, 3], (x, y), method="cubic", outside="nearest")
    >>> grid.shape, bool(np.allclose(grid[1:4, 1:4], (2 * x + 3 * y)[1:4, 1:4]))
    ((5, 5), True)
    """
    rules: dict = {"outside": outside, "threads": threads}
    is_triangulated = isinstance(points, Delaunay) or is_scipys(points)
    if not is_triangulated:
        given = points
        points = coordinates((points,), "points")
        if points.ndim == 2 and points.shape[1] == 1:
            return _of_one_dimension(given, values, xi, method, fill_value, rescale)
    if method == "linear":
        return LinearNDInterpolator(points, values, fill_value, rescale, tol=tol, **rules)(xi)
    if method == "cubic":
        made = CloughTocher2DInterpolator(
            points, values, fill_value, rescale=rescale, simplex_tol=tol, **rules
        )
        return made(xi)
    if method != "nearest":
        message = f"method is {method!r}; it must be 'linear', 'nearest' or 'cubic'"
        raise InvalidArgumentError(message)
    points = points.points if is_triangulated else points
    return NearestNDInterpolator(points, values, rescale, threads=threads)(xi)


def _of_one_dimension(points: Any, values: Any, xi: Any, *others: Any) -> np.ndarray:
    import scipy.interpolate

    return scipy.interpolate.griddata(points, values, xi, *others)

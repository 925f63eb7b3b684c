"""`CloughTocher2DInterpolator`, with the names and meanings of SciPy's."""

from __future__ import annotations

import warnings
from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ._arrays import contiguous, number
from ._errors import GradientEstimationWarning, InvalidArgumentError
from ._interpolator import SimplexInterpolator
from ._netmesh import cubic, estimate_gradients


class CloughTocher2DInterpolator(SimplexInterpolator):
    """Smooth interpolation in the plane by piecewise cubics, as `scipy.interpolate`'s.

    The gradient is continuous. At the points it is the one that makes cubic curves along the edges
    bend the least in all (Nielson 1983, Renka and Cline 1984); in each triangle the function is that
    of Clough and Tocher. On a triangulation of SciPy's the values are SciPy's, up to roundings.

    Parameters
    ----------
    points : array_like of float, shape (npoints, 2); a tuple of 2 arrays; or a triangulation
        A `Delaunay`, or SciPy's.
    values : array_like of float or complex, shape (npoints, ...)
        Of points that are equal the first one's count.
    fill_value : float
        Value of points outside the hull.
    tol : float
        Change of gradients, absolute where they are below 1 and relative above, at which they count
        as converged.
    maxiter : int
        Largest number of sweeps in which gradients are estimated; `GradientEstimationWarning` tells
        where that was too few.
    rescale : bool
        Bring the points to the unit square first, for axes whose units have nothing to do with each
        other.
    simplex_tol : float, optional
        Tolerance at the hull, which `LinearNDInterpolator` calls `tol`: 2.2e-14 by default; 0 for
        exact answers.
    outside : {'fill', 'nearest'}
        Points outside get `fill_value`, or the value of the nearest point.
    threads : int
        Number of threads for evaluation; 0 for all cores.

    Attributes
    ----------
    tri : Delaunay or scipy.spatial.Delaunay
    points : ndarray of float64, shape (npoints, 2)
        Points as they were triangulated: scaled, if `rescale` is given.
    values : ndarray of float64 or complex128, shape (npoints, components)
    grad : ndarray of float64 or complex128, shape (npoints, components, 2)
        Gradients at the points, with respect to scaled coordinates if `rescale` is given. What is
        written here counts from the next evaluation on.

    Examples
    --------
    >>> import numpy as np
    >>> from netmesh import CloughTocher2DInterpolator, LinearNDInterpolator
    >>> points, x = np.random.default_rng(1).random((2, 5000, 2))
    >>> x = 0.1 + 0.8 * x
    >>> wave = lambda p: np.sin(3 * p[:, 0]) * np.cos(2 * p[:, 1])
    >>> cubic = CloughTocher2DInterpolator(points, wave(points))
    >>> linear = LinearNDInterpolator(points, wave(points))
    >>> errors = [float(np.abs(f(x) - wave(x)).mean()) for f in (cubic, linear)]
    >>> errors[0] < 0.2 * errors[1]
    True
    """

    grad: NDArray[Any]

    def __init__(
        self,
        points: Any,
        values: Any,
        fill_value: Union[float, complex] = np.nan,
        tol: float = 1e-6,
        maxiter: int = 400,
        rescale: bool = False,
        *,
        simplex_tol: Optional[float] = None,
        outside: Literal["fill", "nearest"] = "fill",
        threads: int = 1,
    ) -> None:
        self._take_rules(simplex_tol, "simplex_tol", outside, threads)
        self._take(points, values, fill_value, rescale)
        if self.points.shape[1] != 2:
            shape = self.points.shape
            raise InvalidArgumentError(f"points has shape {shape}; it must be (npoints, 2)")
        of_columns, missed = self._gradients(number(tol, "tol"), maxiter)
        if missed:
            message = f"gradients have not converged to tol={tol} in maxiter={maxiter} sweeps"
            warnings.warn(message, GradientEstimationWarning, stacklevel=2)
        self.grad = self._of_points(of_columns)

    def _gradients(self, tol: float, maxiter: int) -> tuple[np.ndarray, int]:
        """Return the gradients at vertices, and the number of columns where they have not converged."""
        if not self.values.shape[1]:
            return np.zeros((len(self._of_vertices), 0, 2)), 0
        return estimate_gradients(self._arrays, self._of_vertices, tol, maxiter)

    @property
    def _arrays(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        of = self.tri if self._is_scipys else self.tri.mesh
        return contiguous(of.points), contiguous(of.simplices), contiguous(of.neighbors)

    def _of_points(self, of_columns: np.ndarray) -> np.ndarray:
        """Return gradients at vertices, of real columns, as those at points."""
        if self.is_complex:
            of_columns = of_columns[:, 0::2] + 1j * of_columns[:, 1::2]
        is_same = self._is_scipys or self.tri._is_distinct
        return of_columns if is_same else of_columns[self.tri.mesh.input_vertices]

    def _of_columns(self) -> np.ndarray:
        """Return the gradients at vertices, of real columns."""
        found = self._at_vertices(self.grad)
        if self.is_complex:
            parts = np.stack([found.real, found.imag], axis=2)
            found = parts.reshape(len(found), -1, 2)
        return contiguous(found)

    def _inside(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        simplices, weights = self._places(rows)
        given = self._of_vertices, self._of_columns()
        out = cubic(self._arrays, *given, contiguous(simplices), contiguous(weights), self.threads)
        return out, np.flatnonzero(simplices == -1)

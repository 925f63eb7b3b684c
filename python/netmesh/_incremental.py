"""Structures on points that may grow: what `Delaunay`, `Voronoi` and `ConvexHull` share."""

from __future__ import annotations

import functools
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._arrays import point_rows
from ._errors import InvalidArgumentError, StateError

#: Options of Qhull that tell how it deals with rounding errors, of which there are none here.
_QHULL_OPTIONS = {"Qbb", "Qc", "Qj", "QJ", "Qt", "Qx", "Qz", "Q12", "Pp"}


class Incremental:
    """A structure on points, which `_make` makes of all of them and sets `points`."""

    points: NDArray[np.float64]

    def _begin(
        self, points: Any, furthest_site: bool, incremental: bool, qhull_options: Optional[str]
    ) -> None:
        """Check arguments that SciPy has, too, and make the structure."""
        if furthest_site:
            raise InvalidArgumentError("furthest_site is True; only False is supported")
        for option in (qhull_options or "").split():
            if option not in _QHULL_OPTIONS:
                raise InvalidArgumentError(f"qhull_options has {option}, which is not supported")
        self._is_open = incremental
        self._make(point_rows(points))

    def _make(self, points: np.ndarray) -> None:
        raise NotImplementedError

    @property
    def ndim(self) -> int:
        return self.points.shape[1]

    @property
    def npoints(self) -> int:
        return len(self.points)

    @functools.cached_property
    def min_bound(self) -> NDArray[np.float64]:
        return self.points.min(axis=0)

    @functools.cached_property
    def max_bound(self) -> NDArray[np.float64]:
        return self.points.max(axis=0)

    def add_points(self, points: Any, restart: bool = False) -> None:
        """Add points: the structure of all is made anew, whatever `restart`.

        Parameters
        ----------
        points : array_like of float, shape (n, ndim)

        Examples
        --------
        >>> from netmesh import ConvexHull, Delaunay, Voronoi
        >>> points = [[0, 0], [1, 0], [0, 1]]
        >>> tri, vor, hull = (kind(points, incremental=True) for kind in (Delaunay, Voronoi, ConvexHull))
        >>> for structure in (tri, vor, hull):
        ...     structure.add_points([[0.3, 0.3]])
        >>> tri.nsimplex, len(vor.regions), len(hull.vertices)
        (3, 4, 3)
        """
        if not self._is_open:
            raise StateError("points can be added with incremental=True, until close()")
        added = point_rows(points)
        if added.shape[1] != self.ndim:
            shape, ndim = added.shape, self.ndim
            raise InvalidArgumentError(f"points has shape {shape}; it must be (n, {ndim})")
        self._make(np.concatenate([self.points, added]))
        for kind in type(self).__mro__:
            for name, attribute in vars(kind).items():
                if isinstance(attribute, functools.cached_property):
                    self.__dict__.pop(name, None)

    def close(self) -> None:
        """Accept no more points: `add_points` raises `StateError` from now on."""
        self._is_open = False

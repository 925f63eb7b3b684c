"""`Voronoi`, with the names and meanings of SciPy's."""

from __future__ import annotations

import functools
from typing import Any, Optional

import numpy as np

from ._delaunay import Delaunay


class Voronoi:
    """The Voronoi diagram of points in 2 to 8 dimensions, as `scipy.spatial.Voronoi`.

    Which corners coincide is decided by exact signs.

    Parameters
    ----------
    points : array_like of float, shape (npoints, ndim)
    furthest_site, incremental, qhull_options
        Arguments with the meaning that `Delaunay` gives them.

    Attributes
    ----------
    points : ndarray of float64, shape (npoints, ndim)
    vertices : ndarray of float64, shape (nvertices, ndim)
        The corners of the cells.
    ridge_points : ndarray of int32, shape (nridges, 2)
        The points between which each ridge lies.
    ridge_vertices : list of lists of int
        The corners of each ridge, -1 for one at infinity; in 3D in their order round the ridge.
    regions : list of lists of int
        The corners of each cell, -1 for one at infinity; in 2D in their order round the cell.
    point_region : ndarray of int64, shape (npoints,)
        The region of each point. Equal points share one.
    ridge_dict : dict of (int, int) to list of int
        The corners of the ridge between two points.
    furthest_site : bool
    ndim, npoints : int
    min_bound, max_bound : ndarray of float64, shape (ndim,)

    Examples
    --------
    >>> import numpy as np
    >>> from netmesh import Voronoi
    >>> points = np.array([[x, y] for x in range(3) for y in range(3)])
    >>> vor = Voronoi(points)
    >>> vor.vertices.shape, len(vor.regions)
    ((4, 2), 9)
    >>> sorted(vor.regions[vor.point_region[4]])
    [0, 1, 2, 3]
    """

    def __init__(
        self,
        points: Any,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: Optional[str] = None,
    ) -> None:
        self._delaunay = Delaunay(points, furthest_site, incremental, qhull_options)
        self.furthest_site = False
        self._make()

    def __repr__(self) -> str:
        return f"<netmesh.Voronoi: dim {self.points.shape[1]}, {len(self.points)} points>"

    def _make(self) -> None:
        tri = self._delaunay
        self.points = tri.points
        simplices, ridges, of_ridges, of_regions = tri.mesh._core.merged_voronoi()
        self.vertices = tri.mesh.circumcenters[simplices]
        self.ridge_points = tri._first_inputs[ridges]
        self.ridge_vertices = _lists(*of_ridges)
        self.regions = _lists(*of_regions)
        self.point_region = tri.mesh.input_vertices.astype(np.int64)

    @property
    def ndim(self) -> int:
        return self._delaunay.ndim

    @property
    def npoints(self) -> int:
        return self._delaunay.npoints

    @property
    def min_bound(self) -> np.ndarray:
        return self._delaunay.min_bound

    @property
    def max_bound(self) -> np.ndarray:
        return self._delaunay.max_bound

    @functools.cached_property
    def ridge_dict(self) -> dict:
        return dict(zip(map(tuple, self.ridge_points.tolist()), self.ridge_vertices))

    def add_points(self, points: Any, restart: bool = False) -> None:
        """Add points: the diagram of all is made anew, whatever `restart`.

        Examples
        --------
        >>> from netmesh import Voronoi
        >>> vor = Voronoi([[0, 0], [1, 0], [0, 1]], incremental=True)
        >>> vor.add_points([[0.3, 0.3]])
        >>> len(vor.regions)
        4
        """
        self._delaunay.add_points(points, restart)
        self.__dict__.pop("ridge_dict", None)
        self._make()

    def close(self) -> None:
        """Accept no more points: `add_points` raises `StateError` from now on."""
        self._delaunay.close()


def _lists(starts: np.ndarray, ids: np.ndarray) -> list:
    bounds, ids = starts.tolist(), ids.tolist()
    return [ids[start:end] for start, end in zip(bounds, bounds[1:])]

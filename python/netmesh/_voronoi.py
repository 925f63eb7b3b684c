"""`Voronoi`, with the names and meanings of SciPy's."""

from __future__ import annotations

import functools
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._delaunay import Delaunay
from ._incremental import Incremental


class Voronoi(Incremental):
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

    vertices: NDArray[np.float64]
    ridge_points: NDArray[np.int32]
    ridge_vertices: list[list[int]]
    regions: list[list[int]]
    point_region: NDArray[np.int64]

    def __init__(
        self,
        points: Any,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: Optional[str] = None,
    ) -> None:
        self.furthest_site = False
        self._begin(points, furthest_site, incremental, qhull_options)

    def __repr__(self) -> str:
        return f"<netmesh.Voronoi: dim {self.points.shape[1]}, {len(self.points)} points>"

    def _make(self, points: np.ndarray) -> None:
        tri = Delaunay(points)
        self.points = tri.points
        simplices, ridges, of_ridges, of_regions = tri.mesh._core.merged_voronoi()
        self.vertices = tri.mesh.circumcenters[simplices]
        self.ridge_points = tri._first_inputs[ridges]
        self.ridge_vertices = _lists(*of_ridges)
        self.regions = _lists(*of_regions)
        self.point_region = tri.mesh.input_vertices.astype(np.int64)

    @functools.cached_property
    def ridge_dict(self) -> dict[tuple[int, int], list[int]]:
        return dict(zip(map(tuple, self.ridge_points.tolist()), self.ridge_vertices))


def _lists(starts: np.ndarray, ids: np.ndarray) -> list[list[int]]:
    bounds, numbers = starts.tolist(), ids.tolist()
    return [numbers[start:end] for start, end in zip(bounds, bounds[1:])]

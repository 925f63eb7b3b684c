"""Arrays that are made of a mesh's on request, of all of it or of a part."""

from __future__ import annotations

import functools
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from ._arrays import fixed
from ._netmesh import Core
from ._results import CSR, Facets, VoronoiCells


class Arrays:
    """Arrays that are made when they are asked for, and kept. They are read-only."""

    _core: Core
    #: Extent, True if what is across belongs to it, and domain; None for all simplices.
    _selection: Optional[tuple[str, bool, Optional[int]]] = None

    @functools.cached_property
    def edges(self) -> NDArray[np.int32]:
        """Edges, int32, shape (edges, 2): the lesser vertex first, in lexicographic order.

        Examples
        --------
        >>> import netmesh
        >>> netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay").edges
        array([[0, 1],
               [0, 2],
               [1, 2]], dtype=int32)
        """
        return fixed(self._core.edges(self._selection))

    @functools.cached_property
    def facets(self) -> Facets:
        """Facets, and the two simplices of each; -1 on the hull.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1], [1, 1.5]], algorithm="delaunay")
        >>> len(m.facets.vertices), int((m.facets.simplices[:, 1] >= 0).sum())
        (5, 1)
        """
        return Facets(*map(fixed, self._core.facets(self._selection)))

    @functools.cached_property
    def hull(self) -> Facets:
        """Facets of the convex hull, oriented outwards, and the simplex of each.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1], [1, 1.5]], algorithm="delaunay")
        >>> m.hull.vertices.shape, m.hull.simplices.shape
        ((4, 2), (4,))
        """
        return Facets(*map(fixed, self._core.hull(self._selection)))

    @functools.cached_property
    def vertex_simplices(self) -> CSR:
        """Simplices of each vertex, ascending.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1], [1, 1.5]], algorithm="delaunay")
        >>> indptr, indices = m.vertex_simplices
        >>> indices[indptr[1]:indptr[2]]
        array([0, 1], dtype=int32)
        """
        indptr, indices = self._core.vertex_simplices(self._selection)
        return CSR(fixed(indptr), fixed(indices))

    @functools.cached_property
    def vertex_neighbors(self) -> CSR:
        """Vertices that have an edge with each vertex, ascending.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1], [1, 1.5]], algorithm="delaunay")
        >>> indptr, indices = m.vertex_neighbors
        >>> indices[indptr[0]:indptr[1]]
        array([1, 2], dtype=int32)
        """
        indptr, indices = self._core.vertex_neighbors(self._selection)
        return CSR(fixed(indptr), fixed(indices))

    @functools.cached_property
    def _circumballs(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        centers, radii = self._core.circumcenters(self._selection)
        return fixed(centers), fixed(radii)

    @property
    def circumcenters(self) -> NDArray[np.float64]:
        """Circumcentres of simplices, float64, shape (simplices, dim).

        Examples
        --------
        >>> import netmesh
        >>> netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay").circumcenters
        array([[0.5, 0.5]])
        """
        return self._circumballs[0]

    @property
    def circumradii(self) -> NDArray[np.float64]:
        """Circumradii of simplices, float64, shape (simplices,).

        Examples
        --------
        >>> import netmesh
        >>> netmesh.mesh([[0, 0], [6, 0], [0, 8]], algorithm="delaunay").circumradii
        array([5.])
        """
        return self._circumballs[1]

    @functools.cached_property
    def volumes(self) -> NDArray[np.float64]:
        """Volumes (2D: areas) of simplices, float64, shape (simplices,).

        Examples
        --------
        >>> import netmesh
        >>> netmesh.mesh([[0, 0], [6, 0], [0, 8]], algorithm="delaunay").volumes
        array([24.])
        """
        return fixed(self._core.volumes(self._selection))

    @functools.cached_property
    def voronoi(self) -> VoronoiCells:
        """Voronoi diagram of the vertices.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 4], [4, 4], [2, 2]], algorithm="delaunay")
        >>> m.voronoi.is_bounded
        array([False, False, False, False,  True])
        >>> round(float(m.voronoi.volumes[4]), 9)
        8.0
        """
        parts = self._core.voronoi(self._selection)
        for name, part in parts.items():
            parts[name] = CSR(*map(fixed, part)) if isinstance(part, tuple) else fixed(part)
        return VoronoiCells(**parts)

"""Segments, facets and regions of a mesh: the edges, triangles and simplices that are theirs."""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import NDArray

from ._arrays import fixed
from ._netmesh import Core


class Features:
    """Arrays of what segments and facets have become."""

    _core: Core

    @property
    def segments(self) -> NDArray[np.int32]:
        """Edges that segments have become, int32, shape (edges, 2), in their directions.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], [[0, 1], [1, 2], [2, 0]])
        >>> bool((m.segment_parents[m.segments[:, 0] == 0] == 0).all()), len(m.segments) >= 3
        (True, True)
        """
        return self._core.segments

    @property
    def segment_parents(self) -> NDArray[np.int32]:
        """Segment that each edge of `segments` is a part of, int32, shape (edges,).

        -1 for edges of a hull or box, and in 3D for edges of facets that are no segments.
        """
        return self._core.segment_parents

    @functools.cached_property
    def segment_markers(self) -> NDArray[np.int32]:
        """Marker of the segment that each edge of `segments` is a part of, int32, shape (edges,).

        0 for edges of a hull or box, and in 3D for edges of facets that are no segments.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], [[0, 1], [1, 2], [2, 0]], markers=[5, 6, 7])
        >>> set(m.segment_markers.tolist())
        {5, 6, 7}
        """
        return fixed(self._core.segment_markers())

    @property
    def facet_triangles(self) -> NDArray[np.int32]:
        """Triangles that facets have become, int32, shape (triangles, 3).

        Their vertices go counterclockwise where the normal of the facet points to, that of its first
        polygon. `facets` has those of all simplices.

        Examples
        --------
        >>> import netmesh
        >>> points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> m = netmesh.mesh(points, facets=[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
        >>> len(m.facet_triangles) == len(m.facet_parents) == len(m.facet_simplices) >= 4
        True
        >>> bool((m.facet_simplices[:, 0] == -1).all())    # all facets look outwards
        True
        """
        return self._core.facet_triangles

    @property
    def facet_parents(self) -> NDArray[np.int32]:
        """Facet that each of `facet_triangles` is a part of, int32, shape (triangles,).

        Of triangles that are one facet the first; -1 for the boundary of a hull or box.
        """
        return self._core.facet_parents

    @functools.cached_property
    def facet_markers(self) -> NDArray[np.int32]:
        """Marker of the facet that each of `facet_triangles` is a part of, int32, shape (triangles,).

        0 for the boundary of a hull or box.

        Examples
        --------
        >>> import netmesh
        >>> points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> facets = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
        >>> m = netmesh.mesh(points, facets=facets, facet_markers=[1, 1, 1, 9])
        >>> bool((m.points[m.facet_triangles[m.facet_markers == 9], 0] == 0).all())
        True
        """
        return fixed(self._core.facet_markers())

    @property
    def facet_simplices(self) -> NDArray[np.int32]:
        """Simplices that have each of `facet_triangles`, int32, shape (triangles, 2).

        First the one where the normal points to, then the one behind; -1 where the domain ends.
        """
        return self._core.facet_simplices

    @property
    def flat_simplices(self) -> NDArray[np.int32]:
        """Tetrahedra with all vertices on one facet, int32, ascending: `quality().flat` of them.

        Nothing but roundings of their vertices gives them a volume. Finite elements on them are
        worthless; solvers that let elements be left out do better without.
        """
        return self._core.flat_simplices

    @property
    def simplex_regions(self) -> NDArray[np.int32]:
        """Label of each simplex' region, int32, shape (simplices,); empty without segments and facets."""
        return self._core.simplex_regions

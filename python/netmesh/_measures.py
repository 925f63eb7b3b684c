"""Figures of a mesh: those of its run, its quality, its certificate."""

from __future__ import annotations

from typing import Any, Literal, Optional

import numpy as np
from numpy.typing import NDArray

from ._histogram import histogram
from ._netmesh import Core
from ._results import Quality, Report, Stats, Violation


class Figures:
    """Figures of the quality of a mesh, or of a part of it."""

    _core: Core
    _selection: Optional[tuple[str, bool, Optional[int]]] = None

    def quality(self) -> Quality:
        """Measure the quality. O(vertices + simplices).

        Figures of a part are those of its simplices and of Voronoi cells off its boundary; a cage
        counts with the corners that the part has. As in a mesh that is cropped, simplices at the
        boundary of the part count, but not those at the outer cage of the mesh.

        Examples
        --------
        >>> import netmesh
        >>> netmesh.mesh([[0, 0], [1, 0], [0, 1]]).quality().worst_aspect_anywhere <= 3
        True
        """
        return Quality(**self._core.quality(self._selection))

    def quality_histogram(
        self,
        measure: Literal["dihedral_angle", "radius_edge", "aspect", "smallest_angle"] = "dihedral_angle",
        bins: Any = None,
        range: Optional[tuple[float, float]] = None,
        *,
        hull: bool = False,
    ) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Count how many angles, ratios or aspects lie in bins, as `numpy.histogram` does.

        Parameters
        ----------
        measure : {'dihedral_angle', 'smallest_angle', 'radius_edge', 'aspect'}
            The angles between any two facets of each simplex, in degrees (in 2D the angles of
            triangles); the smallest of them; circumradius over shortest edge of simplices; aspects
            of Voronoi cells, of which `Quality.worst_aspect_anywhere` is the largest.
        bins : int or array_like of float, optional
            How many bins of equal width, or their edges, which ascend. 18 by default.
        range : (float, float), optional
            The ends of that many bins: by default 0 to 180 for 'dihedral_angle', 0 to 90 for
            'smallest_angle', else the least and the largest value.
        hull : bool
            Count simplices with a vertex on the hull, too. Cells on the hull have no aspect.

        Returns
        -------
        counts : ndarray of int64, shape (bins,)
            A bin has its lower edge, the last one its upper edge as well. What is outside counts
            nowhere.
        edges : ndarray of float64, shape (bins + 1,)

        Examples
        --------
        >>> import numpy as np, netmesh
        >>> m = netmesh.mesh(np.random.default_rng(1).random((100, 3)))
        >>> counts, edges = m.quality_histogram(bins=[0, 15, 165, 180], hull=True)
        >>> bool(counts.sum() == 6 * len(m.simplices))
        True
        >>> m.quality_histogram("aspect", bins=6, range=(1, 4))[1]
        array([1. , 1.5, 2. , 2.5, 3. , 3.5, 4. ])
        """

        def count(edges: list) -> tuple[np.ndarray, float, float]:
            return self._core.quality_histogram(measure, hull, edges, self._selection)

        return histogram(count, measure, bins, range)


class Measures(Figures):
    """Figures that are taken of a whole mesh."""

    @property
    def stats(self) -> Stats:
        """Figures of what the run did.

        Examples
        --------
        >>> import netmesh
        >>> stats = netmesh.mesh([[0, 0], [1, 0], [0, 1]]).stats
        >>> stats.input_vertices, stats.cage_vertices > 0
        (3, True)
        """
        return Stats(**self._core.stats())

    def validate(self, level: int = 3) -> Report:
        """Check the mesh from its arrays alone, with exact arithmetic.

        Parameters
        ----------
        level : {1, 2, 3}
            1: topology; 2: geometry too, Delaunay on every facet; 3: what was promised too.

        Examples
        --------
        >>> import netmesh
        >>> report = netmesh.mesh([[0, 0], [1, 0], [0, 1]]).validate()
        >>> report.level, report.violations, report.first
        (3, 0, None)
        """
        level, violations, checked, found = self._core.validate(level)
        first = None
        if found is not None:
            number, kind, ids, message = found
            first = Violation(kind, number, *ids, message)
        return Report(level, violations, checked, first)

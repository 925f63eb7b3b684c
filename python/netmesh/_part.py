"""Parts of a mesh, which are meshes of their own."""

from __future__ import annotations

import functools
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._arrays import array, data, fixed, value_columns, vertex_columns
from ._exports import Exports
from ._measures import Figures
from ._netmesh import Core
from ._queries import Locations


class Part(Exports, Locations, Figures):
    """Part of a mesh's simplices, which is a mesh of its own: `Mesh.part` picks them.

    Its hull is its boundary. It has its own vertices and cells, `points` and `cells`, by which
    `locate` answers, and other packages and files number what they get; `vertices` and `simplices`
    are their ids in the mesh. Arrays that are made on request have a row for each cell of the part,
    in the same order, but name vertices and simplices by their ids in the mesh: ``edges``,
    ``facets``, ``hull``, ``voronoi`` and the lists, which are of all vertices of the mesh.

    It pickles as its mesh and the choice.

    Examples
    --------
    >>> import netmesh
    >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
    >>> inside = m.part("hull")
    >>> 0 < len(inside.simplices) < len(m.simplices)
    True
    >>> bool((inside.points[inside.cells] == m.points[m.simplices[inside.simplices]]).all())
    True
    """

    _selection: tuple[str, bool, Optional[int]]

    def __init__(self, mesh: Any, selection: tuple[str, bool, Optional[int]]) -> None:
        self._mesh = mesh
        self._core: Core = mesh._core
        self._selection = selection
        #: Ids of the part's simplices in the mesh, int32, ascending.
        self.simplices = fixed(self._core.part_simplices(selection))

    def __repr__(self) -> str:
        return f"<netmesh.Part: {len(self.simplices)} simplices>"

    def __reduce__(self) -> tuple:
        return Part, (self._mesh, self._selection)

    def __copy__(self) -> Part:
        return self

    def __deepcopy__(self, memo: dict) -> Part:
        return self

    @functools.cached_property
    def _own(self) -> Core:
        return self._core.part(self._selection)

    @functools.cached_property
    def vertices(self) -> NDArray[np.int32]:
        """Ids of the part's vertices in the mesh, int32, shape (vertices,), ascending.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
        >>> m.part("hull").vertices
        array([0, 1, 2], dtype=int32)
        """
        return fixed(np.unique(self._core.simplices[self.simplices]))

    @property
    def dim(self) -> int:
        """Dimension of the points, 2 to 8."""
        return self._core.points.shape[1]

    @property
    def points(self) -> NDArray[np.float64]:
        """Vertices of the part, float64, shape (vertices, dim): in the order of the mesh.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
        >>> m.part("hull").points
        array([[0., 0.],
               [1., 0.],
               [0., 1.]])
        """
        return self._own.points

    @property
    def cells(self) -> NDArray[np.int32]:
        """Rows of `points` that each simplex has, int32, shape (simplices, dim + 1).

        The simplices are in the order of the mesh, each positively oriented.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[5, 0], [6, 0], [5, 1], [0, 0]], algorithm="delaunay")
        >>> part = m.part()
        >>> bool((part.cells == m.simplices).all())
        True
        """
        return self._own.simplices

    @property
    def kinds(self) -> NDArray[np.uint8]:
        """Origin of each vertex of the part, uint8, shape (vertices,): values of `VertexKind`."""
        return self._own.kinds

    @property
    def sizes(self) -> NDArray[np.float64]:
        """Sizes that were asked for at vertices of the part, float64, shape (vertices,); empty without."""
        return self._own.sizes

    @property
    def simplex_regions(self) -> NDArray[np.int32]:
        """Label of each simplex' region, int32, shape (simplices,); empty without segments and facets."""
        return self._own.simplex_regions

    def _columns(self, values: Any, name: str) -> np.ndarray:
        if array(values, name).shape[:1] == self._core.kinds.shape:
            return value_columns(values, len(self._core.kinds), "vertex", name)[self.vertices]
        return vertex_columns(values, self._own, name)

    def _of_vertices(self, values: Any, name: str) -> np.ndarray:
        given = array(values, name)
        if given.shape[:1] == self._core.kinds.shape:
            return given[self.vertices]
        return data(given, len(self.vertices), "vertex", name)

    def _of_simplices(self, values: Any, name: str) -> np.ndarray:
        given = array(values, name)
        if given.shape[:1] == self._core.simplices.shape[:1]:
            return given[self.simplices]
        return data(given, len(self.simplices), "simplex", name)

"""Vertices of a mesh: their origin, and the inputs that they are."""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import NDArray

from ._arrays import fixed
from ._netmesh import Core


class Vertices:
    """Arrays of what vertices are, and of what inputs have become."""

    _core: Core
    _standing: np.ndarray | None

    @property
    def kinds(self) -> NDArray[np.uint8]:
        """Origin of each vertex, uint8, shape (vertices,): values of `VertexKind`."""
        return self._core.kinds

    @property
    def vertex_domains(self) -> NDArray[np.int32]:
        """Innermost domain of each vertex, int32, shape (vertices,); -1 without domains."""
        return self._core.vertex_domains

    @property
    def precision_limited(self) -> NDArray[np.bool_]:
        """True for vertices where doubles are too coarse for the bound, bool, shape (vertices,)."""
        return self._core.precision_limited

    @property
    def input_vertices(self) -> NDArray[np.int32]:
        """Vertices of inputs, int32, shape (n,); equal and merged ones share one. See `vertex_inputs`."""
        return self._core.input_vertices

    @functools.cached_property
    def vertex_inputs(self) -> NDArray[np.int32]:
        """Inputs of vertices, int32, shape (vertices,); -1 for vertices that are no inputs.

        It is the first of inputs that are equal or merged. So the array is the inverse of
        `input_vertices`, but for duplicates. `representatives` tells which input is where the vertex is.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> m.input_vertices, m.vertex_inputs
        (array([0, 0, 1, 2], dtype=int32), array([0, 2, 3], dtype=int32))
        """
        return fixed(self._core.vertex_inputs())

    @functools.cached_property
    def representatives(self) -> NDArray[np.int32]:
        """Input that stands for each one, int32, shape (n,): the one that is where their vertex is.

        Inputs stand for themselves, but for those that equal an earlier one, or that `cutoff` merged
        with another one.

        Examples
        --------
        >>> import netmesh
        >>> points = [[0, 0], [0.1, 0], [1, 0], [0, 1]]
        >>> m = netmesh.mesh(points, cutoff=0.2, algorithm="delaunay")
        >>> m.representatives.tolist(), m.input_vertices.tolist(), len(m.points)
        ([0, 0, 2, 3], [0, 0, 1, 2], 3)
        """
        if self._standing is not None:
            return fixed(self._standing)
        return fixed(self.vertex_inputs[self.input_vertices])

    @property
    def sizes(self) -> NDArray[np.float64]:
        """Sizes that were asked for at vertices, float64, shape (vertices,); empty without.

        They come of `size` and `background`, infinite where there is no bound and where none was needed.
        """
        return self._core.sizes

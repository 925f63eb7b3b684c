"""Questions about points: the simplices that hold them, the nearest vertices, values between."""

from __future__ import annotations

from typing import Any, Literal, Optional

import numpy as np
from numpy.typing import NDArray

from ._arrays import query_points, shaped_values, value_columns, vertex_columns
from ._netmesh import Core
from ._projector import projector


class Locations:
    """Location of points in a mesh, or in a part of it."""

    _core: Core
    _selection: Optional[tuple[str, bool, Optional[int]]] = None

    @property
    def _dim(self) -> int:
        return self._core.points.shape[1]

    def locate(self, points: Any, *, threads: int = 1) -> NDArray[np.int32]:
        """Find the simplices that hold points, by exact signs.

        Parameters
        ----------
        points : array_like of float, shape (..., dim)
            In any order.
        threads : int
            Number of threads, 0 for all cores. The answer does not depend on it.

        Returns
        -------
        ndarray of int32, shape (...)
            -1 outside. On a face that several simplices share, the least of them. Of a part they
            are rows of `cells`, and what is in the mesh beside the part is outside.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> m.locate([[0.2, 0.2], [2, 2]])
        array([ 0, -1], dtype=int32)
        """
        points = query_points(points, self._dim)
        found = self._core.locate(points.reshape(-1, self._dim), threads, self._selection)
        return found.reshape(points.shape[:-1])


class Queries(Locations):
    """Questions that a whole mesh answers about points."""

    def nearest(
        self, points: Any, *, among: Literal["vertices", "inputs"] = "vertices", threads: int = 1
    ) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Find the nearest vertices, or the nearest of the caller's points, and how far they are.

        Parameters
        ----------
        points : array_like of float, shape (..., dim)
        among : {'vertices', 'inputs'}
        threads : int
            0 for all cores.

        Returns
        -------
        found : ndarray of int32, shape (...)
            Vertices or, among inputs, the numbers of the caller's points, of equal ones the first.
            The least of those at the same distance.
        distances : ndarray of float64, shape (...)

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
        >>> m.nearest([0.9, 0], among="inputs")[0]
        array(1, dtype=int32)
        """
        points = query_points(points, self._dim)
        vertices, distances = self._core.nearest(points.reshape(-1, self._dim), among, threads)
        return vertices.reshape(points.shape[:-1]), distances.reshape(points.shape[:-1])

    def interpolate(
        self,
        values: Any,
        points: Any,
        *,
        interpolation: Literal["linear", "sibson", "laplace"] = "linear",
        outside: Literal["nan", "nearest"] = "nan",
        threads: int = 1,
    ) -> NDArray[Any]:
        """Interpolate values that are given at the vertices.

        Parameters
        ----------
        values : array_like of float or complex, shape (vertices, ...)
            `extend_values` makes them of values at the inputs.
        points : array_like of float, shape (..., dim)
        interpolation : {'linear', 'sibson', 'laplace'}
            Linear in each simplex, or by natural neighbours.
        outside : {'nan', 'nearest'}
            Values of points outside the hull: NaN, or those of the nearest vertex.
        threads : int
            0 for all cores.

        Returns
        -------
        ndarray of float64 or complex128
            The shape of points without the last axis, then that of values without the first.

        Examples
        --------
        >>> import numpy as np, netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
        >>> linear = m.points @ [2, 3]
        >>> np.allclose(m.interpolate(linear, [[0.25, 0.5]], interpolation="sibson"), 2)
        True
        """
        points = query_points(points, self._dim)
        columns = vertex_columns(values, self._core)
        rows = points.reshape(-1, self._dim)
        found = self._core.interpolate(columns, rows, interpolation, outside, threads)
        return shaped_values(found, values, points.shape[:-1])

    def projector(
        self,
        points: Any,
        *,
        outside: str = "zero",
        tol: Optional[float] = None,
        threads: int = 1,
    ) -> Any:
        """Make the sparse matrix that takes values at the vertices to points, linear in simplices.

        Row i has the barycentric coordinates of point i at the vertices of its simplex, as the
        projector of INLA and fmesher has them: ``A @ values`` is ``interpolate(values, points)``, and
        ``A.T`` distributes what is at points over the vertices. SciPy must be installed.

        Parameters
        ----------
        points : array_like of float, shape (n, dim)
        outside : {'zero', 'nearest', 'refuse'}
            Points outside the mesh get a row without entries, or a one at the nearest vertex; or they
            are refused with the first of them.
        tol : float, optional
            Barycentric coordinates from ``-tol`` to ``1 + tol`` count as inside: see
            `Delaunay.find_simplex`. 2.2e-14 by default.
        threads : int
            0 for all cores.

        Returns
        -------
        scipy.sparse.csr_array of float64, shape (n, vertices)
            At most dim + 1 entries a row, which sum to 1. No zero is stored.

        Examples
        --------
        >>> import numpy as np, netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> A = m.projector([[0.25, 0.5], [1, 0], [3, 3]])
        >>> A.toarray().round(12)
        array([[0.25, 0.25, 0.5 ],
               [0.  , 1.  , 0.  ],
               [0.  , 0.  , 0.  ]])
        """
        return projector(self._core, points, outside, tol, threads)

    def extend_values(self, values: Any, *, threads: int = 1) -> NDArray[Any]:
        """Extend values at the inputs to all vertices.

        They are linear in the Delaunay triangulation of the inputs, and those of the nearest input
        beyond its hull.

        Parameters
        ----------
        values : array_like of float or complex, shape (n, ...)
            Values of the inputs; the first one's count where inputs are equal.

        Returns
        -------
        ndarray of float64 or complex128, shape (vertices, ...)

        Examples
        --------
        >>> import numpy as np, netmesh
        >>> points = np.random.default_rng(1).random((50, 2))
        >>> m = netmesh.mesh(points)
        >>> at_vertices = m.extend_values(points @ [2, 3])
        >>> at_vertices.shape == (len(m.points),)
        True
        >>> np.allclose(m.interpolate(at_vertices, points[:5]), points[:5] @ [2, 3])
        True
        """
        columns = value_columns(values, len(self._core.input_vertices), "input")
        found = self._core.extend_values(columns, threads)
        return shaped_values(found, values, found.shape[:1])

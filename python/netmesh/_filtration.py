"""Faces of a mesh with the values of a filtration."""

from __future__ import annotations

import functools
import os
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from ._arrays import fixed, number
from ._errors import InvalidArgumentError
from ._netmesh import FiltrationCore
from ._results import CSR
from ._shape import AlphaShape


class Filtration:
    """The faces of a mesh, each with a value. `Mesh.filtration` makes it; nothing changes it.

    It pickles as its mesh and the kind.

    Vertices are numbered as `points` are: for the kind 'alpha' as the caller's points, of equal ones
    the first; for the kind 'mesh', where some are no inputs, as the vertices of the mesh.
    A face is named by its dimension and its place in `faces`.

    Examples
    --------
    >>> import netmesh
    >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], algorithm="delaunay")
    >>> alpha = m.filtration("alpha")
    >>> alpha.faces(1)
    array([[0, 1],
           [0, 2],
           [1, 2]], dtype=int32)
    >>> alpha.values(1), alpha.values(2)
    (array([4.  , 2.25, 6.25]), array([6.25]))
    """

    def __init__(self, mesh: Any, kind: str, threads: int = 1) -> None:
        self._mesh = mesh
        self._core: FiltrationCore = mesh._core.filtration(kind, threads)
        #: 'alpha' or 'mesh'.
        self.kind = kind

    def __reduce__(self) -> tuple:
        # The same mesh has the same faces and values.
        return Filtration, (self._mesh, self.kind)

    def __copy__(self) -> Filtration:
        return self

    def __deepcopy__(self, memo: dict) -> Filtration:
        return self

    @property
    def dim(self) -> int:
        """Dimension of the simplices."""
        return self._core.dim

    @property
    def factor(self) -> float:
        """Factor, at least 1, between these diagrams and those of the balls round the inputs.

        A feature of either, from birth to death (both lengths: the roots of the values of 'alpha'),
        with ``death / birth > factor**2`` has its own in the other, and births and deaths differ by
        no more than this factor. Infinite where nothing can be said.
        """
        return self._core.factor

    @functools.cached_property
    def points(self) -> NDArray[np.float64]:
        """Points that faces are made of, float64, shape (points, dim).

        They are the caller's points, duplicates included, for the kind 'alpha', and the vertices for
        the kind 'mesh'.
        """
        return fixed(self._core.points)

    def faces(self, k: int) -> NDArray[np.int32]:
        """Return the faces of dimension k: int32, shape (faces, k + 1), ascending, sorted.

        Numbers are those of rows of `points`.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], algorithm="delaunay")
        >>> m.filtration("alpha").faces(2)
        array([[0, 1, 2]], dtype=int32)
        """
        return fixed(self._core.faces(k))

    def values(self, k: int) -> NDArray[np.float64]:
        """Return the values of the faces of dimension k: float64, shape (faces,).

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], algorithm="delaunay")
        >>> m.filtration("alpha").values(0)
        array([0., 0., 0.])
        """
        return self._core.values(k)

    def facets(self, k: int) -> NDArray[np.int32]:
        """Return the boundary of the faces of dimension k, from 1 on.

        int32, shape (faces, k + 1): entry i is the face of dimension k - 1 without vertex i, whose
        sign in the boundary is ``(-1)**i``.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], algorithm="delaunay")
        >>> m.filtration("alpha").facets(2)
        array([[2, 1, 0]], dtype=int32)
        """
        return self._core.facets(k)

    def cofaces(self, k: int) -> CSR:
        """Return for each face of dimension k those of dimension k + 1 that have it as a facet.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], algorithm="delaunay")
        >>> indptr, indices = m.filtration("alpha").cofaces(0)
        >>> indices[indptr[2]:indptr[3]]
        array([1, 2], dtype=int32)
        """
        return CSR(*self._core.cofaces(k))

    def export(self, path: Union[str, os.PathLike]) -> None:
        """Write a file, which appears complete or not at all.

        Parameters
        ----------
        path : str or path
            ``.filtration``: text as GUDHI's simplex trees write and read it, with the numbers of
            `faces`. ``.dipha``: DIPHA's binary boundary matrix with weights.

        Examples
        --------
        >>> import os, tempfile, netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], algorithm="delaunay")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     m.filtration("alpha").export(os.path.join(folder, "three.filtration"))
        ...     os.listdir(folder)
        ['three.filtration']
        """
        self._core.export(os.fspath(path))

    def shape(self, alpha: Union[float, str] = "optimal", components: int = 1) -> AlphaShape:
        """Return the alpha shape: the faces up to an alpha value. For a filtration of kind 'alpha'.

        Parameters
        ----------
        alpha : float, 'connected' or 'optimal'
            The largest alpha value, a squared radius. 'connected': the least for which the shape is
            connected. 'optimal': the least for which every input is a vertex of a simplex of the
            shape, whose simplices, connected across facets, make at most `components` pieces: CGAL's
            optimal alpha.
        components : int
            Largest number of pieces of an 'optimal' shape.

        Raises
        ------
        Error
            `InvalidArgumentError` (another kind of filtration; alpha; components).

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], algorithm="delaunay")
        >>> m.filtration("alpha").shape(5).face_counts
        (3, 2, 0)
        """
        if self.kind != "alpha":
            raise InvalidArgumentError(
                f"kind is {self.kind!r}; alpha shapes are of a filtration of kind 'alpha'"
            )
        if isinstance(alpha, str):
            if alpha == "connected":
                return AlphaShape(self, self._core.connecting_alpha())
            if alpha == "optimal":
                return AlphaShape(self, self._core.optimal_alpha(components))
            raise InvalidArgumentError(
                f"alpha is {alpha!r}; it must be a number, 'connected' or 'optimal'"
            )
        return AlphaShape(self, self._core.checked_alpha(number(alpha, "alpha")))

    def to_gudhi(self) -> Any:
        """Return a ``gudhi.SimplexTree`` of the faces and values. Needs the package gudhi.

        Its vertices are numbered as in `faces`: for the kind 'alpha' as the caller's points.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [4, 0], [0, 3]], algorithm="delaunay")
        >>> m.filtration("alpha").to_gudhi().num_simplices()
        7
        """
        import gudhi

        tree = gudhi.SimplexTree()
        for k in range(self.dim + 1):
            tree.insert_batch(self.faces(k).T, self.values(k))
        return tree

    def __repr__(self) -> str:
        counts = ", ".join(str(len(self.values(k))) for k in range(self.dim + 1))
        return f"<netmesh.Filtration '{self.kind}': {counts} faces of dimension 0 to {self.dim}>"

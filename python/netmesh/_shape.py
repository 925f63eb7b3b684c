"""Alpha shapes: the faces of a Delaunay triangulation up to an alpha value."""

from __future__ import annotations

import enum
import functools
import os
from typing import Optional, Union

import numpy as np

from ._arrays import fixed
from ._netmesh import FiltrationCore


class FaceClass(enum.IntEnum):
    """Class of a face with respect to an alpha shape: the values of `AlphaShape.classes`."""

    #: Not in the shape.
    EXTERIOR = 0
    #: In the shape, and in no larger face of it.
    SINGULAR = 1
    #: On the boundary of the shape, and in a larger face of it.
    REGULAR = 2
    #: In the interior of the shape: all simplices round it are in the shape.
    INTERIOR = 3


class AlphaShape:
    """All faces with an alpha value of at most alpha. `Filtration.shape` makes it.

    Examples
    --------
    >>> import numpy as np, netmesh
    >>> angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    >>> circle = np.c_[np.cos(angle), np.sin(angle)]
    >>> alpha = netmesh.mesh(circle, algorithm="delaunay").filtration("alpha")
    >>> alpha.shape(0.01).betti, alpha.shape("connected").components
    ((1, 1), 1)
    >>> disc = alpha.shape("optimal")
    >>> disc.betti, disc.boundary.shape, round(disc.volume, 3)
    ((1, 0), (40, 2), 3.129)
    """

    def __init__(self, core: FiltrationCore, alpha: float) -> None:
        self._core = core
        #: The largest alpha value of its faces, a squared radius.
        self.alpha = alpha
        measures = core.shape_measures(alpha)
        #: The volume of its simplices (an area in 2D).
        self.volume: float = measures["volume"]
        #: The number of its faces of each dimension.
        self.face_counts: tuple[int, ...] = tuple(measures["face_counts"])
        #: The number of its faces of even dimension less that of those of odd dimension.
        self.euler_characteristic: int = measures["euler_characteristic"]
        #: Number of its connected pieces.
        self.components: int = measures["components"]
        #: Number of bounded pieces that it leaves of space: holes in 2D, cavities in 3D.
        self.voids: int = measures["voids"]
        betti = measures["betti"]
        #: Its Betti numbers from dimension 0 on: components and holes in 2D; components, tunnels
        #: and cavities in 3D; None in other dimensions (`Filtration.to_gudhi` has them).
        self.betti: Optional[tuple[int, ...]] = None if betti is None else tuple(betti)

    def classes(self, k: int) -> np.ndarray:
        """Return a `FaceClass` for each of ``Filtration.faces(k)``: uint8, shape (faces,).

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> shape = m.filtration("alpha").shape("optimal")
        >>> shape.classes(2) == netmesh.FaceClass.INTERIOR
        array([ True])
        """
        return self._core.shape_classes(self.alpha, k)

    @property
    def simplices(self) -> np.ndarray:
        """Simplices of the shape: int32, their places in ``Mesh.simplices``, ascending."""
        return self._core.shape_simplices(self.alpha)

    @functools.cached_property
    def points(self) -> np.ndarray:
        """Points of the caller, duplicates included: float64, shape (n, dim)."""
        return fixed(self._core.points)

    @property
    def boundary(self) -> np.ndarray:
        """Boundary of the simplices: int32, shape (facets, dim), oriented outwards.

        Numbers are those of the caller's points, of equal ones the first: rows of `points`.
        """
        return self._core.shape_boundary(self.alpha)

    def export(self, path: Union[str, os.PathLike]) -> None:
        """Write the boundary to a ``.ply`` or ``.off`` file, which appears complete or not at all.

        In 3D it consists of triangles, in 2D of edges.

        Examples
        --------
        >>> import os, tempfile, netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     m.filtration("alpha").shape().export(os.path.join(folder, "shape.off"))
        ...     os.listdir(folder)
        ['shape.off']
        """
        self._core.export_shape(self.alpha, os.fspath(path))

    def __repr__(self) -> str:
        counts = ", ".join(map(str, self.face_counts))
        return f"<netmesh.AlphaShape {self.alpha:g}: {counts} faces from dimension 0 on>"

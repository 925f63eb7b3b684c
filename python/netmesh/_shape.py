"""Alpha shapes: the faces of a Delaunay triangulation up to an alpha value."""

from __future__ import annotations

import enum
import functools
import os
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _plots
from ._arrays import fixed
from ._netmesh import FiltrationCore
from ._polygons import rings_of
from ._views import require_dimension


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

    It pickles as its filtration and alpha.

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

    def __init__(self, filtration: Any, alpha: float) -> None:
        self._filtration = filtration
        core: FiltrationCore = filtration._core
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

    def __reduce__(self) -> tuple:
        return AlphaShape, (self._filtration, self.alpha)

    def __copy__(self) -> AlphaShape:
        return self

    def __deepcopy__(self, memo: dict) -> AlphaShape:
        return self

    def classes(self, k: int) -> NDArray[np.uint8]:
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
    def simplices(self) -> NDArray[np.int32]:
        """Simplices of the shape: int32, their places in ``Mesh.simplices``, ascending."""
        return self._core.shape_simplices(self.alpha)

    @functools.cached_property
    def points(self) -> NDArray[np.float64]:
        """Points of the caller, duplicates included: float64, shape (n, dim)."""
        return fixed(self._core.points)

    @property
    def boundary(self) -> NDArray[np.int32]:
        """Boundary of the simplices: int32, shape (facets, dim), oriented outwards.

        Numbers are those of the caller's points, of equal ones the first: rows of `points`.
        """
        return self._core.shape_boundary(self.alpha)

    def export(self, path: Union[str, os.PathLike]) -> None:
        """Write the boundary to a ``.ply``, ``.off``, ``.stl`` or ``.obj`` file.

        The file appears complete or not at all. STL has single precision, and no edges of 2D.

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

    def polygons(self) -> list:
        """Make polygons of the shape, in 2D: a `shapely.Polygon` for each piece, with its holes.

        A piece has triangles that are connected across edges; pieces may touch in points. Edges and
        points of the shape that are in no triangle have no polygon. Needs the package shapely.

        Examples
        --------
        >>> import numpy as np, netmesh
        >>> angle = np.linspace(0, 2 * np.pi, 100, endpoint=False)[:, None]
        >>> ring = np.concatenate([r * np.c_[np.cos(angle), np.sin(angle)] for r in (1, 1.05, 1.1)])
        >>> shape = netmesh.mesh(ring, algorithm="delaunay").filtration("alpha").shape(0.01)
        >>> [polygon] = shape.polygons()
        >>> len(polygon.interiors), bool(np.isclose(polygon.area, shape.volume))
        (1, True)
        """
        import shapely

        mesh, simplices = self._filtration._mesh, self.simplices
        require_dimension(mesh._core, (2,))
        row_of = np.full(len(mesh.simplices) + 1, -1)
        row_of[simplices] = np.arange(len(simplices))
        # The neighbour -1 is the last one, which is no row.
        rings = rings_of(mesh.points, mesh.simplices[simplices], row_of[mesh.neighbors[simplices]])
        points = mesh.points
        return [shapely.Polygon(points[outer], [points[hole] for hole in holes]) for outer, holes in rings]

    def plot(
        self, *, ax: Any = None, plotter: Any = None, off_screen: Optional[bool] = None, **arguments: Any
    ) -> Any:
        """Draw the shape: with Matplotlib in 2D, its boundary with PyVista in 3D.

        Triangles that are in no tetrahedron are drawn in 3D, too, and edges that are in no triangle
        in 2D.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            In 2D the axes to draw on; the current ones if none are given.
        plotter : pyvista.Plotter, optional
            In 3D the plotter to draw on; a new one if none is given.
        off_screen : bool, optional
            In 3D True for a picture without a window, for ``screenshot``; by default as PyVista is set.
        **arguments
            In 2D keywords of a `matplotlib.collections.PolyCollection` for the triangles, under their
            long or short names; in 3D keywords of `pyvista.Plotter.add_mesh`.

        Returns
        -------
        matplotlib.axes.Axes or pyvista.Plotter
            Nothing is shown before ``show``.

        Examples
        --------
        >>> import matplotlib, numpy as np, netmesh
        >>> matplotlib.use("agg")
        >>> points = np.random.default_rng(1).random((100, 2))
        >>> shape = netmesh.mesh(points, algorithm="delaunay").filtration("alpha").shape()
        >>> shape.plot(color="tab:green", alpha=0.5).get_aspect()
        1.0
        """
        return _plots.plot_shape(self, ax, plotter, off_screen, arguments)

    def __repr__(self) -> str:
        counts = ", ".join(map(str, self.face_counts))
        return f"<netmesh.AlphaShape {self.alpha:g}: {counts} faces from dimension 0 on>"

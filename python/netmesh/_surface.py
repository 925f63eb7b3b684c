"""Surfaces through points: surfaces in space, curves in the plane, closed or open."""

from __future__ import annotations

import functools
import os
from typing import Any, Tuple, Union

import numpy as np

from ._arrays import fixed
from ._errors import InternalError
from ._mesh import Mesh, mesh
from ._netmesh import SurfaceCore


class Surface:
    """A surface through points. `surface` makes it.

    It is a manifold without intersections, oriented outwards where it is closed, and its vertices are
    points that were given. `mesh` takes a closed one in space and meshes what it encloses, as anything
    with ``vertices`` and ``faces``.

    Examples
    --------
    >>> import netmesh
    >>> cube = netmesh.surface([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    >>> cube.faces.shape, cube.genera, round(cube.volume, 12)
    ((12, 3), (0,), 1.0)
    >>> part = netmesh.mesh(cube, max_edge=0.5)
    >>> round(float(part.volumes.sum()), 12)
    1.0
    """

    def __init__(self, triangulation: Mesh, closed: bool = True) -> None:
        #: False for a surface that may end.
        self.closed = closed
        #: The Delaunay triangulation whose simplices are inside or outside.
        self.triangulation = triangulation
        self._core: SurfaceCore = triangulation._core.surface(closed)
        #: Number of handles of each connected part: 0 for a sphere, 1 for a torus, 0 in the plane. Of
        #: a part with one side its crosscaps: 1 for a Moebius strip.
        self.genera: Tuple[int, ...] = tuple(self._core.genera())
        #: Number of closed curves at which each connected part ends: 0 for a sphere, 1 for a disk, 2
        #: for a tube; in the plane of points, 2 for a curve that is not closed.
        self.ends: Tuple[int, ...] = tuple(ends for ends, _ in self._core.ends())
        #: True for each connected part that has one side alone.
        self.is_one_sided: Tuple[bool, ...] = tuple(one for _, one in self._core.ends())
        #: The volume that it encloses; an area in the plane. 0 for an open surface.
        self.volume: float = self._core.volume()

    def __reduce__(self) -> tuple:
        return Surface, (self.triangulation, self.closed)

    def __repr__(self) -> str:
        kind = "faces" if self.vertices.shape[1] == 3 else "facets"
        ends = "" if self.closed else f", ends {self.ends}"
        return (
            f"<netmesh.Surface: {len(self.vertices)} vertices, {len(self.facets)} {kind}, "
            f"genera {self.genera}{ends}, {len(self.left_out)} points left out>"
        )

    @functools.cached_property
    def _apart(self) -> Tuple[np.ndarray, np.ndarray]:
        vertices, facets = self._core.apart()
        return fixed(vertices), fixed(facets)

    @property
    def vertices(self) -> np.ndarray:
        """Points that are on the surface: float64, shape (vertices, dim), in the order given."""
        return self._apart[0]

    @property
    def facets(self) -> np.ndarray:
        """Triangles, or edges in the plane: int32, shape (facets, dim), rows of `vertices`.

        They are oriented outwards.
        """
        return self._apart[1]

    @property
    def faces(self) -> np.ndarray:
        """The triangles of a surface in space, as `facets`.

        Raises
        ------
        AttributeError
            In the plane.
        """
        if self.vertices.shape[1] != 3:
            raise AttributeError("a curve in the plane has facets, and no faces")
        return self.facets

    @functools.cached_property
    def point_facets(self) -> np.ndarray:
        """The facets by the numbers of the points that were given, of equal ones the first."""
        return fixed(self._core.point_facets())

    @functools.cached_property
    def left_out(self) -> np.ndarray:
        """Points that are not on the surface: int32, ascending; of equal ones the first."""
        return fixed(self._core.left_out())

    @functools.cached_property
    def sampling(self) -> np.ndarray:
        """How sparse the points are for the surface: float64, shape (vertices,).

        The largest circumradius of the facets of a vertex (in the plane half the longest edge) over
        the distance to the nearest pole of their vertices, which stands for the local feature size.
        0.3 and less is dense; above 1 the surface is a guess. At sharp edges, and with noise, it is
        large.
        """
        return fixed(self._core.sampling())

    @functools.cached_property
    def is_inside(self) -> np.ndarray:
        """True for the simplices of `triangulation` that are inside: bool, shape (simplices,).

        For an open surface all are False.
        """
        return fixed(self._core.is_inside())

    def validate(self) -> None:
        """Check the triangulation and the surface with the independent certificate checker.

        Raises
        ------
        InternalError
            The certificate is violated, which is a defect of netmesh; the message has the first
            violation.
        """
        violations, first = self._core.validate()
        if violations:
            raise InternalError(f"the certificate has {violations} violations, the first: {first}")

    def export(self, path: Union[str, os.PathLike]) -> None:
        """Write a ``.ply``, ``.off``, ``.stl`` or ``.obj`` file, which appears complete or not at all.

        STL has single precision, and holds surfaces in space alone.
        """
        self._core.export(path)


def surface(points: Any, *, closed: bool = True, threads: int = 1) -> Surface:
    """Find the surface that points were sampled from; curves in the plane.

    No normals are asked for. Where the points are dense for the curvature and thickness of the
    surface that they are on, the result has its topology; outliers, and points that noise moved off
    it, are left out.

    Parameters
    ----------
    points : array_like of float, shape (n, 2) or (n, 3)
        Points on a surface, in any order.
    closed : bool
        True for closed surfaces: what ends is closed somehow. False for surfaces that may end, or have
        one side alone: a sheet, a terrain, a Moebius strip. Holes of more than some five distances of
        points then stay.
    threads : int
        0 for all cores. The result does not depend on it.

    Returns
    -------
    Surface
        A closed one is without facets if the points tell of no inside.

    Raises
    ------
    Error
        `InvalidArgumentError`, `DegenerateInputError` (all points on a plane), `LimitError`,
        `OutOfMemoryError`.

    Examples
    --------
    >>> import numpy as np, netmesh
    >>> angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    >>> circle = netmesh.surface(np.c_[np.cos(angle), np.sin(angle)])
    >>> circle.facets.shape, len(circle.left_out), round(circle.volume, 3)
    ((40, 2), 0, 3.129)
    >>> arc = netmesh.surface(np.c_[np.cos(angle), np.sin(angle)][:20], closed=False)
    >>> arc.facets.shape, arc.ends
    ((19, 2), (2,))
    """
    return Surface(mesh(points, algorithm="delaunay", threads=threads), closed)

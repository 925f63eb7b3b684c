"""`domain`: points, segments, facets and regions of what other packages and files have."""

from __future__ import annotations

import collections.abc
import dataclasses
import os
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from . import _outlines, _surfaces
from ._arrays import doubles
from ._errors import ArgumentTypeError, InvalidArgumentError

#: Kinds of things that a domain is made of, in messages.
_KINDS = (
    "a path, a geometry or a table of shapely or GeoPandas, GeoJSON, a ring or rings of points, "
    "a dict with 'vertices', a surface with vertices and faces, or a mesh of PyVista or meshio"
)


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Domain:
    """What `mesh` is asked to keep: points, segments, facets, regions and holes.

    `domain` makes it of what other packages and files have. `dataclasses.replace` changes a field.

    Examples
    --------
    >>> import dataclasses, netmesh
    >>> square = netmesh.domain([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> square
    <netmesh.Domain: dim 2, 4 points, 4 segments>
    >>> labelled = dataclasses.replace(square, regions=[(1, 1, 5)])
    >>> bool((netmesh.mesh(labelled).simplex_regions == 5).all())
    True
    """

    #: Points: float64, shape (n, dim).
    points: NDArray[np.float64]
    #: Numbers of the points at the ends of segments: int64, shape (segments, 2), or None.
    segments: Optional[NDArray[np.int64]] = None
    #: Numbers of the segments: int, shape (segments,), or None.
    markers: Optional[NDArray[np.integer[Any]]] = None
    #: Whether segments are sides of polygons: bool, shape (segments,), or None. Where some are, the
    #: inside is by parity of these alone, unless `interior` says otherwise.
    sides: Optional[NDArray[np.bool_]] = None
    #: Triangles, polygons or lists of loops, as `mesh` takes them, or None.
    facets: Any = None
    #: Numbers of the facets: int, shape (facets,), or None.
    facet_markers: Optional[NDArray[np.integer[Any]]] = None
    #: Regions, each (x, y, label) or (x, y, label, max_edge), in space (x, y, z, ...).
    regions: Any = None
    #: Points of holes: float64, shape (holes, dim), or None.
    holes: Optional[NDArray[np.float64]] = None

    def __repr__(self) -> str:
        counts = [f"{len(self.points)} points"]
        for name in ("segments", "facets", "regions", "holes"):
            things = getattr(self, name)
            if things is not None and len(things):
                counts.append(f"{len(things)} {name if len(things) > 1 else name[:-1]}")
        dim = doubles(self.points, "points").shape[-1]
        return f"<netmesh.Domain: dim {dim}, {', '.join(counts)}>"

    def _joined(self, regions: Any = None, holes: Any = None) -> Domain:
        """Return the domain with further regions and holes."""
        further: dict[str, Any] = {}
        for name, given in (("regions", regions), ("holes", holes)):
            own = getattr(self, name)
            if given is not None:
                further[name] = given if own is None or not len(own) else [*own, *given]
        return dataclasses.replace(self, **further)


def domain(x: Any, *, markers: Optional[str] = None) -> Domain:
    """Make a domain of what other packages and files have.

    In the plane polygons are what their rings enclose by parity, so that lakes are outside and an
    island in a lake inside; lines are kept as edges. In space a surface encloses its inside.

    Parameters
    ----------
    x : object
        One of these:

        - a geometry of shapely, a GeoSeries or GeoDataFrame, GeoJSON as a dict, or anything else
          with ``__geo_interface__``. Segments have the number of their feature as marker, from 1 on;
        - a ring of points, array_like of shape (n, 2), or a sequence of rings. One may end where it
          begins. Segments have the number of their ring as marker, from 1 on;
        - a dict as PyPI's triangle has it, with ``vertices`` and perhaps ``segments``,
          ``segment_markers``, ``holes`` and ``regions``. The largest area of a region becomes the
          longest edge of an equilateral triangle that is as large, which keeps it;
        - a surface in space with ``vertices`` and ``faces``, such as a mesh of trimesh;
        - a PyVista ``PolyData``, of which polygons become facets and lines segments;
        - a meshio ``Mesh``, of which triangles, quadrilaterals and polygons become facets and lines
          segments; if its points have no third coordinate, or all have 0, it is in the plane, where
          lines are all that is kept;
        - a path to a file of any format that the command line reads; or to a GeoPackage, shapefile or
          FlatGeobuf, of which GeoPandas reads the first layer if it is installed.
    markers : str, optional
        The name of the data that has the markers: a column of a GeoDataFrame or a property of the
        features of GeoJSON, of their files too, cell data of PyVista or meshio, a face attribute of trimesh. By default
        those that meshio has of Gmsh and Medit, and the markers in files.

    Returns
    -------
    Domain
        For `mesh` in place of points, and for the functions that take a surface.

    Warns
    -----
    UserWarning
        Where the thing has more than becomes part of the domain, such as tetrahedra.

    Raises
    ------
    Error
        `InvalidArgumentError`, `FileError`, `FormatError`, `NonFiniteError`, `DimensionError`.

    Examples
    --------
    >>> import netmesh
    >>> outer, lake = [(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (2, 1), (2, 2), (1, 2)]
    >>> m = netmesh.mesh(netmesh.domain([outer, lake]), max_edge=0.5)
    >>> round(float(m.volumes.sum()), 12)
    15.0

    From a file, or from another package:

    >>> netmesh.domain({"type": "LineString", "coordinates": [[0, 0], [1, 0], [1, 1]]})
    <netmesh.Domain: dim 2, 3 points, 2 segments>
    """
    if markers is not None and not isinstance(markers, str):
        rule = "it must be the name of the data that has them"
        raise ArgumentTypeError(f"markers is of type {type(markers).__name__}; {rule}")
    if isinstance(x, Domain):
        return x
    return Domain(**_fields(x, markers))


def _fields(x: Any, markers: Optional[str]) -> dict[str, Any]:
    if isinstance(x, (str, os.PathLike)):
        return _outlines.of_file(x, markers)
    if hasattr(x, "__geo_interface__") or _outlines.is_geojson(x):
        return _outlines.of_features(x, markers)
    if isinstance(x, collections.abc.Mapping):
        _outlines.require_no_name(markers, "a dict, which has 'segment_markers'")
        return _outlines.of_dict(x)
    for is_one, fields_of in _surfaces.KINDS:
        if is_one(x):
            return fields_of(x, markers)
    if isinstance(x, (collections.abc.Sequence, np.ndarray)) and not isinstance(x, bytes):
        if len(x) and all(hasattr(one, "__geo_interface__") for one in x):
            return _outlines.of_features(_outlines.collection(x), markers)
        _outlines.require_no_name(markers, "rings, whose segments have their numbers")
        return _outlines.of_rings(x)
    raise InvalidArgumentError(f"x is of type {type(x).__name__}; it must be {_KINDS}")

"""Meshes: `mesh` makes them, `Mesh` holds the arrays and answers questions."""

from __future__ import annotations

import functools
import os
from typing import Any, Literal, Optional, Union

import numpy as np

from . import _views
from ._arrays import (
    doubles,
    fixed,
    point_rows,
    query_points,
    shaped_values,
    value_columns,
    vertex_columns,
)
from ._boundary import boundary_of
from ._facets import facets_of, points_and_facets
from ._filtration import Filtration
from ._histogram import histogram
from ._netmesh import Core
from ._part import Arrays, Part
from ._progress import reporter
from ._results import DOMAIN, Quality, Report, Stats, Violation

# Arguments of `mesh` beside the options.
_NO_OPTIONS = (
    "points",
    "progress",
    "segments",
    "facets",
    "markers",
    "facet_markers",
    "regions",
    "holes",
)


def mesh(
    points: Any,
    segments: Any = None,
    facets: Any = None,
    *,
    markers: Any = None,
    facet_markers: Any = None,
    regions: Any = None,
    holes: Any = None,
    criterion: Literal["voronoi_aspect", "radius_edge"] = "voronoi_aspect",
    quality_bound: float = 0.0,
    min_angle: float = 0.0,
    min_dihedral: float = 0.0,
    gives_way: Literal["angle", "bound"] = "angle",
    extent: Literal["auto", "all", "hull", "box", "boundary"] = "auto",
    interior: Literal["auto", "seeds", "parity", "winding"] = "auto",
    crossings: Literal["refuse", "split"] = "refuse",
    coplanar: float = 0.0,
    max_edge: float = 0.0,
    distance_ratio: float = 0.0,
    size: Any = None,
    background: Any = None,
    output: Literal["auto", "hierarchical", "well_spaced"] = "auto",
    algorithm: Literal["netmesh", "svr", "delaunay"] = "netmesh",
    threads: int = 1,
    instruments: bool = False,
    seed: int = 0,
    max_vertices: int = 0,
    ordering: Literal["sampled_net", "deterministic_net"] = "sampled_net",
    epsilon: float = 0.0,
    delta: float = 0.0,
    gamma: float = 0.0,
    yield_radius: float = 0.0,
    encroachment: float = 0.0,
    cage_scale: float = 0.0,
    root_scale: float = 0.0,
    progress: Any = None,
) -> Mesh:
    """Mesh points in 2 to 8 dimensions.

    The result is a Delaunay triangulation of the points and of O(n) further vertices, every cell
    within `quality_bound`. It depends on the points and the options alone, not on `threads`.
    `Mesh.parameters` tells what the defaults, 0 and 'auto', have become.

    Parameters
    ----------
    points : array_like of float, shape (n, dim), or a surface
        At least two distinct points. Arrays of doubles whose rows are contiguous are read where
        they are. Of an object with `vertices` and `faces`, such as a mesh of trimesh, both are
        taken: the faces are the facets.
    segments : array_like of int, shape (segments, 2), optional
        In 2D and 3D: pairs of points between which edges shall lie, split at points on the way.
    facets : array_like of int, shape (triangles, 3), or a sequence, optional
        In 3D: triangles of a surface, of which those that share an edge, lie in one plane up to
        `coplanar` and have one marker are one facet. Or flat polygons, each a list of points; or
        for each facet a list of loops, of which three points or more are a polygon (one in another
        is a hole), two a segment in the facet, one a vertex in it. Or a surface with `faces`, with
        whose `vertices` the points begin. Facets become triangles of the mesh; they may meet in
        vertices and edges that they share, and nowhere else (`intersections`).
    markers : array_like of int, shape (segments,), optional
        Numbers of the segments, 0 by default; files have them.
    facet_markers : array_like of int, shape (facets,), optional
        Numbers of the facets, 0 by default; files have them.
    regions : sequence of (x, y, label) or (x, y, label, max_edge), optional
        Points of regions that segments bound, in 3D (x, y, z, ...) of those that facets bound, a
        label for the simplices of each, and the longest edge there.
    holes : array_like of float, shape (holes, dim), optional
        Points of regions that are no part of the result, whatever `extent`. Each of `regions` and
        `holes` must be in a region of its own.
    criterion : {'voronoi_aspect', 'radius_edge'}
        Quality measure that `quality_bound` bounds. 'voronoi_aspect': distance from a vertex to the
        farthest corner of its Voronoi cell over half the distance to its nearest neighbour;
        'radius_edge': circumradius of a simplex over its shortest edge.
    quality_bound : float
        Largest value of `criterion`: a smaller one makes better cells and more of them. Aspect:
        from 2.2, 2.5, 3.5, 4.5 to 100, by default 3, 4, 5, 6; radius-edge: from 0.9, 1.1, 1.75,
        2.25 to 50, by default 1.5, 2, 2.5, 3 in 2D, 3D, 4D and above.
    min_angle : float
        Smallest angle of the triangles in degrees, in 2D, in place of `criterion` and
        `quality_bound`. Above 30 the run usually ends; give `max_vertices`, too. Triangles beside
        the cages of a hierarchical mesh may miss it. From 0.6 to 33.7.
    min_dihedral : float
        Least dihedral angle in degrees, in 3D, of tetrahedra with all vertices in one domain:
        Steiner points move and further ones come until no angle is smaller. Not with
        `distance_ratio`. From 0 to 22.
    gives_way : {'angle', 'bound'}
        Promise that gives way where `min_dihedral` and `quality_bound` cannot both be kept; what
        misses it is counted. 'angle': some tetrahedra stay below the dihedral angle; 'bound': some
        cells, or tetrahedra, go beyond the bound.
    extent : {'auto', 'all', 'hull', 'box', 'boundary'}
        Region that the mesh covers; what lies beyond is cut away. Above 3D auto or all. 'auto':
        boundary where segments or facets enclose something, otherwise all; 'all': all of the mesh,
        to the cage round all inputs; 'hull': the convex hull of the inputs, in 2D and 3D; 'box':
        the bounding box of the inputs, in 2D and 3D; 'boundary': the region that segments or facets
        enclose.
    interior : {'auto', 'seeds', 'parity', 'winding'}
        Rule by which regions between segments, in 3D between facets, are inside, where `extent` is
        auto or boundary; seeds may make holes of them. 'auto': parity for the polygons of a GeoJSON
        or WKT file, seeds otherwise; 'seeds': all that cannot be reached from outside without
        crossing a segment or facet; 'parity': regions into which a path from outside crosses an odd
        number of segments or facets; 'winding': regions whose winding number, by the directions of
        the segments or the normals of the facets, is not 0.
    crossings : {'refuse', 'split'}
        Treatment of segments in 2D that cross where no input is. 'refuse': the run is refused;
        'split': the double nearest to the crossing becomes a vertex of both.
    coplanar : float
        Angle from flat in degrees, in 3D, up to which triangles of a surface that share an edge and
        have one marker are one facet, and facets may be bent; by default only as far as roundings
        explain. From 0 to 10.
    max_edge : float
        Length that no edge exceeds of simplices that meet the box of the inputs. Not in
        hierarchical meshes. Above 0.
    distance_ratio : float
        Largest reach of a cell, relative to the distance from its vertex to the nearest input,
        unless that input is the nearest one everywhere in the cell; for filtrations of the mesh.
        Not in hierarchical meshes. From 0.05 to 1.
    size : float, array_like of float with shape (n,), or callable
        The length that edges shall have in the box of the points: everywhere, at each point and
        linear between them, or as a function tells, which is called with an array of shape (dim,), at
        most once for each vertex. Circumradii are at most those of regular simplices with such edges,
        and most edges have between 0.6 times that length and that length. ``inf`` for no bound. An
        exception of the function is raised here.
    background : (Mesh, array_like of float with shape (vertices,)), optional
        A mesh and sizes at its vertices, linear in its simplices; beyond it the sizes of its nearest
        vertex count. With `size` the least counts. To adapt a mesh, mesh the points again with the
        first mesh as background.
    output : {'auto', 'hierarchical', 'well_spaced'}
        Kind of mesh that the run leaves behind. 'auto': well-spaced where an angle, a size,
        `distance_ratio` or an extent other than all is asked for, which cages would break,
        otherwise hierarchical; 'hierarchical': a mesh of linear size, whatever the spread of the
        inputs; 'well_spaced': a mesh of one domain, refined across the scales, too.
    algorithm : {'netmesh', 'svr', 'delaunay'}
        Algorithm that makes the mesh. 'netmesh': the paper's algorithm, O(n log n) whatever the
        spread; 'svr': Sparse Voronoi Refinement, the baseline for comparisons; 'delaunay': the
        Delaunay triangulation of the inputs, without Steiner points.
    threads : int
        Number of threads, 0 for all cores; the mesh does not depend on it. Of use in 2D and 3D from
        524,288 distinct inputs on.
    instruments : bool
        Measurement of ply, of intersections of D-balls and of the constants of the paper's
        Definitions 7 and 8, which takes about as long again as the run or longer. The mesh is the
        same.
    seed : int
        Seed of every random choice: equal inputs, options and seeds make equal meshes. Without
        effect where `ordering` is deterministic.
    max_vertices : int
        Number of vertices beyond which the run fails and leaves the mesh as it was; 0 for as many
        as there are ids.
    ordering : {'sampled_net', 'deterministic_net'}
        Choice of the inputs that a round inserts. 'sampled_net': a sample that `seed` drives;
        'deterministic_net': a net, made without any random number.
    epsilon : float
        Separation at which a cluster becomes a domain of its own: a pair at distance x gets one of
        radius x / `epsilon` if no other vertex is near. A smaller value makes fewer domains. From
        0.05 to 0.6, by default 0.5.
    delta : float
        Spacing of a cage's vertices, relative to the radius of its sphere: a smaller one makes
        rounder cages of more vertices. From 0.1 to 1, by default 0.8, 1, 1, 1 in 2D, 3D, 4D and
        above.
    gamma : float
        Radius within which a new cage vertex yields to an input, relative to its distance to the
        nearest vertex. From 0.01 to 0.25, by default 0.1.
    yield_radius : float
        Radius within which a Steiner point yields to an input, relative to the radius of its empty
        ball. From 0.05 to 1, by default 1.
    encroachment : float
        Distance that vertices outside a domain keep from its centre, relative to its radius over
        `epsilon`. From 1 to 4, by default 1.
    cage_scale : float
        Radius of a cage's sphere, relative to the radius of its domain; keep it clearly above
        `epsilon`. From 0.3 to 0.9, by default 0.8.
    root_scale : float
        Radius of the root ball, relative to the bounding ball of the inputs. From 2 to 16, by
        default 2.5, 2.5, 3, 4 in 2D, 3D, 4D and above.
    progress : callable or progress bar, optional
        A function of a `Progress`, called about every 30 ms; `False` as its answer stops the run.
        Or a bar of tqdm, which is moved along.

    Returns
    -------
    Mesh

    Raises
    ------
    Error
        `InvalidArgumentError` (an option or an array), `NonFiniteError`, `DegenerateInputError`,
        `LimitError`, `CancelledError`, `OutOfMemoryError`. Ctrl-C raises `KeyboardInterrupt`.

    Examples
    --------
    >>> import numpy as np, netmesh
    >>> points = np.random.default_rng(1).random((100, 2))
    >>> m = netmesh.mesh(points, quality_bound=2.5)
    >>> bool((m.points[:100] == points).all())
    True
    >>> m.simplices.shape[1], m.quality().worst_aspect_anywhere <= 2.5
    (3, True)

    A cube, of two triangles a side:

    >>> corners = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    >>> sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    >>> cube = netmesh.mesh(corners, facets=sides, regions=[(0.5, 0.5, 0.5, 7)])
    >>> round(float(cube.volumes.sum()), 12), len(cube.facet_triangles) >= 12
    (1.0, True)
    >>> bool((cube.simplex_regions == 7).all())
    True
    """
    given = {name: value for name, value in locals().items() if name not in _NO_OPTIONS}
    if size is not None and not callable(size):
        sizes = doubles(size, "size")
        given["size"] = sizes if sizes.ndim else float(sizes)
    if isinstance(background, tuple) and len(background) == 2:
        given["background"] = background[0], doubles(background[1], "background")
    points, facets = points_and_facets(points, facets)
    boundary = None
    if not all(value is None for value in (segments, facets, markers, facet_markers, regions, holes)):
        points = point_rows(points)
        boundary = boundary_of(segments, markers, regions, holes, points.shape[1])
        boundary = (*boundary, facets_of(facets, facet_markers))
    return Mesh._run(points, given, progress, boundary)


class Mesh(Arrays):
    """A mesh. `netmesh.mesh` makes it; nothing changes it.

    Its arrays share the library's memory, which they keep alive, and are read-only. An id of -1
    stands for none.

    Examples
    --------
    >>> import netmesh
    >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1], [1, 1.5]], algorithm="delaunay")
    >>> m
    <netmesh.Mesh: dim 2, 4 vertices, 2 simplices>
    >>> m.simplices.shape, m.neighbors.shape
    ((2, 3), (2, 3))
    """

    _options: dict
    _boundary: tuple | None

    def __init__(self) -> None:
        raise TypeError("netmesh.mesh makes meshes")

    @classmethod
    def _run(
        cls, points: Any, options: dict, progress: Any = None, boundary: tuple | None = None
    ) -> Mesh:
        made = cls.__new__(cls)
        made._core = Core(point_rows(points), reporter(progress), options, boundary)
        made._options = options
        made._boundary = boundary
        return made

    def __repr__(self) -> str:
        vertices, simplices = len(self.kinds), len(self.simplices)
        return f"<netmesh.Mesh: dim {self.dim}, {vertices} vertices, {simplices} simplices>"

    def __reduce__(self) -> tuple:
        # The same points and options make the same mesh.
        return Mesh._run, (self._core.input_points(), self._options, None, self._boundary)

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: dict) -> Mesh:
        return self

    @property
    def options(self) -> dict:
        """Options by name, as they were given."""
        return dict(self._options)

    @property
    def parameters(self) -> dict:
        """Options by name, as the run had them: every default filled in, and no 'auto'.

        In 2D with the criterion 'radius_edge', which segments take, `min_angle` and `quality_bound` say
        the same. `size` and `background` are not among them.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], [[0, 1], [1, 2], [2, 0]], min_angle=30)
        >>> m.parameters["output"], m.parameters["extent"]
        ('well_spaced', 'boundary')
        """
        return self._core.parameters

    @property
    def dim(self) -> int:
        """Dimension of the points, 2 to 8."""
        return self.points.shape[1]

    @property
    def points(self) -> np.ndarray:
        """Vertices, float64, shape (vertices, dim): the distinct inputs first, in their order."""
        return self._core.points

    @property
    def simplices(self) -> np.ndarray:
        """Vertices of simplices, int32, shape (simplices, dim + 1), each positively oriented."""
        return self._core.simplices

    @property
    def neighbors(self) -> np.ndarray:
        """Neighbours of simplices, int32, shape (simplices, dim + 1).

        Entry i is across the facet opposite vertex i; -1 on the hull.
        """
        return self._core.neighbors

    @property
    def kinds(self) -> np.ndarray:
        """Origin of each vertex, uint8, shape (vertices,): values of `VertexKind`."""
        return self._core.kinds

    @property
    def vertex_domains(self) -> np.ndarray:
        """Innermost domain of each vertex, int32, shape (vertices,); -1 without domains."""
        return self._core.vertex_domains

    @property
    def precision_limited(self) -> np.ndarray:
        """True for vertices where doubles are too coarse for the bound, bool, shape (vertices,)."""
        return self._core.precision_limited

    @property
    def input_vertices(self) -> np.ndarray:
        """Vertices of inputs, int32, shape (n,); equal inputs share one. See `vertex_inputs`."""
        return self._core.input_vertices

    @functools.cached_property
    def vertex_inputs(self) -> np.ndarray:
        """Inputs of vertices, int32, shape (vertices,); -1 for vertices that are no inputs.

        It is the first of inputs that are equal. So the array is the inverse of `input_vertices`, but
        for duplicates.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> m.input_vertices, m.vertex_inputs
        (array([0, 0, 1, 2], dtype=int32), array([0, 2, 3], dtype=int32))
        """
        return fixed(self._core.vertex_inputs())

    @property
    def segments(self) -> np.ndarray:
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
    def segment_parents(self) -> np.ndarray:
        """Segment that each edge of `segments` is a part of, int32, shape (edges,).

        -1 for edges of a hull or box, and in 3D for edges of facets that are no segments.
        """
        return self._core.segment_parents

    @property
    def facet_triangles(self) -> np.ndarray:
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
    def facet_parents(self) -> np.ndarray:
        """Facet that each of `facet_triangles` is a part of, int32, shape (triangles,).

        Of triangles that are one facet the first; -1 for the boundary of a hull or box.
        """
        return self._core.facet_parents

    @property
    def facet_simplices(self) -> np.ndarray:
        """Simplices that have each of `facet_triangles`, int32, shape (triangles, 2).

        First the one where the normal points to, then the one behind; -1 where the domain ends.
        """
        return self._core.facet_simplices

    @property
    def simplex_regions(self) -> np.ndarray:
        """Label of each simplex' region, int32, shape (simplices,); empty without segments and facets."""
        return self._core.simplex_regions

    @property
    def sizes(self) -> np.ndarray:
        """Sizes that were asked for at vertices, float64, shape (vertices,); empty without.

        They come of `size` and `background`, infinite where there is no bound and where none was needed.
        """
        return self._core.sizes

    @property
    def domains(self) -> np.ndarray:
        """Balls of the hierarchy, fields center (a vertex), parent (-1 for the root's) and radius.

        The root is the first, every parent stands before its children. Empty for 'delaunay'.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1], [1e-9, 0]])
        >>> m.domains["parent"].tolist()
        [-1, 0]
        """
        centers, parents, radii = self._core.domains
        domains = np.empty(len(radii), DOMAIN)
        domains["center"], domains["parent"], domains["radius"] = centers, parents, radii
        return domains

    def placements(self, extent: str = "hull") -> np.ndarray:
        """Tell of each simplex whether it is inside the inputs' hull or box, exactly.

        Parameters
        ----------
        extent : {'hull', 'box'}
            The convex hull of the inputs, or the least box along the axes that holds them.

        Returns
        -------
        ndarray of uint8, shape (simplices,)
            Values of `Placement`: inside, across the boundary or outside.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
        >>> is_inside = m.placements("hull") == netmesh.Placement.INSIDE
        >>> round(float(m.volumes[is_inside].sum()), 12)
        0.5
        """
        return self._core.placements(extent)

    def part(
        self, extent: str = "all", *, across: bool = False, domain: Optional[int] = None
    ) -> Part:
        """Pick some of the simplices.

        Parameters
        ----------
        extent : {'all', 'hull', 'box'}
            Simplices inside the inputs' convex hull, or inside their box, are picked.
        across : bool
            Simplices that are partly inside are picked, too.
        domain : int, optional
            Simplices of this domain and of the domains in it are picked, no others.

        Examples
        --------
        >>> import itertools, numpy as np, netmesh
        >>> m = netmesh.mesh(list(itertools.product([0, 1], repeat=3)))
        >>> bool(m.volumes.sum() > 30), bool(np.isclose(m.part("hull").volumes.sum(), 1))
        (True, True)
        """
        return Part(self._core, (extent, bool(across), domain))

    def filtration(self, kind: str = "alpha", *, threads: int = 1) -> Filtration:
        """Make the faces of all dimensions, with the values of a filtration.

        Parameters
        ----------
        kind : {'alpha', 'mesh'}
            'alpha': alpha values, for a mesh made with ``algorithm='delaunay'``. The value of a face is
            the squared radius of its smallest circumscribing ball if no vertex is strictly in that,
            else the least value of the faces that have it as a facet. Each is the double nearest to
            the exact one. 'mesh': for a mesh with other vertices, best with
            ``output='well_spaced'``: radii at which its Voronoi cells come near the inputs.
            `Filtration.factor` says how near the two are.
        threads : int
            0 for all cores. No value depends on it.

        Raises
        ------
        Error
            `InvalidArgumentError` ('alpha' of a mesh that has other vertices), `LimitError`,
            `OutOfMemoryError`.

        Examples
        --------
        >>> import numpy as np, netmesh
        >>> angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
        >>> circle = np.c_[np.cos(angle), np.sin(angle)]
        >>> alpha = netmesh.mesh(circle, algorithm="delaunay").filtration("alpha")
        >>> bool(np.isclose(alpha.values(2).max(), 1)), float(alpha.values(0).max())
        (True, 0.0)
        >>> near = netmesh.mesh(circle, output="well_spaced").filtration("mesh")
        >>> 1 < near.factor < 3
        True
        """
        return Filtration(self._core.filtration(kind, threads), kind)

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

    def quality(self) -> Quality:
        """Measure the quality. O(vertices + simplices).

        Examples
        --------
        >>> import netmesh
        >>> netmesh.mesh([[0, 0], [1, 0], [0, 1]]).quality().worst_aspect_anywhere <= 3
        True
        """
        return Quality(**self._core.quality())

    def quality_histogram(
        self,
        measure: str = "dihedral_angle",
        bins: Any = None,
        range: Optional[tuple[float, float]] = None,
        *,
        hull: bool = False,
    ) -> tuple[np.ndarray, np.ndarray]:
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
        return histogram(self._core, measure, bins, range, hull)

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

    def export(
        self,
        path: Union[str, os.PathLike],
        format: str = "auto",
        *,
        attributes: Optional[dict] = None,
    ) -> None:
        """Write the mesh to a file, which appears complete or not at all.

        Parameters
        ----------
        path : str or path
        format : str
            'auto' goes by the extension; or 'vtu', 'tetgen_node', 'gmsh', 'medit', 'off', 'ply',
            'xyz', 'csv', 'npy', 'voronoi_json', 'domains_json'.
        attributes : dict of str to array_like of float, shape (vertices, ...), optional
            Values at the vertices by name, for 'vtu', 'tetgen_node', 'gmsh', 'ply', 'csv' and 'npy',
            where they make a structured array; `extend_values` makes them of values at the inputs.
            Names have 1 to 64 ASCII letters, digits, and ``_-.``.

        Examples
        --------
        >>> import os, tempfile, netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     m.export(os.path.join(folder, "mesh.vtu"), attributes={"heat": m.points[:, 0]})
        ...     os.listdir(folder)
        ['mesh.vtu']
        """
        self._export(path, format, attributes)

    def locate(self, points: Any, *, threads: int = 1) -> np.ndarray:
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
            -1 outside. On a face that several simplices share, the least of them.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> m.locate([[0.2, 0.2], [2, 2]])
        array([ 0, -1], dtype=int32)
        """
        points = query_points(points, self.dim)
        found = self._core.locate(points.reshape(-1, self.dim), threads)
        return found.reshape(points.shape[:-1])

    def nearest(
        self, points: Any, *, among: str = "vertices", threads: int = 1
    ) -> tuple[np.ndarray, np.ndarray]:
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
        points = query_points(points, self.dim)
        vertices, distances = self._core.nearest(points.reshape(-1, self.dim), among, threads)
        return vertices.reshape(points.shape[:-1]), distances.reshape(points.shape[:-1])

    def interpolate(
        self,
        values: Any,
        points: Any,
        *,
        interpolation: str = "linear",
        outside: str = "nan",
        threads: int = 1,
    ) -> np.ndarray:
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
        points = query_points(points, self.dim)
        columns = vertex_columns(values, self._core)
        rows = points.reshape(-1, self.dim)
        found = self._core.interpolate(columns, rows, interpolation, outside, threads)
        return shaped_values(found, values, points.shape[:-1])

    def extend_values(self, values: Any, *, threads: int = 1) -> np.ndarray:
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
        columns = value_columns(values, len(self.input_vertices), "input")
        found = self._core.extend_values(columns, threads)
        return shaped_values(found, values, found.shape[:1])

    def to_meshio(self, point_data: Any = None, cell_data: Any = None) -> Any:
        """Convert the mesh to a `meshio.Mesh`, in 2D and 3D.

        Parameters
        ----------
        point_data, cell_data : dict of str to array, optional
            Values of vertices and of simplices, beside the kinds and domains of vertices.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> m.to_meshio({"x": m.points[:, 0]}).cells_dict["triangle"].shape
        (1, 3)
        """
        return _views.to_meshio(self, point_data, cell_data)

    def to_pyvista(self, point_data: Any = None, cell_data: Any = None) -> Any:
        """Convert the mesh to a `pyvista.UnstructuredGrid`, in 2D and 3D.

        Parameters
        ----------
        point_data, cell_data : dict of str to array, optional
            Values of vertices and of simplices, beside the kinds and domains of vertices.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> m.to_pyvista({"x": m.points[:, 0]}).n_cells
        1
        """
        return _views.to_pyvista(self, point_data, cell_data)

    def plot(self, ax: Any = None, **arguments: Any) -> Any:
        """Draw a planar mesh with Matplotlib: edges, and inputs as dots.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; the current ones if none are given.
        **arguments
            Arguments of `matplotlib.axes.Axes.triplot`.

        Returns
        -------
        matplotlib.axes.Axes

        Examples
        --------
        >>> import matplotlib, netmesh
        >>> matplotlib.use("agg")
        >>> netmesh.mesh([[0, 0], [1, 0], [0, 1]]).plot(linewidth=1).get_aspect()
        1.0
        """
        return _views.plot(self, ax, arguments)

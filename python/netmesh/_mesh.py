"""Meshes: `mesh` makes them, `Mesh` holds the arrays and answers questions."""

from __future__ import annotations

import functools
from typing import Any, Literal, Optional

import numpy as np
from numpy.typing import NDArray

from ._arrays import copied, doubles, fixed, point_rows
from ._errors import ArgumentTypeError
from ._exports import Exports
from ._features import Features
from ._filtration import Filtration
from ._input import boundary_of, domain_of, has_boundary
from ._measures import Measures
from ._merging import least_of_merged, standing_points
from ._netmesh import Core
from ._part import Part
from ._progress import reporter
from ._queries import Queries
from ._results import DOMAIN
from ._sizes import size_of
from ._vertices import Vertices

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
    "cutoff",
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
    cutoff: float = 0.0,
    criterion: Literal["voronoi_aspect", "radius_edge"] = "voronoi_aspect",
    quality_bound: float = 0.0,
    min_angle: float = 0.0,
    min_dihedral: float = 0.0,
    gives_way: Literal["angle", "bound"] = "angle",
    extent: Literal["auto", "all", "hull", "box", "boundary"] = "auto",
    interior: Literal["auto", "seeds", "parity", "winding"] = "auto",
    crossings: Literal["refuse", "split"] = "refuse",
    coplanar: float = 0.0,
    labels: Literal["seeds", "regions"] = "seeds",
    max_edge: float = 0.0,
    size_from_curvature: float = 0.0,
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

    - Points and their domain: `points`, `segments`, `facets`, `markers`, `facet_markers`, `regions`,
      `holes`, `cutoff`.
    - Quality: `criterion`, `quality_bound`, `min_angle`, `min_dihedral`, `gives_way`.
    - Domain: `extent`, `interior`, `crossings`, `coplanar`, `labels`.
    - Sizes: `max_edge`, `size_from_curvature`, `distance_ratio`, `size`, `background`.
    - Algorithm: `output`, `algorithm`.
    - Run: `threads`, `instruments`, `seed`, `max_vertices`, `progress`.
    - Constants of the paper: `ordering`, `epsilon`, `delta`, `gamma`, `yield_radius`,
      `encroachment`, `cage_scale`, `root_scale`.

    Parameters
    ----------
    points : array_like of float, shape (n, dim), a surface, or a `Domain`
        At least two distinct points. Arrays of doubles whose rows are contiguous are read where
        they are. Of an object with `vertices` and `faces`, such as a mesh of trimesh, both are
        taken: the faces are the facets. A `Domain`, which `domain` makes of files and of what other
        packages have, comes with segments, facets and markers of its own; `regions` and `holes`
        add to its own.
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
    cutoff : float
        Distance below which points are merged: one of them becomes a vertex and stands for the
        others, as `representatives` chooses. Ends of segments and corners of facets are never
        moved; points near them are merged with them. `Mesh.representatives` and
        `Mesh.input_vertices` tell what became of each point. The least `size` of merged points
        counts.
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
        or WKT file, winding for triangles in space that are closed and oriented alike, seeds
        otherwise; 'seeds': all that cannot be reached from outside without crossing a segment or
        facet; 'parity': regions into which a path from outside crosses an odd number of segments or
        facets; 'winding': regions whose winding number, by the directions of the segments or the
        normals of the facets, is not 0.
    crossings : {'refuse', 'split'}
        Treatment of segments, in 3D of facets too, that cross where no input is. 'refuse': the run
        is refused; 'split': the double nearest to the crossing becomes a vertex of both.
    coplanar : float
        Angle from flat in degrees, in 3D, up to which triangles of a surface that share an edge and
        have one marker are one facet, and facets may be bent; by default only as far as roundings
        explain. From 0 to 10.
    labels : {'seeds', 'regions'}
        Labels of the regions that segments, in 3D facets, separate. 'seeds': those of seeds, and 0;
        'regions': those of seeds; other regions of the domain are numbered from 1 on, by their
        first segments or facets.
    max_edge : float
        Length that no edge exceeds of simplices that meet the box of the inputs. Not in
        hierarchical meshes. Above 0.
    size_from_curvature : float
        Largest distance, in 3D, of an edge's middle from the round surface that facets approximate;
        nothing is round where these bend by more than 50 degrees. Not in hierarchical meshes. Above
        0.
    distance_ratio : float
        Largest reach of a cell, relative to the distance from its vertex to the nearest input,
        unless that input is the nearest one everywhere in the cell; for filtrations of the mesh.
        Not in hierarchical meshes. From 0.05 to 1.
    size : float, array_like of float with shape (n,), or callable
        The length that edges shall have in the box of the points: everywhere, at each point and
        linear between them, or as a function tells: one of a point, an array of shape (dim,); of
        its coordinates, ``f(x, y)`` in 2D; or of points, an array of shape (n, dim), which answers
        with shape (n,) and is called once for all points, then with one row at a time.
        Interpolators are such functions. It is called about once for each vertex. Circumradii are
        at most those of regular simplices with such edges, and most edges have between 0.6 times
        that length and that length. ``inf`` for no bound. An exception of the function is raised
        here.
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
        524,288 distinct inputs on, for the Delaunay triangulation of inputs in 3D from 20,000 on.
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
    if isinstance(background, tuple) and len(background) == 2:
        if isinstance(background[0], Part):
            raise ArgumentTypeError("background[0] is of type Part; it must be a Mesh, as that of the part")
        given["background"] = background[0], doubles(background[1], "background")
    asked = domain_of(
        points, segments, facets, markers=markers, facet_markers=facet_markers, regions=regions, holes=holes
    )
    rows = point_rows(asked.points)
    boundary = boundary_of(asked, rows.shape[1]) if has_boundary(asked) else None
    standing = standing_points(rows, cutoff, boundary)
    rows = rows if standing is None else rows[standing]
    return Mesh._run(rows, given, progress, boundary, standing)


class Mesh(Vertices, Exports, Features, Queries, Measures):
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
        cls,
        points: Any,
        options: dict,
        progress: Any = None,
        boundary: tuple | None = None,
        standing: np.ndarray | None = None,
    ) -> Mesh:
        # Points for which others stand are where these are.
        made = cls.__new__(cls)
        rows = point_rows(points)
        # The caller may change arrays that were given, and a pickle makes the mesh of them again.
        options, boundary = copied(options), copied(boundary)
        asked = options
        if options.get("size") is not None:
            size = size_of(options["size"], rows)
            if standing is not None and isinstance(size, np.ndarray) and size.shape == standing.shape:
                size = least_of_merged(size, standing)
            asked = {**options, "size": size}
        made._core = Core(rows, reporter(progress), asked, boundary)
        made._options = options
        made._boundary = boundary
        made._standing = standing
        return made

    def __repr__(self) -> str:
        vertices, simplices = len(self.kinds), len(self.simplices)
        return f"<netmesh.Mesh: dim {self.dim}, {vertices} vertices, {simplices} simplices>"

    def __reduce__(self) -> tuple:
        # The same points and options make the same mesh.
        given = self._core.input_points(), self._options, None, self._boundary, self._standing
        return Mesh._run, given

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
        the same. `size`, `background` and `cutoff` are not among them.

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
    def points(self) -> NDArray[np.float64]:
        """Vertices, float64, shape (vertices, dim): the distinct inputs first, in their order."""
        return self._core.points

    @property
    def simplices(self) -> NDArray[np.int32]:
        """Vertices of simplices, int32, shape (simplices, dim + 1), each positively oriented."""
        return self._core.simplices

    @property
    def cells(self) -> NDArray[np.int32]:
        """Rows of `points` that each simplex has: `simplices`, under the name that parts have, too."""
        return self._core.simplices

    @property
    def neighbors(self) -> NDArray[np.int32]:
        """Neighbours of simplices, int32, shape (simplices, dim + 1).

        Entry i is across the facet opposite vertex i; -1 on the hull.
        """
        return self._core.neighbors

    @property
    def domains(self) -> NDArray[Any]:
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

    def placements(self, extent: Literal["hull", "box"] = "hull") -> NDArray[np.uint8]:
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
        self,
        extent: Literal["all", "hull", "box"] = "all",
        *,
        across: bool = False,
        domain: Optional[int] = None,
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
        return Part(self, (extent, bool(across), domain))

    def filtration(self, kind: Literal["alpha", "mesh"] = "alpha", *, threads: int = 1) -> Filtration:
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
        return Filtration(self, kind, threads)

"""Ways out of the package: files, and the meshes and pictures of other packages."""

from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _plots, _skfem, _views
from ._arrays import array, data, doubles, vertex_columns
from ._derived import Arrays
from ._errors import ArgumentTypeError, InvalidArgumentError
from ._netmesh import Core
from ._plots import Colors


class Exports(Arrays):
    """Files of a mesh or of a part of it, and what other packages make of it."""

    @property
    def _own(self) -> Core:
        """The core whose arrays are those of the mesh or part itself."""
        return self._core

    def export(
        self,
        path: Union[str, os.PathLike],
        format: str = "auto",
        *,
        attributes: Optional[dict] = None,
    ) -> None:
        """Write the mesh to a file, which appears complete or not at all.

        A part is written with its own vertices and simplices alone, numbered anew.

        Parameters
        ----------
        path : str or path
        format : str
            'auto' goes by the extension; or 'vtu', 'tetgen_node', 'gmsh', 'medit', 'off', 'ply',
            'stl', 'xyz', 'csv', 'npy', 'voronoi_json', 'domains_json', 'svg', 'html'.
        attributes : dict of str to array_like of float, shape (vertices, ...), optional
            Values at the vertices by name, for 'vtu', 'tetgen_node', 'gmsh', 'ply', 'html', 'csv' and
            'npy', where they make a structured array; `extend_values` makes them of values at the inputs.
            Names have 1 to 64 ASCII letters, digits, and ``_-.``. Of a part they are at its vertices
            or at all vertices of the mesh.

        Examples
        --------
        >>> import os, tempfile, netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     m.export(os.path.join(folder, "mesh.vtu"), attributes={"heat": m.points[:, 0]})
        ...     m.part("box", across=True).export(os.path.join(folder, "part.vtu"))
        ...     sorted(os.listdir(folder))
        ['mesh.vtu', 'part.vtu']
        """
        columns = list(_views.checked(attributes, self._columns, "attributes").items())
        self._own.export(path, format, columns)

    def to_meshio(self, point_data: Any = None, cell_data: Any = None) -> Any:
        """Convert the mesh to a `meshio.Mesh`, in 2D and 3D.

        Its cells are the simplices, in 3D the triangles of facets, and the edges of segments, in
        blocks in this order. Data of vertices are ``kind``, ``domain``, ``input``,
        ``precision_limited`` and, where sizes were asked for, ``size``; data of cells, where there are
        segments or facets, ``region`` (0 for what is no simplex), ``marker`` (of the facet or segment,
        0 for simplices) and ``facet`` (-1 for other cells), under the names that ``.vtu`` files have.

        Parameters
        ----------
        point_data, cell_data : dict of str to array, optional
            Further values of vertices and of simplices; facets and segments get NaN or 0. Of a part
            they are those of its own, or of all of the mesh.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], [[0, 1], [1, 2], [2, 0]], markers=[5, 6, 7])
        >>> made = m.to_meshio({"x": m.points[:, 0]})
        >>> made.cells_dict["triangle"].shape == m.simplices.shape
        True
        >>> bool((made.get_cell_data("marker", "line") == m.segment_markers).all())
        True
        """
        return _views.to_meshio(self._own, *self._data(point_data, cell_data))

    def to_pyvista(self, point_data: Any = None, cell_data: Any = None) -> Any:
        """Convert the mesh to a `pyvista.UnstructuredGrid`, in 2D and 3D.

        Its cells are the simplices and, in 3D, after them the triangles of facets; edges of segments
        are field data, ``segments`` and ``segment_markers``. The other data are those of `to_meshio`.

        Parameters
        ----------
        point_data, cell_data : dict of str to array, optional
            Further values of vertices and of simplices; facets get NaN or 0. Of a part they are those
            of its own, or of all of the mesh.

        Examples
        --------
        >>> import netmesh
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
        >>> m.to_pyvista({"x": m.points[:, 0]}).n_cells
        1
        """
        return _views.to_pyvista(self._own, *self._data(point_data, cell_data))

    def to_skfem(self) -> Any:
        """Convert the mesh to a `skfem.MeshTri1` or `skfem.MeshTet1`, in 2D and 3D.

        Subdomains are named by the labels of regions, ``region_7``, and boundaries by the markers of
        segments, in 3D of facets, ``marker_5``: the names of the physical groups of ``.msh`` files,
        which scikit-fem reads through meshio. A mesh without segments and facets has the subdomain
        ``mesh``. Boundaries have the orientation of their segments or facets: their normals point to
        the right of a segment, and where that of a facet points to, but out of the domain on its
        boundary. A warning tells of tetrahedra that are flat in a facet (`flat_simplices`), and of
        points in no simplex.

        Examples
        --------
        >>> import netmesh
        >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
        >>> sides = [[0, 1], [1, 2], [2, 3], [3, 0]]
        >>> m = netmesh.mesh(square, sides, markers=[5, 6, 6, 6], regions=[(0.5, 0.5, 7)], max_edge=0.2)
        >>> made = m.to_skfem()
        >>> sorted(made.boundaries), sorted(made.subdomains)
        (['marker_5', 'marker_6'], ['region_7'])
        >>> bool((made.p[1, made.facets[:, made.boundaries["marker_5"]]] == 0).all())
        True
        """
        return _skfem.to_skfem(self._own)

    def plot(
        self,
        values: Any = None,
        *,
        regions: bool = False,
        by: Optional[str] = None,
        ax: Any = None,
        plotter: Any = None,
        clip: Any = "x",
        off_screen: Optional[bool] = None,
        **arguments: Any,
    ) -> Any:
        """Draw the mesh: with Matplotlib in 2D, with PyVista in 3D.

        In 2D, without values, regions or `by`, edges are drawn, segments, and inputs as dots. In 3D a
        plane cuts the mesh open, between whole tetrahedra; on a screen it can be moved.

        Parameters
        ----------
        values : array_like of float, shape (vertices,) or (simplices,), optional
            Values that colour the mesh, at vertices or of simplices; of vertices where there are as
            many of both. Of a part they are those of its own, or of all of the mesh.
        regions : bool
            Colour simplices by the label of their region.
        by : {'quality', 'radius_edge'}, optional
            Colour simplices by their smallest angle, in 3D dihedral angle, in degrees; or by
            circumradius over shortest edge.
        ax : matplotlib.axes.Axes, optional
            In 2D the axes to draw on; the current ones if none are given.
        plotter : pyvista.Plotter, optional
            In 3D the plotter to draw on; a new one if none is given.
        clip : {'x', '-x', 'y', '-y', 'z', '-z'}, normal, (normal, origin) or False
            In 3D the normal of the plane, through the middle of the mesh if there is no origin, behind
            which the mesh is shown; False for all of the mesh.
        off_screen : bool, optional
            In 3D True for a picture without a window, for ``screenshot``; by default as PyVista is set.
        **arguments
            In 2D keywords of Matplotlib, under their long or short names (`linewidth` or `lw`): of
            `triplot`, or with colours of `tripcolor`, where `color`, `linewidth` and `linestyle` draw
            edges on top. In 3D keywords of `pyvista.Plotter.add_mesh`.

        Returns
        -------
        matplotlib.axes.Axes or pyvista.Plotter
            Nothing is shown before ``show``. ``ax.collections[0]`` is what a colour bar is made of.

        Examples
        --------
        >>> import matplotlib, numpy as np, netmesh
        >>> matplotlib.use("agg")
        >>> m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
        >>> m.plot(linewidth=1).get_aspect()
        1.0
        >>> ax = m.plot(np.hypot(*m.points.T), cmap="magma")
        >>> bar = ax.figure.colorbar(ax.collections[0])
        >>> solid = netmesh.mesh(np.random.default_rng(1).random((50, 3)))
        >>> plotter = solid.plot(by="quality", clip="z", off_screen=True)
        >>> plotter.screenshot(return_img=True).shape[2]
        3
        """
        _views.require_dimension(self._own)
        _views.require_simplices(self._own)
        if hasattr(values, "triplot"):
            # Axes may come first.
            values, ax = None, values if ax is None else ax
        colors = self._colors(values, regions, by)
        dim = self._own.points.shape[1]
        cut = None if isinstance(clip, str) and clip == "x" else clip
        _plots.refuse_others(dim, ax=ax, plotter=plotter, off_screen=off_screen, clip=cut)
        if ax is not None and not hasattr(ax, "triplot"):
            raise ArgumentTypeError(f"ax is of type {type(ax).__name__}; it must be axes of Matplotlib")
        if dim == 2:
            return _plots.plot_plane(self._own, colors, ax, arguments)
        return _plots.plot_space(self._own, colors, plotter, clip, off_screen, arguments)

    def _colors(self, values: Any, regions: bool, by: Optional[str]) -> Optional[Colors]:
        names = ["values"] * (values is not None) + ["regions"] * bool(regions) + ["by"] * (by is not None)
        if len(names) > 1:
            raise InvalidArgumentError(f"{' and '.join(names)} both give colours; give one of them")
        if regions:
            labels = self._own.simplex_regions
            if not len(labels):
                raise InvalidArgumentError("regions is True; the mesh has no segments or facets")
            return Colors("regions", labels, "region")
        if by is not None:
            name = {"quality": "smallest angle"}.get(by, by)
            return Colors("simplices", self._measure(by), name)
        return None if values is None else self._given_colors(values)

    def _given_colors(self, values: Any) -> Colors:
        given = doubles(values, "values")
        # What is shown comes first, then the mesh that it is a part of.
        for core in (self._own, self._core):
            if given.ndim == 1 and len(given) == len(core.kinds):
                return Colors("vertices", self._of_vertices(given, "values"), "values")
            if given.ndim == 1 and len(given) == len(core.simplices):
                return Colors("simplices", self._of_simplices(given, "values"), "values")
        counts = f"({len(self._own.kinds)},), of vertices, or ({len(self._own.simplices)},), of simplices"
        raise InvalidArgumentError(f"values has shape {given.shape}; it must be {counts}")

    def _measure(self, by: str) -> NDArray[np.float64]:
        points, cells = self._own.points, self._own.simplices
        if by == "quality":
            return _plots.smallest_angles(points, cells)
        if by == "radius_edge":
            return self.circumradii / _plots.shortest_edges(points, cells)
        raise InvalidArgumentError(f"by is {by!r}; it must be 'quality' or 'radius_edge'")

    def _data(self, point_data: Any, cell_data: Any) -> tuple[dict, dict]:
        of_vertices = _views.checked(point_data, self._of_vertices, "point_data")
        return of_vertices, _views.checked(cell_data, self._of_simplices, "cell_data")

    def _columns(self, values: Any, name: str) -> np.ndarray:
        """Return columns of values at the vertices of what is written."""
        return vertex_columns(values, self._own, name)

    def _of_vertices(self, values: Any, name: str) -> np.ndarray:
        """Return an array with an element or a row for each vertex of what is shown."""
        return data(array(values, name), len(self._own.kinds), "vertex", name)

    def _of_simplices(self, values: Any, name: str) -> np.ndarray:
        """Return an array with an element or a row for each simplex of what is shown."""
        return data(array(values, name), len(self._own.simplices), "simplex", name)

"""Ways out of the package: files, and the meshes and pictures of other packages."""

from __future__ import annotations

import os
from typing import Any, Optional, Union

from . import _views
from ._part import Arrays


class Exports(Arrays):
    """Files of a mesh, and what other packages make of it."""

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
            'stl', 'xyz', 'csv', 'npy', 'voronoi_json', 'domains_json', 'svg', 'html'.
        attributes : dict of str to array_like of float, shape (vertices, ...), optional
            Values at the vertices by name, for 'vtu', 'tetgen_node', 'gmsh', 'ply', 'html', 'csv' and
            'npy', where they make a structured array; `extend_values` makes them of values at the inputs.
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
        return _views.to_meshio(self._core, point_data, cell_data)

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
        return _views.to_pyvista(self._core, point_data, cell_data)

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
        return _views.plot(self._core, ax, arguments)

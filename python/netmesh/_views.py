"""Meshes for other packages, which are imported when they are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ._errors import InvalidArgumentError

if TYPE_CHECKING:
    from ._mesh import Mesh

#: Names of meshio, numbers of VTK.
CELLS = {2: ("triangle", 5), 3: ("tetra", 10)}


def to_meshio(mesh: Mesh, point_data: Optional[dict], cell_data: Optional[dict]) -> Any:
    import meshio

    name, _ = _cell(mesh)
    return meshio.Mesh(
        mesh.points,
        [(name, mesh.simplices)],
        point_data=_point_data(mesh, point_data),
        cell_data={name: [np.asarray(values)] for name, values in (cell_data or {}).items()},
    )


def to_pyvista(mesh: Mesh, point_data: Optional[dict], cell_data: Optional[dict]) -> Any:
    import pyvista

    _, number = _cell(mesh)
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.dim] = mesh.points
    grid = pyvista.UnstructuredGrid({number: mesh.simplices.astype(np.int64)}, points)
    for name, values in _point_data(mesh, point_data).items():
        grid.point_data[name] = np.array(values)
    for name, values in (cell_data or {}).items():
        grid.cell_data[name] = np.array(values)
    return grid


def plot(mesh: Mesh, ax: Any, arguments: dict) -> Any:
    if mesh.dim != 2:
        raise InvalidArgumentError(f"the mesh has dim = {mesh.dim}; only planar ones can be plotted")
    import matplotlib.pyplot

    ax = matplotlib.pyplot.gca() if ax is None else ax
    x, y = mesh.points.T
    ax.triplot(x, y, mesh.simplices, **{"linewidth": 0.5, "color": "tab:blue", **arguments})
    inputs = np.unique(mesh.input_vertices)
    ax.plot(x[inputs], y[inputs], "k.", markersize=2)
    ax.set_aspect("equal")
    return ax


def _cell(mesh: Mesh) -> tuple[str, int]:
    if mesh.dim not in CELLS:
        raise InvalidArgumentError(f"the mesh has dim = {mesh.dim}; it must be 2 or 3")
    return CELLS[mesh.dim]


def _point_data(mesh: Mesh, more: Optional[dict]) -> dict:
    data = {"kind": mesh.kinds, "domain": mesh.vertex_domains}
    return {**data, **{name: np.asarray(values) for name, values in (more or {}).items()}}

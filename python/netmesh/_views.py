"""Meshes for other packages, which are imported when they are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ._arrays import data
from ._errors import InvalidArgumentError

if TYPE_CHECKING:
    from ._mesh import Mesh

#: Names of meshio, numbers of VTK.
CELLS = {2: ("triangle", 5), 3: ("tetra", 10)}


def to_meshio(mesh: Mesh, point_data: Optional[dict], cell_data: Optional[dict]) -> Any:
    import meshio

    name, _ = _cell(mesh)
    of_cells = _cell_data(mesh, cell_data)
    return meshio.Mesh(
        mesh.points,
        [(name, mesh.simplices)],
        point_data=_point_data(mesh, point_data),
        cell_data={name: [values] for name, values in of_cells.items()},
    )


def to_pyvista(mesh: Mesh, point_data: Optional[dict], cell_data: Optional[dict]) -> Any:
    import pyvista

    _, number = _cell(mesh)
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.dim] = mesh.points
    grid = pyvista.UnstructuredGrid({number: mesh.simplices.astype(np.int64)}, points)
    for name, values in _point_data(mesh, point_data).items():
        grid.point_data[name] = values.copy()
    for name, values in _cell_data(mesh, cell_data).items():
        grid.cell_data[name] = values.copy()
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
    of_vertices = _checked(more, len(mesh.points), "vertex", "point_data")
    return {"kind": mesh.kinds, "domain": mesh.vertex_domains, **of_vertices}


def _cell_data(mesh: Mesh, given: Optional[dict]) -> dict:
    return _checked(given, len(mesh.simplices), "simplex", "cell_data")


def _checked(given: Optional[dict], count: int, things: str, name: str) -> dict:
    pairs = (given or {}).items()
    return {key: data(values, count, things, f"{name}[{key!r}]") for key, values in pairs}

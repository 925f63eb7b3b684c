"""Meshes for other packages, which are imported when they are asked for."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import data
from ._errors import InvalidArgumentError
from ._netmesh import Core

#: Names of meshio, numbers of VTK.
CELLS = {2: ("triangle", 5), 3: ("tetra", 10)}


def to_meshio(core: Core, point_data: Optional[dict], cell_data: Optional[dict]) -> Any:
    import meshio

    name, _ = _cell(core)
    of_cells = _cell_data(core, cell_data)
    return meshio.Mesh(
        core.points,
        [(name, core.simplices)],
        point_data=_point_data(core, point_data),
        cell_data={name: [values] for name, values in of_cells.items()},
    )


def to_pyvista(core: Core, point_data: Optional[dict], cell_data: Optional[dict]) -> Any:
    import pyvista

    _, number = _cell(core)
    points = np.zeros((len(core.points), 3))
    points[:, : core.points.shape[1]] = core.points
    grid = pyvista.UnstructuredGrid({number: core.simplices.astype(np.int64)}, points)
    for name, values in _point_data(core, point_data).items():
        grid.point_data[name] = values.copy()
    for name, values in _cell_data(core, cell_data).items():
        grid.cell_data[name] = values.copy()
    return grid


def plot(core: Core, ax: Any, arguments: dict) -> Any:
    dim = core.points.shape[1]
    if dim != 2:
        raise InvalidArgumentError(f"the mesh has dim = {dim}; only planar ones can be plotted")
    import matplotlib.pyplot

    ax = matplotlib.pyplot.gca() if ax is None else ax
    x, y = core.points.T
    ax.triplot(x, y, core.simplices, **{"linewidth": 0.5, "color": "tab:blue", **arguments})
    inputs = np.unique(core.input_vertices)
    ax.plot(x[inputs], y[inputs], "k.", markersize=2)
    ax.set_aspect("equal")
    return ax


def _cell(core: Core) -> tuple[str, int]:
    dim = core.points.shape[1]
    if dim not in CELLS:
        raise InvalidArgumentError(f"the mesh has dim = {dim}; it must be 2 or 3")
    return CELLS[dim]


def _point_data(core: Core, more: Optional[dict]) -> dict:
    of_vertices = _checked(more, len(core.points), "vertex", "point_data")
    return {"kind": core.kinds, "domain": core.vertex_domains, **of_vertices}


def _cell_data(core: Core, given: Optional[dict]) -> dict:
    return _checked(given, len(core.simplices), "simplex", "cell_data")


def _checked(given: Optional[dict], count: int, things: str, name: str) -> dict:
    pairs = (given or {}).items()
    return {key: data(values, count, things, f"{name}[{key!r}]") for key, values in pairs}

"""Meshes for other packages, which are imported when they are asked for."""

from __future__ import annotations

import collections.abc
from typing import Any, Callable

import numpy as np

from ._errors import ArgumentTypeError, InvalidArgumentError
from ._netmesh import Core

#: Names of meshio for cells of dimension 1, 2 and 3.
_NAMES = {1: "line", 2: "triangle", 3: "tetra"}

#: Numbers of VTK for cells of dimension 2 and 3.
_NUMBERS = {2: 5, 3: 10}


def to_meshio(core: Core, point_data: dict, cell_data: dict) -> Any:
    """Make a `meshio.Mesh` with a block of simplices, one of facets in space and one of segments."""
    require_dimension(core)
    import meshio

    blocks = [core.simplices, *_facets(core)]
    if len(core.segments):
        blocks.append(core.segments)
    return meshio.Mesh(
        core.points,
        [(_NAMES[block.shape[1] - 1], block) for block in blocks],
        point_data=_joined(_point_data(core), point_data, "point_data"),
        cell_data=_joined(_cell_data(core, blocks), _filled(cell_data, blocks), "cell_data"),
    )


def to_pyvista(core: Core, point_data: dict, cell_data: dict) -> Any:
    """Make a `pyvista.UnstructuredGrid` with the cells and the data that ``.vtu`` files have."""
    require_dimension(core)
    import pyvista

    blocks = [core.simplices, *_facets(core)]
    cells = {_NUMBERS[block.shape[1] - 1]: block.astype(np.int64) for block in blocks}
    grid = pyvista.UnstructuredGrid(cells, points_in_space(core.points))
    for name, values in _joined(_point_data(core), point_data, "point_data").items():
        grid.point_data[name] = values.copy()
    of_cells = _joined(_cell_data(core, blocks), _filled(cell_data, blocks), "cell_data")
    for name, parts in of_cells.items():
        grid.cell_data[name] = np.concatenate(parts)
    if len(core.segments):
        grid.field_data["segments"] = core.segments.copy()
        grid.field_data["segment_markers"] = core.segment_markers()
    return grid


def _joined(own: dict, given: dict, name: str) -> dict:
    """Return the arrays of the mesh and those that are given, under other names."""
    for key in given:
        if key in own:
            raise InvalidArgumentError(f"{name} has {key!r}, a name that the mesh has for something else")
    return {**own, **given}


def points_in_space(points: np.ndarray) -> np.ndarray:
    """Return a copy of points of the plane, or of space, with three coordinates."""
    found = np.zeros((len(points), 3))
    found[:, : points.shape[1]] = points
    return found


def require_dimension(core: Core, dimensions: tuple[int, ...] = (2, 3)) -> None:
    """Refuse a mesh of another dimension."""
    dim = core.points.shape[1]
    if dim not in dimensions:
        rule = " or ".join(map(str, dimensions))
        raise InvalidArgumentError(f"the mesh has dim = {dim}; it must be {rule}")


def require_simplices(core: Core) -> None:
    """Refuse a part without simplices."""
    if not len(core.simplices):
        raise InvalidArgumentError("the part has no simplices; there is nothing to show or to solve on")


def checked(given: Any, check: Callable[[Any, str], np.ndarray], name: str) -> dict:
    """Return arrays by name after `check`, which is told what messages call each."""
    if given is not None and not isinstance(given, collections.abc.Mapping):
        kind = type(given).__name__
        raise ArgumentTypeError(f"{name} is of type {kind}; it must be a dict of arrays by name")
    return {key: check(values, f"{name}[{key!r}]") for key, values in (given or {}).items()}


def _facets(core: Core) -> list:
    return [core.facet_triangles] if len(core.facet_triangles) else []


def _point_data(core: Core) -> dict:
    found = {
        "kind": core.kinds,
        "domain": core.vertex_domains,
        "input": core.vertex_inputs(),
        "precision_limited": core.precision_limited.astype(np.uint8),
    }
    return {**found, "size": core.sizes} if len(core.sizes) else found


def _cell_data(core: Core, blocks: list) -> dict:
    """Return the arrays of the mesh for each block: regions of simplices, facets and markers."""
    found = {}
    zeros = [np.zeros(len(block), np.int32) for block in blocks]
    if len(core.simplex_regions):
        found["region"] = [core.simplex_regions, *zeros[1:]]
    if len(blocks) > 1:
        markers = {3: core.facet_markers, 2: core.segment_markers}
        found["marker"] = [zeros[0], *(markers[block.shape[1]]() for block in blocks[1:])]
    if len(core.facet_triangles):
        none = [np.full(len(block), -1, np.int32) for block in blocks]
        found["facet"] = [none[0], core.facet_parents, *none[2:]]
    return found


def _filled(given: dict, blocks: list) -> dict:
    """Return values of simplices for each block: not a number, or 0, for what is no simplex."""
    found = {}
    for name, values in given.items():
        filler = np.nan if values.dtype.kind in "fc" else np.zeros(1, values.dtype)[0]
        rest = [np.full((len(block), *values.shape[1:]), filler, values.dtype) for block in blocks[1:]]
        found[name] = [values, *rest]
    return found

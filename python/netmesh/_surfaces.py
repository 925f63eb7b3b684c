"""Domains in space: surfaces with vertices and faces, polygons of PyVista, meshes of meshio."""

from __future__ import annotations

import warnings
from typing import Any, Optional

import numpy as np

from ._arrays import doubles, whole_numbers
from ._errors import InvalidArgumentError

#: Cells of meshio that become facets.
_FACETS = ("triangle", "quad", "polygon")

#: Cell data of meshio that have the markers of elements, by the formats that they come from.
_MARKERS = ("gmsh:physical", "medit:ref")


def is_surface(thing: Any) -> bool:
    """Tell whether an object has vertices and faces, as meshes of trimesh have."""
    return hasattr(thing, "vertices") and hasattr(thing, "faces")


def of_surface(x: Any, markers: Optional[str]) -> dict[str, Any]:
    """Return the fields of an object with vertices and faces."""
    fields = {"points": doubles(x.vertices, "x.vertices"), "facets": x.faces}
    if markers is not None:
        data = getattr(x, "face_attributes", {})
        fields["facet_markers"] = _named(data, markers, "x.face_attributes", len(x.faces))
    return fields


def _is_polydata(thing: Any) -> bool:
    return all(hasattr(thing, name) for name in ("points", "faces", "lines", "verts", "strips"))


def _of_polydata(x: Any, markers: Optional[str]) -> dict[str, Any]:
    """Return the fields of a PyVista PolyData, whose cells are vertices, lines, polygons, strips."""
    if len(x.strips):
        raise InvalidArgumentError("x has strips of triangles; its triangulate() makes triangles of them")
    points = doubles(x.points, "x.points")
    lines, polygons = _packed(x.lines), _packed(x.faces)
    fields: dict[str, Any] = {"points": points}
    numbers = None
    if markers is not None:
        numbers = _named(x.cell_data, markers, "x.cell_data", x.n_cells)
    first = len(_packed(x.verts))
    if lines:
        fields["segments"] = np.concatenate([np.column_stack([line[:-1], line[1:]]) for line in lines])
        if numbers is not None:
            own = numbers[first : first + len(lines)]
            fields["markers"] = np.repeat(own, [len(line) - 1 for line in lines])
    if polygons:
        fields["facets"] = _alike(polygons)
        if numbers is not None:
            fields["facet_markers"] = numbers[first + len(lines) :]
    return fields


def _packed(cells: Any) -> list[np.ndarray]:
    """Return lists of points that stand one after the other, each behind its length."""
    found, at, cells = [], 0, whole_numbers(cells, "x")
    while at < len(cells):
        end = at + 1 + int(cells[at])
        found.append(cells[at + 1 : end])
        at = end
    return found


def _alike(polygons: list[np.ndarray]) -> Any:
    """Return triangles as one array, and others as they are."""
    return np.stack(polygons) if all(len(one) == 3 for one in polygons) else polygons


def _is_grid(thing: Any) -> bool:
    return hasattr(thing, "extract_surface") and hasattr(thing, "points")


def _of_grid(x: Any, markers: Optional[str]) -> dict[str, Any]:
    rule = "only a PolyData is a domain; its extract_surface() makes one"
    raise InvalidArgumentError(f"x is of type {type(x).__name__}; {rule}")


def _is_meshio(thing: Any) -> bool:
    return all(hasattr(thing, name) for name in ("points", "cells", "cell_data"))


def _of_meshio(x: Any, markers: Optional[str]) -> dict[str, Any]:
    """Return the fields of a meshio Mesh."""
    points = doubles(x.points, "x.points")
    if points.ndim == 2 and points.shape[1] == 3 and not points[:, 2].any():
        points = points[:, :2]
    kinds_of_facets = _FACETS if points.shape[-1] == 3 else ()
    others = sorted({block.type for block in x.cells} - {"line", "vertex", *kinds_of_facets})
    if others:
        warnings.warn(f"x has cells of the kinds {', '.join(others)}, which are left out", stacklevel=4)
    names = [markers] if markers is not None else [name for name in _MARKERS if name in x.cell_data]
    numbers: list = _by_block(x, names[0]) if names else [None] * len(x.cells)
    fields: dict[str, Any] = {"points": points}
    lines = _blocks(x, numbers, ("line",))
    if lines is not None:
        ends, fields["markers"] = lines
        fields["segments"] = np.concatenate(ends)
    facets = _blocks(x, numbers, kinds_of_facets)
    if facets is not None:
        blocks, fields["facet_markers"] = facets
        fields["facets"] = _alike([polygon for block in blocks for polygon in block])
    return fields


def _blocks(x: Any, numbers: Any, kinds: tuple[str, ...]) -> Optional[tuple[list, Optional[np.ndarray]]]:
    """Return the cells of some kinds, an array for each block, and the markers of all."""
    chosen = [at for at, block in enumerate(x.cells) if block.type in kinds and len(block.data)]
    if not chosen:
        return None
    cells = [whole_numbers(x.cells[at].data, f"x.cells[{at}].data") for at in chosen]
    if any(numbers[at] is None for at in chosen):
        return cells, None
    return cells, np.concatenate([numbers[at] for at in chosen])


def _by_block(x: Any, name: str) -> list[np.ndarray]:
    if name not in x.cell_data:
        raise InvalidArgumentError(f"markers is {name!r}; x.cell_data has {_list(x.cell_data)}")
    blocks = x.cell_data[name]
    return [whole_numbers(block, f"x.cell_data[{name!r}][{at}]") for at, block in enumerate(blocks)]


def _named(data: Any, name: str, whose: str, count: int) -> np.ndarray:
    """Return the whole numbers that data have under a name, one for each of `count` cells."""
    if name not in data:
        raise InvalidArgumentError(f"markers is {name!r}; {whose} has {_list(data)}")
    found = whole_numbers(data[name], f"{whose}[{name!r}]")
    if found.shape != (count,):
        raise InvalidArgumentError(f"{whose}[{name!r}] has shape {found.shape}; it must be ({count},)")
    return found


def _list(data: Any) -> str:
    return ", ".join(map(repr, data)) or "no data"


#: What is a domain in space, and how its fields are found; the first that fits counts.
KINDS = (
    (_is_polydata, _of_polydata),
    (_is_grid, _of_grid),
    (_is_meshio, _of_meshio),
    (is_surface, of_surface),
)

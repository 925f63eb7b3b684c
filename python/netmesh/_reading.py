"""The content of files, and of GeoJSON, as fields of a domain."""

from __future__ import annotations

import os
import warnings
from typing import Any

import numpy as np

from ._netmesh import read_file, read_geojson


def content_of_file(path: Any) -> dict[str, Any]:
    """Return the fields of a domain that a file has; warn of what else it has."""
    found = read_file(path)
    counts = zip(found["left_out"], ("edges", "faces", "cells"))
    left_out = [f"{count} {name if count > 1 else name[:-1]}" for count, name in counts if count]
    if left_out:
        rest = "; its facets are taken" if found["facets"] else "; its points are taken"
        warnings.warn(f"{os.fspath(path)}: left out are {', '.join(left_out)}{rest}", stacklevel=5)
    return _fields(found)


def content_of_geojson(text: str) -> dict[str, Any]:
    """Return the fields of a domain that GeoJSON has."""
    return _fields(read_geojson(text))


def _fields(found: dict[str, Any]) -> dict[str, Any]:
    dim = found["points"].shape[1]
    fields = {"points": found["points"]}
    if len(found["segments"]):
        fields |= {"segments": found["segments"], "markers": found["markers"]}
        if found["sides"].any():
            fields["sides"] = found["sides"]
    if found["facets"]:
        fields["facets"], fields["facet_markers"] = _facets(*found["facets"])
    given = [region for region in found["regions"] if not region[-1]]
    regions = [_region(seed[:dim], label, max_edge) for seed, label, max_edge, _ in given]
    if regions:
        fields["regions"] = regions
    holes = [seed[:dim] for seed, *_, is_hole in found["regions"] if is_hole]
    if holes:
        fields["holes"] = np.stack(holes)
    return fields


def _region(seed: Any, label: int, max_edge: float) -> tuple:
    return (*seed, label) if max_edge == 0 else (*seed, label, max_edge)


def _facets(
    loops: np.ndarray, starts: np.ndarray, inputs: np.ndarray, markers: np.ndarray, are_triangles: bool
) -> tuple[Any, np.ndarray]:
    """Return triangles as an array, others as loops of inputs, and the markers."""
    if are_triangles:
        return inputs.reshape(-1, 3), markers
    lists = np.split(inputs, starts[1:-1])
    return [lists[first:end] for first, end in zip(loops[:-1], loops[1:])], markers

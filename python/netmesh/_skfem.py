"""Meshes of scikit-fem, with the names that physical groups of ``.msh`` files have."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from ._netmesh import Core
from ._views import require_dimension, require_simplices


def to_skfem(core: Core) -> Any:
    """Make a `skfem.MeshTri1` or `skfem.MeshTet1` with named boundaries and subdomains."""
    require_dimension(core)
    import skfem
    from skfem.generic_utils import OrientedBoundary

    require_simplices(core)
    unused = len(core.points) - len(np.unique(core.simplices))
    if unused:
        rule = "whose rows of matrices are zero; part('all').to_skfem() has no such points"
        warnings.warn(f"{unused} of the points are in no simplex, {rule}", stacklevel=3)
    flat = len(core.flat_simplices)
    if flat:
        rule = "flat but for roundings, and spoil matrices; remove_elements(mesh.flat_simplices) leaves them out"
        warnings.warn(f"{flat} of the simplices have all vertices on one facet: they are {rule}", stacklevel=3)
    dim = core.points.shape[1]
    kind = skfem.MeshTri1 if dim == 2 else skfem.MeshTet1
    made = kind(core.points.T.copy(), core.simplices.T.copy())
    subdomains = _groups("region", core.simplex_regions)
    if not subdomains:
        subdomains = {"mesh": np.arange(len(core.simplices), dtype=np.int32)}
    if dim == 2:
        features, markers, behind = core.segments, core.segment_markers(), _left_of_segments(core)
    else:
        features, markers = core.facet_triangles, core.facet_markers()
        behind = core.facet_simplices[:, 1]
    facets = _numbers_of(features, made.facets.T, len(core.points))
    # A facet of the domain's boundary has one side alone.
    is_second = ((made.f2t[1, facets] == behind) & (behind >= 0)).astype(np.int64)
    boundaries = {
        name: OrientedBoundary(facets[chosen], is_second[chosen])
        for name, chosen in _groups("marker", markers).items()
    }
    return made.with_subdomains(subdomains).with_boundaries(boundaries)


def _groups(prefix: str, labels: np.ndarray) -> dict:
    """Return the places of each label, ascending, by the names of physical groups."""
    order = np.argsort(labels, kind="stable").astype(np.int32)
    values, starts = np.unique(labels[order], return_index=True)
    pieces = np.split(order, starts[1:]) if len(values) else []
    return {f"{prefix}_{value}": piece for value, piece in zip(values.tolist(), pieces)}


def _left_of_segments(core: Core) -> np.ndarray:
    """Return the triangle on the left of each edge of a segment, -1 for none."""
    count = len(core.points)
    triangles = core.simplices.astype(np.int64)
    # Triangles are counterclockwise: they are on the left of their sides.
    sides = (triangles * count + np.roll(triangles, -1, axis=1)).ravel()
    order = np.argsort(sides)
    ends = core.segments.astype(np.int64)
    keys = ends[:, 0] * count + ends[:, 1]
    places = order[np.searchsorted(sides, keys, sorter=order).clip(max=len(sides) - 1)]
    return np.where(sides[places] == keys, places // 3, -1)


def _numbers_of(faces: np.ndarray, among: np.ndarray, count: int) -> np.ndarray:
    """Return the number of each face among faces with the same vertices, which are below `count`."""
    both = np.sort(np.concatenate([among, faces]).astype(np.int64), axis=1)
    keys = both[:, 0]
    for column in both.T[1:]:
        # Ranks keep keys below the square of a number of faces.
        keys = np.unique(keys, return_inverse=True)[1].reshape(-1) * count + column
    own, wanted = keys[: len(among)], keys[len(among) :]
    order = np.argsort(own)
    return order[np.searchsorted(own, wanted, sorter=order)]

"""Points that others stand for: `cutoff` of `mesh`."""

from __future__ import annotations

from typing import Optional

import numpy as np

from . import _netmesh
from ._arrays import contiguous, require_finite, tolerance
from ._point_index import PointIndex

#: Dimensions in which points may be ends of segments or corners of facets.
_BOUNDED = (2, 3)


def standing_points(points: np.ndarray, cutoff: float, boundary: tuple | None) -> Optional[np.ndarray]:
    """Return for each point the one that stands for it, int32; None if each does for itself.

    Ends of segments and corners of facets stand for themselves, since they shall stay where they are,
    and for points that are nearer to them than the cutoff. Among the rest `representatives` chooses.
    """
    cutoff = tolerance(cutoff, "cutoff", 0.0)
    if cutoff == 0:
        return None
    require_finite(points, "points")
    standing = np.arange(len(points), dtype=np.int32)
    corners = _corners(boundary, points)
    others = np.setdiff1d(standing, corners)
    if len(corners):
        index = PointIndex(points[corners])
        # Of equal ones the first stands for all.
        standing[corners] = corners[index.nearest(index.points, 1)[0]]
        nearest, distances = index.nearest(contiguous(points[others]), 1)
        is_near = distances < cutoff
        standing[others[is_near]] = corners[nearest[is_near]]
        others = others[~is_near]
    standing[others] = others[_netmesh.representatives(contiguous(points[others]), cutoff)]
    return standing


def least_of_merged(sizes: np.ndarray, standing: np.ndarray) -> np.ndarray:
    """Return sizes of points that became one: the least of theirs."""
    least = sizes.copy()
    np.minimum.at(least, standing, sizes)
    return least[standing]


def _corners(boundary: tuple | None, points: np.ndarray) -> np.ndarray:
    """Return the points that segments and facets have; the library refuses numbers that none has."""
    if boundary is None or points.shape[1] not in _BOUNDED:
        return np.zeros(0, np.int32)
    segments, facets = boundary[0], boundary[3]
    inputs = segments.reshape(-1) if facets is None else np.concatenate([segments.reshape(-1), facets[2]])
    is_one = (0 <= inputs) & (inputs < len(points))
    return np.unique(inputs[is_one]).astype(np.int32)

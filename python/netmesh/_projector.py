"""The sparse matrix that takes values at the vertices of a mesh to points."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import query_points, tolerance
from ._errors import InvalidArgumentError
from ._netmesh import Core


def projector(core: Core, points: Any, outside: str, tol: Optional[float], threads: int) -> Any:
    """Make the matrix of barycentric coordinates, a row for each point."""
    import scipy.sparse

    rules = ("zero", "nearest", "refuse")
    if outside not in rules:
        raise InvalidArgumentError(f"outside is {outside!r}; it must be one of {', '.join(map(repr, rules))}")
    dim = core.points.shape[1]
    points = query_points(points, dim)
    if points.ndim != 2:
        raise InvalidArgumentError(f"points has shape {points.shape}; it must be (n, {dim})")
    allowed = tolerance(tol, "tol", 100 * float(np.finfo(float).eps))
    simplices, weights = core.weigh(points, allowed, threads)
    missing = np.flatnonzero(simplices == -1)
    if len(missing) and outside == "refuse":
        at = missing[0]
        message = f"points[{at}] is outside the mesh, as {len(missing)} points are"
        raise InvalidArgumentError(f"{message}; outside='zero' or 'nearest' takes them")
    columns = core.simplices[simplices]
    weights[missing] = 0
    if len(missing) and outside == "nearest":
        columns[missing, 0], _ = core.nearest(points[missing], "vertices", threads)
        weights[missing, 0] = 1
    order = np.argsort(columns, axis=1)
    columns = np.take_along_axis(columns, order, axis=1)
    weights = np.take_along_axis(weights, order, axis=1)
    is_kept = weights != 0
    starts = np.concatenate([[0], np.cumsum(is_kept.sum(axis=1))])
    shape = (len(points), len(core.points))
    return scipy.sparse.csr_array((weights[is_kept], columns[is_kept], starts), shape=shape)

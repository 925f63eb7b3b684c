"""The nearest of some points, without a triangulation of them."""

from __future__ import annotations

import functools

import numpy as np

from ._arrays import contiguous
from ._netmesh import PointIndexCore


class PointIndex:
    """Points in 2 to 8 dimensions, shape (n, ndim), for the nearest of them."""

    def __init__(self, points: np.ndarray) -> None:
        self.points = contiguous(points)

    @functools.cached_property
    def _core(self) -> PointIndexCore:
        return PointIndexCore(self.points)

    def __getstate__(self) -> dict:
        # The index is made again where it is needed.
        return {"points": self.points}

    def nearest(self, rows: np.ndarray, threads: int) -> tuple[np.ndarray, np.ndarray]:
        """Find the nearest point to each row, of equally near ones the first, and its distance."""
        return self._core.nearest(rows, threads)

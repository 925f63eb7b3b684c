"""Histograms of the quality."""

from __future__ import annotations

import operator
from typing import Any, Optional

import numpy as np

from ._errors import InvalidArgumentError
from ._netmesh import Core

#: The angles that measures in degrees may have.
_RANGES = {"dihedral_angle": (0.0, 180.0), "smallest_angle": (0.0, 90.0)}


def histogram(
    core: Core, measure: str, bins: Any, extent: Optional[tuple[float, float]], hull: bool
) -> tuple[np.ndarray, np.ndarray]:
    """What `Mesh.quality_histogram` answers."""
    edges = _edges(core, measure, 18 if bins is None else bins, extent, hull)
    counts, _, _ = core.quality_histogram(measure, hull, edges.tolist())
    return counts[1:-1], edges


def _edges(
    core: Core, measure: str, bins: Any, extent: Optional[tuple[float, float]], hull: bool
) -> np.ndarray:
    if np.ndim(bins) > 0:
        edges = np.asarray(bins, dtype=np.float64)
        if edges.ndim != 1 or len(edges) < 2:
            raise InvalidArgumentError(f"bins has shape {edges.shape}; it must be (bins + 1,)")
        return edges
    if extent is None:
        extent = _RANGES.get(measure) or _extremes(core, measure, hull)
    # NumPy checks both, and widens a range of no width.
    return np.histogram_bin_edges([], bins=operator.index(bins), range=extent)


def _extremes(core: Core, measure: str, hull: bool) -> tuple[float, float]:
    counts, least, largest = core.quality_histogram(measure, hull, [0.0])
    return (least, largest) if counts.sum() > 0 else (0.0, 1.0)

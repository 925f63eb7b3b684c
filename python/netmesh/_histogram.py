"""Histograms of the quality."""

from __future__ import annotations

import math
import operator
from typing import Any, Callable, Optional

import numpy as np

from ._arrays import doubles
from ._errors import ArgumentTypeError, InvalidArgumentError

#: The angles that measures in degrees may have.
_RANGES = {"dihedral_angle": (0.0, 180.0), "smallest_angle": (0.0, 90.0)}

#: A function of edges that counts below the first, in the bins and above the last, and answers with
#: the least and the largest value, too.
_Count = Callable[[list], tuple[np.ndarray, float, float]]


def histogram(
    count: _Count, measure: str, bins: Any, extent: Optional[tuple[float, float]]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the counts and the edges that `Mesh.quality_histogram` answers with."""
    edges = _edges(count, measure, 18 if bins is None else bins, extent)
    counts, _, _ = count(edges.tolist())
    return counts[1:-1], edges


def _edges(
    count: _Count, measure: str, bins: Any, extent: Optional[tuple[float, float]]
) -> np.ndarray:
    edges = doubles(0 if isinstance(bins, str) else bins, "bins")
    if edges.ndim > 0:
        if edges.ndim != 1 or len(edges) < 2:
            raise InvalidArgumentError(f"bins has shape {edges.shape}; it must be (bins + 1,)")
        _check_edges(edges.tolist())
        return edges
    if extent is None:
        extent = _RANGES.get(measure) or _extremes(count)
    else:
        extent = _checked_range(extent)
    # NumPy widens a range of no width.
    return np.histogram_bin_edges([], bins=_checked_count(bins), range=extent)


def _check_edges(edges: list) -> None:
    for at, edge in enumerate(edges):
        if math.isnan(edge):
            raise InvalidArgumentError(f"bins[{at}] is {edge}; it must be a number")
        if at > 0 and edge <= edges[at - 1]:
            rule = f"it must be above bins[{at - 1}], {edges[at - 1]}"
            raise InvalidArgumentError(f"bins[{at}] is {edge}; {rule}")


def _checked_count(bins: Any) -> int:
    try:
        count = operator.index(bins)
    except TypeError:
        kind = type(bins).__name__
        raise ArgumentTypeError(f"bins is of type {kind}; it must be a whole number or an array") from None
    if count < 1:
        raise InvalidArgumentError(f"bins is {count}; it must be at least 1")
    return count


def _checked_range(extent: Any) -> tuple[float, float]:
    ends = doubles(extent, "range")
    if ends.shape != (2,):
        raise InvalidArgumentError(f"range has shape {ends.shape}; it must be (2,)")
    low, high = ends.tolist()
    if not -math.inf < low <= high < math.inf:
        raise InvalidArgumentError(f"range is ({low}, {high}); it must ascend and be finite")
    return low, high


def _extremes(count: _Count) -> tuple[float, float]:
    counts, least, largest = count([0.0])
    return (least, largest) if counts.sum() > 0 else (0.0, 1.0)

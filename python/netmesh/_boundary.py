"""Segments and regions in the form that the library takes."""

from __future__ import annotations

import collections.abc
from typing import Any

import numpy as np

from ._arrays import doubles, whole_numbers
from ._errors import InvalidArgumentError

#: Axes of a seed's coordinates, by the dimension of the points.
_AXES = {2: "x, y", 3: "x, y, z"}


def segments_and_regions(segments: Any, markers: Any, regions: Any, holes: Any, dim: int) -> tuple:
    """Return ends and markers of segments, and regions as (seed, label, largest edge, hole or not).

    Seeds have three coordinates, of which the last is 0 in the plane.
    """
    ends = whole_numbers(() if segments is None else segments, "segments")
    if ends.size == 0:
        ends = ends.reshape(0, 2)
    if ends.ndim != 2 or ends.shape[1] != 2:
        raise InvalidArgumentError(f"segments has shape {ends.shape}; it must be (segments, 2)")
    numbers = None if markers is None else whole_numbers(markers, "markers")
    if numbers is not None and numbers.shape != ends.shape[:1]:
        rule = f"it must be that of the segments, {ends.shape[:1]}"
        raise InvalidArgumentError(f"markers has shape {numbers.shape}; {rule}")
    if dim not in _AXES and not (regions is None and holes is None):
        raise InvalidArgumentError(f"points has dimension {dim}; regions and holes are for 2D and 3D")
    given = [_region(f"regions[{at}]", region, dim) for at, region in enumerate(_regions(regions))]
    given.extend((_seed(hole), 0, 0.0, True) for hole in _holes(holes, dim))
    return ends, numbers, given


def _regions(regions: Any) -> Any:
    if regions is None:
        return ()
    if isinstance(regions, (str, bytes)) or not isinstance(regions, collections.abc.Iterable):
        raise InvalidArgumentError(f"regions is {regions!r}; it must be a sequence of regions")
    return regions


def _region(name: str, region: Any, dim: int) -> tuple:
    values = doubles(region, name)
    rule = f"it must be ({_AXES[dim]}, label) or ({_AXES[dim]}, label, max_edge)"
    if values.ndim != 1:
        raise InvalidArgumentError(f"{name} has shape {values.shape}; {rule}")
    if len(values) not in (dim + 1, dim + 2):
        raise InvalidArgumentError(f"{name} has {len(values)} values; {rule}")
    label = values[dim].item()
    if not -(2**31) <= label < 2**31 or label != int(label):
        rule = "it must be a whole number of 32 bits"
        raise InvalidArgumentError(f"{name} has the label {region[dim]}; {rule}")
    max_edge = float(values[dim + 1]) if len(values) == dim + 2 else 0.0
    return _seed(values[:dim]), int(label), max_edge, False


def _seed(coordinates: np.ndarray) -> list[float]:
    return [*coordinates.tolist(), 0.0][:3]


def _holes(holes: Any, dim: int) -> np.ndarray:
    seeds = doubles(() if holes is None else holes, "holes")
    if seeds.size == 0:
        return seeds.reshape(0, dim)
    if seeds.ndim != 2:
        raise InvalidArgumentError(f"holes has shape {seeds.shape}; it must be (holes, {dim})")
    if seeds.shape[1] != dim:
        raise InvalidArgumentError(f"holes[0] has {seeds.shape[1]} coordinates; it must have {dim}")
    return seeds

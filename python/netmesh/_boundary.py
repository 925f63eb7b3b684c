"""Segments and regions in the form that the library takes."""

from __future__ import annotations

import collections.abc
from typing import Any

import numpy as np

from ._arrays import doubles, whole_numbers
from ._errors import InvalidArgumentError

#: Rule that a refused region breaks.
_REGION = "it must be (x, y, label) or (x, y, label, max_edge)"


def boundary_of(segments: Any, markers: Any, regions: Any, holes: Any) -> tuple:
    """Return ends and markers of segments, and regions as (seed, label, largest edge, hole or not)."""
    ends = whole_numbers(() if segments is None else segments, "segments")
    if ends.size == 0:
        ends = ends.reshape(0, 2)
    if ends.ndim != 2 or ends.shape[1] != 2:
        raise InvalidArgumentError(f"segments has shape {ends.shape}; it must be (segments, 2)")
    numbers = None if markers is None else whole_numbers(markers, "markers")
    if numbers is not None and numbers.shape != ends.shape[:1]:
        rule = f"it must be that of the segments, {ends.shape[:1]}"
        raise InvalidArgumentError(f"markers has shape {numbers.shape}; {rule}")
    given = [_region(f"regions[{at}]", region) for at, region in enumerate(_regions(regions))]
    given.extend((hole.tolist(), 0, 0.0, True) for hole in _holes(holes))
    return ends, numbers, given


def _regions(regions: Any) -> Any:
    if regions is None:
        return ()
    if isinstance(regions, (str, bytes)) or not isinstance(regions, collections.abc.Iterable):
        raise InvalidArgumentError(f"regions is {regions!r}; it must be a sequence of regions")
    return regions


def _region(name: str, region: Any) -> tuple:
    values = doubles(region, name)
    if values.ndim != 1:
        raise InvalidArgumentError(f"{name} has shape {values.shape}; {_REGION}")
    if len(values) not in (3, 4):
        raise InvalidArgumentError(f"{name} has {len(values)} values; {_REGION}")
    x, y, label = values[:3].tolist()
    if not -(2**31) <= label < 2**31 or label != int(label):
        rule = "it must be a whole number of 32 bits"
        raise InvalidArgumentError(f"{name} has the label {region[2]}; {rule}")
    max_edge = float(values[3]) if len(values) == 4 else 0.0
    return [x, y], int(label), max_edge, False


def _holes(holes: Any) -> np.ndarray:
    seeds = doubles(() if holes is None else holes, "holes")
    if seeds.size == 0:
        return seeds.reshape(0, 2)
    if seeds.ndim != 2:
        raise InvalidArgumentError(f"holes has shape {seeds.shape}; it must be (holes, 2)")
    if seeds.shape[1] != 2:
        raise InvalidArgumentError(f"holes[0] has {seeds.shape[1]} coordinates; it must have 2")
    return seeds

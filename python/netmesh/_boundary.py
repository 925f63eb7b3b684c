"""Segments and regions, as the library takes them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._errors import InvalidArgumentError


def boundary_of(segments: Any, markers: Any, regions: Any, holes: Any) -> tuple:
    """Ends and markers of segments; seeds, labels, largest edges and holes of regions."""
    ends = _integers("segments", () if segments is None else segments)
    if ends.size == 0:
        ends = ends.reshape(0, 2)
    if ends.ndim != 2 or ends.shape[1] != 2:
        raise InvalidArgumentError(f"segments has shape {ends.shape}; it must be (segments, 2)")
    numbers = None if markers is None else _integers("markers", markers)
    if numbers is not None and numbers.shape != ends.shape[:1]:
        rule = f"it must be that of the segments, {ends.shape[:1]}"
        raise InvalidArgumentError(f"markers has shape {numbers.shape}; {rule}")
    given = [_region(at, region) for at, region in enumerate(regions or ())]
    for at, hole in enumerate(() if holes is None else holes):
        given.append((_seed(f"holes[{at}]", hole), 0, 0.0, True))
    return ends, numbers, given


def _region(at: int, region: Any) -> tuple:
    if len(region) not in (3, 4):
        rule = "it must be (x, y, label) or (x, y, label, max_edge)"
        raise InvalidArgumentError(f"regions[{at}] has {len(region)} values; {rule}")
    label = int(region[2])
    if label != region[2] or not -(2**31) <= label < 2**31:
        rule = "it must be a whole number of 32 bits"
        raise InvalidArgumentError(f"regions[{at}] has the label {region[2]}; {rule}")
    max_edge = float(region[3]) if len(region) == 4 else 0.0
    return _seed(f"regions[{at}]", region[:2]), label, max_edge, False


def _seed(name: str, point: Any) -> list:
    if len(point) != 2:
        raise InvalidArgumentError(f"{name} has {len(point)} coordinates; it must have 2")
    return [float(x) for x in point]


def _integers(name: str, values: Any) -> np.ndarray:
    array = np.asarray(values)
    if array.size and array.dtype.kind not in "iu":
        raise InvalidArgumentError(f"{name} has dtype {array.dtype}; it must be of whole numbers")
    return np.ascontiguousarray(array, dtype=np.int64)

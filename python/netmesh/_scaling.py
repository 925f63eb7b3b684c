"""Scaling by powers of two, so that products of very large or small coordinates are doubles.

It is exact, but for what is too small for doubles beside the largest coordinate.
"""

from __future__ import annotations

from typing import Any

import numpy as np


def scaled(points: np.ndarray) -> tuple[np.ndarray, int]:
    """Return points over a power of two, so that none reaches beyond 1, and its exponent."""
    exponent = int(np.frexp(np.abs(points).max(initial=0))[1])
    return np.ldexp(points, -exponent), exponent


def scaled_rows(rows: np.ndarray) -> np.ndarray:
    """Return vectors along the last axis, each over its own power of two, so that none reaches beyond 1."""
    exponents = np.frexp(np.abs(rows).max(axis=-1, keepdims=True))[1]
    return np.ldexp(rows, -exponents)


def unscaled(values: Any, exponent: int) -> Any:
    """Return values times a power of two; infinite where that is beyond doubles."""
    with np.errstate(over="ignore"):
        return np.ldexp(values, exponent)

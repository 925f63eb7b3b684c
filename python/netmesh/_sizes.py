"""The option `size` in the form that the library takes: a number, an array, or a function of one point."""

from __future__ import annotations

import inspect
from typing import Any, Callable

import numpy as np

from ._arrays import doubles
from ._errors import InvalidArgumentError


def size_of(size: Any, points: np.ndarray) -> Any:
    """Return a number, an array, or a function that answers at one point, an array of shape (dim,)."""
    if not callable(size):
        sizes = doubles(size, "size")
        return sizes if sizes.ndim else float(sizes)
    if _takes_coordinates(size, points.shape[1]):
        return lambda x: size(*x.tolist())
    if not len(points):
        return size
    try:
        answer = size(points[0].copy())
        if np.size(answer) == 1:
            return size
        raised = None
    except Exception as error:
        raised = error
    try:
        answer = size(points.copy())
    except Exception:
        if raised is not None:
            raise raised from None
        return size
    return _of_rows(size, points, answer)


def _takes_coordinates(size: Callable, dim: int) -> bool:
    """Tell whether a function takes coordinates apart, as Gmsh's do, by its parameters."""
    try:
        parameters = inspect.signature(size).parameters.values()
    except (TypeError, ValueError):
        return False
    places = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    needed = [one for one in parameters if one.kind in places and one.default is one.empty]
    return len(needed) == dim


def _of_rows(size: Callable, points: np.ndarray, answer: Any) -> Callable[[np.ndarray], Any]:
    """Return a function of one point of one that answers for rows of points, as it has for `points`."""
    answers = doubles(answer, "what size answers")
    if answers.shape != (len(points),):
        rule = "it must be one number for one point, or (n,) for points of shape (n, dim)"
        raise InvalidArgumentError(f"size answered shape {answers.shape} for {len(points)} points; {rule}")
    known = dict(zip(map(np.ndarray.tobytes, points), answers.tolist()))

    def at(x: np.ndarray) -> Any:
        found = known.get(x.tobytes())
        return size(x[None]) if found is None else found

    return at

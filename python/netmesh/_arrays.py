"""Arguments as arrays that the library reads."""

from typing import Any

import numpy as np

from ._errors import InvalidArgumentError
from ._netmesh import Core


def point_rows(points: Any, name: str = "points") -> np.ndarray:
    """Doubles of shape (n, dim), copied only where the library cannot read them as they stand."""
    array = _doubles(points, name)
    if array.ndim != 2:
        raise InvalidArgumentError(f"{name} has shape {array.shape}; it must be (n, dim)")
    step, width = array.strides
    if width != 8 or step % 8 or step < 8 * array.shape[1]:
        array = np.ascontiguousarray(array)
    return array


def query_points(points: Any, dim: int, name: str = "points") -> np.ndarray:
    """Contiguous doubles of shape (..., dim)."""
    array = _doubles(points, name)
    if array.ndim == 0 or array.shape[-1] != dim:
        raise InvalidArgumentError(f"{name} has shape {array.shape}; it must be (..., {dim})")
    return np.ascontiguousarray(array)


def vertex_columns(values: Any, core: Core, name: str = "values") -> np.ndarray:
    """As `value_columns`, of the vertices of a mesh."""
    shape = np.shape(values)
    if shape and shape[0] == len(core.input_vertices) != len(core.kinds):
        things = "vertex; extend_values makes them of values at the inputs"
    else:
        things = "vertex"
    return value_columns(values, len(core.kinds), things, name)


def value_columns(values: Any, count: int, things: str, name: str = "values") -> np.ndarray:
    """Values as contiguous doubles of shape (count, components); a complex one is two."""
    _refuse_masked(values, name)
    array = np.asarray(values)
    array = array.astype(np.complex128, copy=False) if array.dtype.kind == "c" else _doubles(array, name)
    if array.ndim == 0 or array.shape[0] != count:
        message = f"{name} has shape {array.shape}; it must be ({count}, ...), one for each {things}"
        raise InvalidArgumentError(message)
    columns = np.ascontiguousarray(array).reshape(count, -1)
    return columns.view(np.float64) if columns.dtype.kind == "c" else columns


def shaped_values(columns: np.ndarray, values: Any, places: tuple) -> np.ndarray:
    """Columns that were made of those of `value_columns(values)`, for places of that shape."""
    values = np.asarray(values)
    if values.dtype.kind == "c":
        columns = columns.view(np.complex128)
    return columns.reshape(places + values.shape[1:])


def _refuse_masked(values: Any, name: str) -> None:
    # What is under a mask is no number of the caller's.
    if np.ma.is_masked(values):
        raise InvalidArgumentError(f"{name} has masked elements; fill or drop them")


def _doubles(values: Any, name: str) -> np.ndarray:
    _refuse_masked(values, name)
    array = np.asarray(values)
    if array.dtype.kind not in "biuf":
        # Objects may be numbers all the same, but complex ones would lose a part.
        if array.dtype.kind != "O" or any(np.iscomplexobj(x) for x in array.flat):
            raise InvalidArgumentError(f"{name} is an array of {array.dtype}; it must be real numbers")
    try:
        return np.require(array, np.float64, "A")
    except (TypeError, ValueError) as error:
        raise InvalidArgumentError(f"{name} must be an array of real numbers: {error}") from None



"""The one way in for arguments that are arrays: all refusals of them are here.

Nothing else in the package makes an array of what a caller gave. Masked elements are refused,
ragged rows, and whole numbers that no double is.
"""

from __future__ import annotations

import collections.abc
import numbers
from typing import Any, Optional

import numpy as np

from ._errors import ArgumentTypeError, InvalidArgumentError, NonFiniteError
from ._netmesh import Core

#: Doubles have all whole numbers up to this one.
_LARGEST_EXACT = 2**53


def array(values: Any, name: str) -> np.ndarray:
    """Make an array of `values` as they stand; refuse masked elements and ragged rows."""
    # An element under a mask is no number of the caller's.
    if _holds_masked(values):
        raise InvalidArgumentError(f"{name} has masked elements; fill or drop them")
    try:
        return np.asarray(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidArgumentError(f"{name} is no array: {error}") from None


def doubles(values: Any, name: str) -> np.ndarray:
    """Make aligned doubles of real numbers of any shape; copy only what is none yet."""
    given = array(values, name)
    if given.dtype.kind not in "biuf":
        # Objects may be numbers all the same, but complex ones would lose a part, and none is NaN.
        if given.dtype.kind != "O" or any(x is None or np.iscomplexobj(x) for x in given.flat):
            raise InvalidArgumentError(f"{name} is an array of {given.dtype}; it must be real numbers")
    try:
        found = np.require(given, np.float64, "A")
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidArgumentError(f"{name} must be an array of real numbers: {error}") from None
    _refuse_rounded(values, given, found, name)
    return found


def number(value: Any, name: str) -> float:
    """Make a float of one real number."""
    if value is None or isinstance(value, (str, bytes)):
        kind = type(value).__name__
        raise ArgumentTypeError(f"{name} is of type {kind}; it must be a number")
    found = doubles(value, name)
    if found.ndim != 0:
        raise InvalidArgumentError(f"{name} has shape {found.shape}; it must be a number")
    return float(found)


def tolerance(value: Any, name: str, default: float) -> float:
    """Make a float of a tolerance, which is not negative; `default` for None."""
    found = default if value is None else number(value, name)
    if not 0 <= found < np.inf:
        raise InvalidArgumentError(f"{name} is {found}; it must be at least 0 and finite")
    return found


def whole_numbers(values: Any, name: str) -> np.ndarray:
    """Make contiguous int64 of whole numbers of any shape."""
    given = array(values, name)
    if given.size and given.dtype.kind not in "iu":
        raise InvalidArgumentError(f"{name} has dtype {given.dtype}; it must be of whole numbers")
    if given.dtype.kind == "u" and given.size and given.max() >= 2**63:
        place = np.argwhere(given >= 2**63)[0]
        raise InvalidArgumentError(f"{_element(name, place)} is {given[tuple(place)]}, beyond 64 bits")
    return np.ascontiguousarray(given, dtype=np.int64)


def point_rows(points: Any, name: str = "points") -> np.ndarray:
    """Make doubles of shape (n, dim); copy only what the library cannot read as it stands."""
    found = doubles(points, name)
    if found.ndim != 2:
        raise InvalidArgumentError(f"{name} has shape {found.shape}; it must be (n, dim)")
    step, width = found.strides
    if width != 8 or step % 8 or step < 8 * found.shape[1]:
        found = np.ascontiguousarray(found)
    return found


def require_finite(points: np.ndarray, name: str) -> None:
    """Refuse points, shape (n, dim), that are not all finite."""
    is_finite = np.isfinite(points)
    if not is_finite.all():
        at, axis = np.argwhere(~is_finite)[0]
        message = f"{name}[{at}] has a non-finite coordinate {axis}: {points[at, axis]}"
        raise NonFiniteError(f"{message}; every coordinate must be finite")


def contiguous(made: np.ndarray) -> np.ndarray:
    """Return an array of the package's own in the order that the library reads."""
    return np.ascontiguousarray(made)


def query_points(points: Any, dim: int, name: str = "points") -> np.ndarray:
    """Make contiguous doubles of shape (..., dim)."""
    found = doubles(points, name)
    if found.ndim == 0 or found.shape[-1] != dim:
        raise InvalidArgumentError(f"{name} has shape {found.shape}; it must be (..., {dim})")
    return np.ascontiguousarray(found)


def coordinates(args: tuple, name: str, dim: Optional[int] = None) -> np.ndarray:
    """Make doubles of shape (..., dim) of one array or, as SciPy takes them, of one for each axis."""
    if len(args) == 1 and isinstance(args[0], tuple):
        args = args[0]
    if len(args) == 1:
        points = doubles(args[0], name)
        if points.ndim == 1 and (dim is None or len(points) % dim == 0):
            points = points.reshape(-1, dim or 1)
    else:
        arrays = [doubles(axis, f"{name}[{at}]") for at, axis in enumerate(args)]
        try:
            points = np.stack(np.broadcast_arrays(*arrays), axis=-1)
        except ValueError:
            shapes = " and ".join(str(axis.shape) for axis in arrays)
            rule = "they must be arrays that broadcast, one for each axis"
            raise InvalidArgumentError(f"{name} has the shapes {shapes or 'of no arrays'}; {rule}") from None
    if dim is not None and (points.ndim == 0 or points.shape[-1] != dim):
        raise InvalidArgumentError(f"{name} has shape {points.shape}; it must be (..., {dim})")
    return points


def vertex_columns(values: Any, core: Core, name: str = "values") -> np.ndarray:
    """Make columns, as `value_columns` does, of values at the vertices of a mesh."""
    given = array(values, name)
    things = "vertex"
    if given.ndim and given.shape[0] == len(core.input_vertices) != len(core.kinds):
        things = "vertex; extend_values makes them of values at the inputs"
    return value_columns(values, len(core.kinds), things, name)


def value_columns(values: Any, count: int, things: str, name: str = "values") -> np.ndarray:
    """Make contiguous doubles of shape (count, components); a complex component becomes two."""
    given = array(values, name)
    found = given.astype(np.complex128, copy=False) if given.dtype.kind == "c" else doubles(values, name)
    _require_one_each(found, count, things, name)
    columns = np.ascontiguousarray(found).reshape(count, -1)
    return columns.view(np.float64) if columns.dtype.kind == "c" else columns


def shaped_values(columns: np.ndarray, values: Any, places: tuple) -> np.ndarray:
    """Give columns for `places` the type of `values`, and the shape of one of its elements."""
    given = np.asarray(values)
    if given.dtype.kind == "c":
        columns = columns.view(np.complex128)
    return columns.reshape(places + given.shape[1:])


def data(values: Any, count: int, things: str, name: str) -> np.ndarray:
    """Make an array of any type with an element or a row for each of `count` things."""
    given = array(values, name)
    _require_one_each(given, count, things, name)
    return given


def copied(thing: Any) -> Any:
    """Return dicts, tuples and lists of arrays with copies of these; other things as they are."""
    if isinstance(thing, np.ndarray):
        return thing.copy()
    if isinstance(thing, dict):
        return {key: copied(value) for key, value in thing.items()}
    return type(thing)(map(copied, thing)) if type(thing) in (tuple, list) else thing


def fixed(made: np.ndarray) -> np.ndarray:
    """Return the array read-only for good: not even its owner can be made writable."""
    base: Any = made
    while isinstance(base, np.ndarray):
        base.flags.writeable = False
        if base.base is None:
            # The owner of its memory would let itself be made writable again.
            owner: Any = made
            return np.asarray(memoryview(owner))
        base = base.base
    return made


def _require_one_each(given: np.ndarray, count: int, things: str, name: str) -> None:
    if given.ndim == 0 or given.shape[0] != count:
        message = f"{name} has shape {given.shape}; it must be ({count}, ...), one for each {things}"
        raise InvalidArgumentError(message)


def _holds_masked(values: Any) -> bool:
    if isinstance(values, np.ma.MaskedArray):
        return values.dtype.names is None and bool(np.ma.is_masked(values))
    if isinstance(values, (str, bytes)) or not isinstance(values, collections.abc.Sequence):
        return False
    kinds = (np.ma.MaskedArray, collections.abc.Sequence)
    if any(issubclass(kind, kinds) for kind in set(map(type, values))):
        return any(map(_holds_masked, values))
    return False


def _refuse_rounded(values: Any, given: np.ndarray, found: np.ndarray, name: str) -> None:
    """Refuse whole numbers that differ from the doubles made of them."""
    if given.dtype.kind in "iu":
        if given.dtype.itemsize < 8 or not given.size:
            return
        size = np.abs(given.reshape(-1)).astype(np.uint64)
        # A whole number is a double if no more than 53 bits are left without its last zeros.
        odd = size // np.maximum(size & (~size + np.uint64(1)), np.uint64(1))
        places = list(np.argwhere((odd > _LARGEST_EXACT).reshape(given.shape)))
    elif isinstance(values, np.ndarray) and given.dtype.kind in "bf":
        return
    else:
        # Among other numbers of a list NumPy has made doubles of whole ones already.
        large = np.argwhere(np.abs(found) >= _LARGEST_EXACT)
        if not len(large):
            return
        given = np.asarray(values, dtype=object)
        places = [place for place in large if _is_rounded(given[tuple(place)], found[tuple(place)])]
    if len(places):
        place = places[0]
        rule = "whole numbers beyond 2**53 must be doubles, which this one is not"
        raise InvalidArgumentError(f"{_element(name, place)} is {given[tuple(place)]}; {rule}")


def _is_rounded(number: Any, double: float) -> bool:
    return isinstance(number, numbers.Integral) and (np.isinf(double) or int(number) != int(double))


def _element(name: str, place: Any) -> str:
    return f"{name}[{', '.join(map(str, place))}]" if len(place) else name

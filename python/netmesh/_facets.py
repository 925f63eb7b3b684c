"""Facets in the form that the library takes."""

from __future__ import annotations

import collections.abc
import numbers
from typing import Any

import numpy as np

from ._arrays import doubles, whole_numbers
from ._errors import InvalidArgumentError
from ._surfaces import is_surface

#: Rule that refused facets break.
_RULE = "it must be an array of triangles, or a sequence of polygons or of lists of loops"


def points_and_facets(points: Any, facets: Any) -> tuple[Any, Any]:
    """Return points and facets, of which either may be a surface that has both."""
    if facets is None and is_surface(points):
        return points.vertices, points.faces
    if not is_surface(facets):
        return points, facets
    own, given = doubles(facets.vertices, "facets.vertices"), doubles(points, "points")
    if given.ndim != 2 or own.ndim != 2 or not np.array_equal(given[: len(own)], own):
        rule = "they must begin with the vertices of facets, whose faces have their numbers"
        raise InvalidArgumentError(f"points has shape {given.shape}; {rule}")
    return points, facets.faces


def facets_of(facets: Any, markers: Any) -> tuple | None:
    """Return starts of loops (None for triangles) and of their inputs, the inputs, and markers."""
    if facets is None:
        if markers is not None:
            raise InvalidArgumentError("facet_markers is given; it must come with facets")
        return None
    given = _as_array(facets)
    if given is not None and given.shape[1:] == (3,):
        return (None, None, given.reshape(-1), _markers_of(markers, len(given)))
    loops = list(_loops(facets if given is None else given))
    lists = [loop for of_facet in loops for loop in of_facet]
    starts = [_starts(map(len, loops)), _starts(map(len, lists))]
    inputs = np.concatenate([np.zeros(0, np.int64), *lists])
    return (*starts, inputs, _markers_of(markers, len(loops)))


def _as_array(facets: Any) -> np.ndarray | None:
    """Return an array of facets with as many inputs each; None if they are of several kinds."""
    if isinstance(facets, np.ndarray) and facets.dtype != object:
        found = whole_numbers(facets, "facets")
        if found.ndim != 2:
            raise InvalidArgumentError(f"facets has shape {found.shape}; {_RULE}")
        return found
    if isinstance(facets, (str, bytes)) or not isinstance(facets, collections.abc.Iterable):
        raise InvalidArgumentError(f"facets is {facets!r}; {_RULE}")
    if not isinstance(facets, collections.abc.Sequence) or not len(facets):
        return None
    is_triangle = [_is_list(facet) and len(facet) == 3 and not any(map(_is_list, facet)) for facet in facets]
    return whole_numbers(facets, "facets") if all(is_triangle) else None


def _loops(facets: Any) -> Any:
    """Yield the loops of each facet, each an array of inputs."""
    for at, facet in enumerate(facets):
        name = f"facets[{at}]"
        if not _is_list(facet):
            raise InvalidArgumentError(f"{name} is {facet!r}; it must be a polygon or a list of loops")
        if any(map(_is_list, facet)):
            yield [_loop(loop, f"{name}[{k}]") for k, loop in enumerate(facet)]
        else:
            yield [_loop(facet, name)]


def _loop(loop: Any, name: str) -> np.ndarray:
    if not _is_list(loop):
        raise InvalidArgumentError(f"{name} is {loop!r}; it must be a list of inputs")
    found = whole_numbers(loop, name)
    if found.ndim != 1 or not found.size:
        raise InvalidArgumentError(f"{name} has shape {found.shape}; it must be (inputs,), one at least")
    return found


def _is_list(thing: Any) -> bool:
    if isinstance(thing, np.ndarray):
        return thing.ndim > 0
    is_one = isinstance(thing, (str, bytes, numbers.Number))
    return not is_one and isinstance(thing, collections.abc.Sequence)


def _starts(lengths: Any) -> np.ndarray:
    return np.cumsum(np.fromiter((0, *lengths), np.int64))


def _markers_of(markers: Any, count: int) -> np.ndarray | None:
    if markers is None:
        return None
    found = whole_numbers(markers, "facet_markers")
    if found.shape != (count,):
        rule = f"it must be that of the facets, ({count},)"
        raise InvalidArgumentError(f"facet_markers has shape {found.shape}; {rule}")
    return found

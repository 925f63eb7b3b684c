"""Domains of the plane: GeoJSON and all that speaks it, rings, dicts of PyPI's triangle."""

from __future__ import annotations

import collections.abc
import json
import re
import warnings
from typing import Any, Optional

import numpy as np

from ._arrays import array, doubles, whole_numbers
from ._errors import Error, InvalidArgumentError
from ._reading import content_of_geojson

#: Position in the text that the package makes of an object, of which its user knows nothing.
_PLACE = re.compile(r"^line \d+, byte \d+: ")

#: Keys of a dict of PyPI's triangle that say what is to be meshed.
_KEYS = ("vertices", "segments", "segment_markers", "holes", "regions")


def require_no_name(markers: Optional[str], what: str) -> None:
    """Refuse the name of markers for things that have no data under names."""
    if markers is not None:
        raise InvalidArgumentError(f"markers is {markers!r}; it must be left out with {what}")


def is_geojson(x: Any) -> bool:
    """Tell whether a thing is an object of GeoJSON."""
    return isinstance(x, collections.abc.Mapping) and isinstance(x.get("type"), str)


def of_features(x: Any, markers: Optional[str]) -> dict[str, Any]:
    """Return the fields of what has ``__geo_interface__``, or of GeoJSON."""
    whole = getattr(x, "__geo_interface__", x)
    numbers = None if markers is None else _numbers(whole, markers)
    try:
        fields = content_of_geojson(json.dumps(_bare(whole), default=_plain))
    except Error as error:
        message = _PLACE.sub("", str(error)).replace("the file holds", "it holds")
        raise type(error)(f"x: {message}") from None
    except (TypeError, ValueError) as error:
        raise InvalidArgumentError(f"x is no GeoJSON: {error}") from None
    if numbers is not None and "markers" in fields:
        # The reader has numbered the features from 1 on.
        fields["markers"] = numbers[fields["markers"] - 1]
    return fields


def _bare(whole: Any) -> Any:
    """Return GeoJSON without properties: tables have what no JSON can say."""
    if not is_geojson(whole):
        return whole
    if whole["type"] == "FeatureCollection" and "features" in whole:
        return {"type": "FeatureCollection", "features": [_bare(one) for one in whole["features"]]}
    if whole["type"] == "Feature" and "geometry" in whole:
        return {"type": "Feature", "geometry": _bare(whole["geometry"])}
    if whole["type"] == "LinearRing" and "coordinates" in whole:
        # Rings of shapely are no geometries of GeoJSON.
        return {"type": "Polygon", "coordinates": [whole["coordinates"]]}
    return whole


def collection(geometries: Any) -> dict[str, Any]:
    """Return GeoJSON of several geometries, a feature each."""
    return {
        "type": "FeatureCollection",
        "features": [{"type": "Feature", "geometry": one.__geo_interface__} for one in geometries],
    }


def _plain(thing: Any) -> Any:
    """Return what JSON can say of arrays and numbers of NumPy, and of geometries."""
    if isinstance(thing, (np.ndarray, np.generic)):
        return thing.tolist()
    if hasattr(thing, "__geo_interface__"):
        return thing.__geo_interface__
    raise TypeError(f"objects of type {type(thing).__name__}")


def _numbers(whole: Any, name: str) -> np.ndarray:
    features = whole.get("features", [whole]) if is_geojson(whole) else []
    values = []
    for at, feature in enumerate(features):
        properties = feature.get("properties") or {}
        if name not in properties:
            rule = "features must have it among their properties"
            raise InvalidArgumentError(f"markers is {name!r}, which feature {at} has not; {rule}")
        values.append(properties[name])
    return whole_numbers(values, f"the property {name!r}")


def of_rings(x: Any) -> dict[str, Any]:
    """Return the fields of a ring, or of several."""
    rings = [doubles(x, "x")] if _is_ring(x) else [doubles(ring, f"x[{at}]") for at, ring in enumerate(x)]
    if not rings:
        raise InvalidArgumentError("x is empty; it must be a ring of points, or a sequence of rings")
    names = ["x"] if _is_ring(x) else [f"x[{at}]" for at in range(len(rings))]
    rings = [_opened(ring, name) for ring, name in zip(rings, names)]
    first, segments = 0, []
    for ring in rings:
        ends = np.arange(len(ring))
        ends = np.column_stack([ends, np.roll(ends, -1)])
        # Equal points in a row are one, and have no segment between them.
        segments.append(first + ends[(ring[ends[:, 0]] != ring[ends[:, 1]]).any(axis=1)])
        first += len(ring)
    numbers = np.repeat(np.arange(1, 1 + len(rings)), [len(own) for own in segments])
    ends = np.concatenate(segments)
    sides = np.ones(len(ends), bool)
    return {"points": np.concatenate(rings), "segments": ends, "markers": numbers, "sides": sides}


def _is_ring(x: Any) -> bool:
    """Tell whether the elements are points, rather than rings."""
    if isinstance(x, np.ndarray) and x.dtype != object:
        return x.ndim < 3
    return len(x) > 0 and array(x[0], "x[0]").ndim < 2


def _opened(ring: np.ndarray, name: str) -> np.ndarray:
    """Return the points of a ring, without the last if it is the first again."""
    if ring.ndim != 2 or ring.shape[1] != 2:
        raise InvalidArgumentError(f"{name} has shape {ring.shape}; a ring must be (n, 2)")
    if len(ring) > 1 and (ring[0] == ring[-1]).all():
        ring = ring[:-1]
    if len(ring) < 3:
        raise InvalidArgumentError(f"{name} has {len(ring)} points; a ring must have 3 or more")
    return ring


def of_dict(x: Any) -> dict[str, Any]:
    """Return the fields of a dict of PyPI's triangle."""
    if "vertices" not in x:
        raise InvalidArgumentError("x has no 'vertices'; a dict must have them, or be GeoJSON with a 'type'")
    others = [repr(key) for key in x if key not in _KEYS]
    if others:
        warnings.warn(f"x has {', '.join(others)}, which a domain has no place for", stacklevel=4)
    points = doubles(x["vertices"], "x['vertices']")
    if points.ndim != 2 or points.shape[1] != 2:
        raise InvalidArgumentError(f"x['vertices'] has shape {points.shape}; it must be (n, 2)")
    fields: dict[str, Any] = {"points": points}
    x = {key: value for key, value in x.items() if value is not None}
    if "segment_markers" in x and not len(x.get("segments", ())):
        raise InvalidArgumentError("x has 'segment_markers'; it must have the 'segments' that they are of")
    if len(x.get("segments", ())):
        fields["segments"] = whole_numbers(x["segments"], "x['segments']")
        if "segment_markers" in x:
            # PyPI's triangle has a column of them.
            fields["markers"] = whole_numbers(x["segment_markers"], "x['segment_markers']").reshape(-1)
    if len(x.get("holes", ())):
        fields["holes"] = doubles(x["holes"], "x['holes']")
    if len(x.get("regions", ())):
        fields["regions"] = [_region(one, at) for at, one in enumerate(x["regions"])]
    return fields


def _region(region: Any, at: int) -> tuple:
    """Return a region of (x, y, label, largest area); the area is not bounded by 0 or less."""
    values = doubles(region, f"x['regions'][{at}]")
    if values.shape != (4,):
        rule = "it must be (x, y, attribute, largest area)"
        raise InvalidArgumentError(f"x['regions'][{at}] has shape {values.shape}; {rule}")
    x, y, label, area = values.tolist()
    # No triangle with edges of that length is larger than the equilateral one.
    return (x, y, label, float(np.sqrt(area * 4 / np.sqrt(3)))) if area > 0 else (x, y, label)

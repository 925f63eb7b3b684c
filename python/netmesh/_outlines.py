"""Domains of the plane: GeoJSON and all that speaks it, rings, dicts of PyPI's triangle."""

from __future__ import annotations

import collections.abc
import json
import os
import pathlib
import re
import warnings
from typing import Any, Optional

import numpy as np

from ._arrays import array, doubles, whole_numbers
from ._errors import Error, FileError, FormatError, InvalidArgumentError
from ._reading import content_of_file, content_of_geojson

#: Position in the text that the package makes of an object, of which its user knows nothing.
_PLACE = re.compile(r"^line \d+, byte \d+: ")

#: Ends of names of tables that GeoPandas reads, and the library does not.
_TABLES = (".gpkg", ".shp", ".fgb")

#: Keys of a dict of PyPI's triangle that say what is to be meshed.
_KEYS = ("vertices", "segments", "segment_markers", "holes", "regions")


def require_no_name(markers: Optional[str], what: str) -> None:
    """Refuse the name of markers for things that have no data under names."""
    if markers is not None:
        raise InvalidArgumentError(f"markers is {markers!r}; it must be left out with {what}")


def of_file(path: Any, markers: Optional[str]) -> dict[str, Any]:
    """Return the fields of a file, with a property of its features as markers if it has such."""
    end = os.path.splitext(os.fspath(path))[1].lower()
    if end in _TABLES:
        return of_features(_table(path), markers)
    if markers is not None and end != ".geojson":
        raise InvalidArgumentError(
            f"markers is {markers!r}; {os.fspath(path)} has no properties by name, as files of GeoJSON have"
        )
    fields = content_of_file(path)
    if markers is not None:
        _renumber(fields, json.loads(pathlib.Path(path).read_bytes()), markers)
    return fields


def _table(path: Any) -> Any:
    """Return the first layer of a file, as GeoPandas reads it."""
    try:
        import geopandas
    except ImportError:
        rule = "files of this kind are read by GeoPandas, which is not installed"
        raise FormatError(f"{os.fspath(path)}: {rule}") from None
    try:
        return geopandas.read_file(path)
    except Exception as error:
        kind = FormatError if os.path.exists(path) else FileError
        raise kind(f"{os.fspath(path)}: GeoPandas cannot read it: {error}") from error


def is_geojson(x: Any) -> bool:
    """Tell whether a thing is an object of GeoJSON."""
    return isinstance(x, collections.abc.Mapping) and isinstance(x.get("type"), str)


def of_features(x: Any, markers: Optional[str]) -> dict[str, Any]:
    """Return the fields of what has ``__geo_interface__``, or of GeoJSON."""
    whole = getattr(x, "__geo_interface__", x)
    try:
        fields = content_of_geojson(json.dumps(_bare(whole), default=_plain))
    except Error as error:
        message = _PLACE.sub("", str(error)).replace("the file holds", "it holds")
        raise type(error)(f"x: {message}") from None
    except (TypeError, ValueError) as error:
        raise InvalidArgumentError(f"x is no GeoJSON: {error}") from None
    if markers is not None:
        _renumber(fields, whole, markers)
    return fields


def _renumber(fields: dict[str, Any], whole: Any, name: str) -> None:
    """Replace the numbers of features, which the reader counts from 1 on, by a property of theirs."""
    numbers = _numbers(whole, name)
    if "markers" in fields:
        fields["markers"] = numbers[fields["markers"] - 1]


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

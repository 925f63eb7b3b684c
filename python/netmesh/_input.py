"""Arguments of `mesh` as one domain, and that in the form that the library takes."""

from __future__ import annotations

import os
from typing import Any

from ._arrays import array
from ._boundary import segments_and_regions
from ._domain import Domain
from ._errors import InvalidArgumentError
from ._facets import facets_of, points_and_facets


def domain_of(points: Any, segments: Any = None, facets: Any = None, **others: Any) -> Domain:
    """Return the domain that arguments of `mesh` are, of which the points may be one."""
    if not isinstance(points, Domain):
        _refuse_what_domain_takes(points)
        points, facets = points_and_facets(points, facets)
        return Domain(points, segments, facets=facets, **others)
    own = {name: others.pop(name, None) for name in ("markers", "facet_markers")}
    for name, value in {"segments": segments, "facets": facets, **own}.items():
        if value is not None:
            rule = "points is a Domain, which has its own; dataclasses.replace changes them"
            raise InvalidArgumentError(f"{name} is given; {rule}")
    return points._joined(**others)


def _refuse_what_domain_takes(points: Any) -> None:
    """Refuse what is no array of points, but something that `domain` knows."""
    if isinstance(points, (str, os.PathLike, dict)) or hasattr(points, "__geo_interface__"):
        rule = "it must be an array of points; netmesh.domain makes a domain of other things"
        raise InvalidArgumentError(f"points is of type {type(points).__name__}; {rule}")


def boundary_of(domain: Domain, dim: int) -> tuple:
    """Return segments, regions, facets and sides of polygons in the form that the library takes."""
    others = segments_and_regions(domain.segments, domain.markers, domain.regions, domain.holes, dim)
    facets = facets_of(domain.facets, domain.facet_markers)
    return (*others, facets, _sides(domain, len(others[0])))


def has_boundary(domain: Domain) -> bool:
    """Tell whether a domain has more than points."""
    names = ("segments", "markers", "facets", "facet_markers", "regions", "holes")
    return any(getattr(domain, name) is not None for name in names)


def _sides(domain: Domain, count: int) -> Any:
    if domain.sides is None:
        return None
    found = array(domain.sides, "sides")
    if found.shape != (count,) or found.dtype != bool:
        rule = f"it must be of bool, with the shape of the segments, ({count},)"
        raise InvalidArgumentError(f"sides is of {found.dtype} with shape {found.shape}; {rule}")
    return found

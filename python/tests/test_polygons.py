"""Polygons of alpha shapes, beside the union of their triangles by shapely."""

import os
import pathlib

import netmesh
import numpy as np
import pytest
from netmesh._polygons import rings_of

shapely = pytest.importorskip("shapely")

DATA = pathlib.Path(
    os.environ.get("NETMESH_DATA", pathlib.Path(__file__).parents[3] / "shared" / "data")
)


def hold_union(polygons, triangles):
    """Holds that polygons are valid, apart from each other, and the union of triangles."""
    union = shapely.union_all([shapely.Polygon(corners) for corners in triangles])
    assert all(polygon.is_valid and polygon.exterior.is_ccw for polygon in polygons)
    assert not any(hole.is_ccw for polygon in polygons for hole in polygon.interiors)
    together = shapely.MultiPolygon(polygons)
    assert together.is_valid and np.isclose(together.area, union.area)
    assert together.symmetric_difference(union).area <= 1e-9 * max(union.area, 1)
    return union


def test_polygons_of_shapes_are_the_union_of_their_triangles(random):
    points = random.random((150, 2))
    m = netmesh.mesh(points, algorithm="delaunay")
    alpha = m.filtration()
    pieces, holes = set(), 0
    for value in np.quantile(alpha.values(2), [0.05, 0.2, 0.4, 0.5, 0.6, 0.8, 1], method="nearest"):
        shape = alpha.shape(value)
        polygons = shape.polygons()
        hold_union(polygons, m.points[m.simplices[shape.simplices]])
        assert np.isclose(sum(polygon.area for polygon in polygons), shape.volume)
        pieces.add(len(polygons))
        holes += sum(len(polygon.interiors) for polygon in polygons)
    assert len(pieces) > 3 and holes > 3
    assert alpha.shape(0).polygons() == []


def test_rings_that_touch_in_points(random):
    # On a lattice with triangles missing at random, pieces and holes touch each other in many points.
    lattice = np.stack(np.meshgrid(np.arange(9.0), np.arange(9.0)), axis=-1).reshape(-1, 2)
    m = netmesh.mesh(lattice, algorithm="delaunay")
    touching = 0
    for share in (0.3, 0.5, 0.6, 0.7, 0.8, 0.9) * 4:
        chosen = np.flatnonzero(random.random(len(m.simplices)) < share)
        row_of = np.full(len(m.simplices) + 1, -1)
        row_of[chosen] = np.arange(len(chosen))
        rings = rings_of(m.points, m.simplices[chosen], row_of[m.neighbors[chosen]])
        places = [(m.points[outer], [m.points[hole] for hole in holes]) for outer, holes in rings]
        polygons = [shapely.Polygon(outer, holes) for outer, holes in places]
        hold_union(polygons, m.points[m.simplices[chosen]])
        touching += sum(len(set(outer) & set(hole)) for outer, holes in rings for hole in holes)
        for outer, holes in rings:
            assert all(len(ring) == len(set(ring)) for ring in [outer, *holes])
    assert touching > 10


def test_a_ring_that_touches_itself_has_a_hole():
    # Eight squares round one that is missing, but for the corner where two of them touch.
    square = np.array([[0, 0], [3, 0], [3, 3], [0, 3], [1, 0], [1, 1], [2, 1], [2, 2], [1, 2], [0, 1.0]])
    m = netmesh.mesh(square, [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 9]], algorithm="netmesh")
    centers = m.points[m.simplices].mean(axis=1)
    in_hole = (np.abs(centers - 1.5) < 0.5).all(axis=1)
    in_corner = (centers < 1).all(axis=1)
    chosen = np.flatnonzero(~in_hole & ~in_corner)
    row_of = np.full(len(m.simplices) + 1, -1)
    row_of[chosen] = np.arange(len(chosen))
    [(outer, [hole])] = rings_of(m.points, m.simplices[chosen], row_of[m.neighbors[chosen]])
    [touched] = set(outer) & set(hole)
    assert m.points[touched].tolist() == [1, 1]
    hold_union([shapely.Polygon(m.points[outer], [m.points[hole]])], m.points[m.simplices[chosen]])


def test_polygons_of_airports():
    path = DATA / "airports_us_lonlat.xy"
    if not path.exists():
        pytest.skip(f"{path} is not there")
    # Points may be given twice; the boundary names the first of equal ones.
    m = netmesh.mesh(np.loadtxt(path, usecols=(0, 1)), algorithm="delaunay")
    shape = m.filtration().shape(1.0)
    polygons = shape.polygons()
    assert np.isclose(sum(polygon.area for polygon in polygons), shape.volume)
    length = sum(polygon.length for polygon in polygons)
    ends = shape.points[shape.boundary]
    assert np.isclose(length, np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())
    assert all(polygon.is_valid for polygon in polygons) and len(polygons) > 1


def test_polygons_are_of_the_plane(random):
    shape = netmesh.mesh(random.random((10, 3)), algorithm="delaunay").filtration().shape()
    with pytest.raises(netmesh.InvalidArgumentError, match="the mesh has dim = 3; it must be 2"):
        shape.polygons()

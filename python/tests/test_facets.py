"""Facets in space, pairs of them that meet in more than they may, and edges that are not between two."""

import pickle
from types import SimpleNamespace

import netmesh
import numpy as np
import pytest

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
# Two of a side, one after the other.
TRIANGLES = np.array([[[a, b, c], [a, c, d]] for a, b, c, d in SIDES]).reshape(-1, 3)


def tile(mesh, count=6):
    """Asserts that triangles are of the simplices beside them, and returns the areas of facets."""
    triangles, parents, simplices = mesh.facet_triangles, mesh.facet_parents, mesh.facet_simplices
    assert triangles.shape == (len(parents), 3) and simplices.shape == (len(parents), 2)
    assert triangles.dtype == parents.dtype == simplices.dtype == np.int32
    a, b, c = mesh.points[triangles].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    for side in range(2):
        there = simplices[:, side] >= 0
        own = mesh.simplices[simplices[there, side]]
        is_apex = (own[:, :, None] != triangles[there][:, None, :]).all(axis=2)
        assert (is_apex.sum(axis=1) == 1).all()
        towards = ((mesh.points[own[is_apex]] - a[there]) * normals[there]).sum(axis=1)
        assert (towards > 0 if side == 0 else towards < 0).all()
    return np.bincount(parents, np.linalg.norm(normals, axis=1) / 2, count)


def test_facets_become_triangles():
    mesh = netmesh.mesh(CUBE, facets=SIDES, regions=[(0.5, 0.5, 0.5, -4)])
    assert np.allclose(tile(mesh), 1) and (mesh.facet_simplices[:, 0] == -1).all()
    assert (mesh.simplex_regions == -4).all() and mesh.volumes.sum() == pytest.approx(1, abs=1e-12)
    assert (mesh.segment_parents == -1).all() and len(mesh.segments) >= 12
    assert mesh.validate().violations == 0 and mesh.quality().flat == 0
    assert mesh.parameters["extent"] == "boundary"


def test_facets_may_be_given_in_several_ways():
    first = netmesh.mesh(CUBE, facets=SIDES)
    surface = SimpleNamespace(vertices=CUBE, faces=np.array(SIDES))
    loops = [[side] for side in SIDES]
    others = [
        netmesh.mesh(CUBE, facets=np.array(SIDES)),
        netmesh.mesh(CUBE, facets=loops),
        netmesh.mesh(CUBE, facets=tuple(map(tuple, SIDES))),
        netmesh.mesh(surface),
        netmesh.mesh(CUBE, facets=surface),
    ]
    for other in others:
        assert (other.points == first.points).all() and (other.simplices == first.simplices).all()
    again = pickle.loads(pickle.dumps(netmesh.mesh(surface)))
    assert (again.facet_triangles == first.facet_triangles).all()


def test_triangles_in_one_plane_are_one_facet_unless_their_markers_differ():
    mesh = netmesh.mesh(CUBE, facets=TRIANGLES)
    assert np.allclose(tile(mesh, 12), [1, 0] * 6)
    marked = netmesh.mesh(CUBE, facets=TRIANGLES.tolist(), facet_markers=[3, 4] + [5] * 10)
    assert np.allclose(tile(marked, 12), [0.5, 0.5] + [1, 0] * 5)
    surface = netmesh.mesh(SimpleNamespace(vertices=CUBE, faces=TRIANGLES))
    assert (surface.simplices == mesh.simplices).all()


def test_loops_are_holes_segments_and_vertices():
    inner = [[0.25, 0.25, 0], [0.75, 0.25, 0], [0.75, 0.75, 0], [0.25, 0.75, 0], [0.1, 0.1, 0], [0.1, 0.9, 0]]
    points = np.vstack([CUBE, inner])
    bottom = [[0, 2, 6, 4], [8, 9, 10, 11], [12, 13]]
    floor = [SIDES.index([0, 2, 6, 4])]
    sides = [bottom if at in floor else [side] for at, side in enumerate(SIDES)]
    mesh = netmesh.mesh(points, facets=sides, extent="all")
    areas = tile(mesh)
    assert np.allclose(np.delete(areas, floor), 1) and np.allclose(areas[floor], 0.75)


def test_holes_are_between_facets():
    points = np.vstack([CUBE, CUBE / 2 + 0.25])
    facets = SIDES + [[corner + 8 for corner in side] for side in SIDES]
    mesh = netmesh.mesh(points, facets=facets, holes=[[0.5, 0.5, 0.5]])
    assert mesh.volumes.sum() == pytest.approx(7 / 8, abs=1e-12)
    parity = netmesh.mesh(points, facets=facets, interior="parity", extent="boundary")
    assert parity.volumes.sum() == pytest.approx(7 / 8, abs=1e-12)


def test_without_facets_there_is_nothing():
    mesh = netmesh.mesh(CUBE)
    assert mesh.facet_triangles.shape == (0, 3) and mesh.facet_simplices.shape == (0, 2)
    assert mesh.facet_parents.shape == (0,)


CROSSED = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 9, 1], [3, 0.5, 1], [3, 0.5, -1]]


def test_intersections_are_found():
    found = netmesh.intersections(CROSSED, [[0, 1, 2], [3, 4, 5]], segments=[[6, 7], [0, 1]])
    named = [(one.kind, one.first, one.second) for one in found]
    assert named == [
        ("cross", ("facet", 0), ("facet", 1)),
        ("cross", ("facet", 0), ("segment", 0)),
    ]
    assert found[1].point.tolist() == [3, 0.5, 0] and found[1].point.dtype == np.float64
    assert netmesh.intersections(CUBE, SIDES) == netmesh.intersections(CUBE, TRIANGLES) == []
    surface = SimpleNamespace(vertices=np.array(CROSSED), faces=[[0, 1, 2], [3, 4, 5]])
    assert len(netmesh.intersections(surface)) == 1
    assert netmesh.intersections(CUBE) == []


def test_holes_are_closed():
    open_cube = SIDES[:5]
    closing = netmesh.close_holes(CUBE, open_cube, 4)
    assert closing.shape == (2, 3) and closing.dtype == np.int32
    assert {frozenset(triangle) for triangle in closing.tolist()} in (
        {frozenset(pair) for pair in pairs}
        for a, b, c, d in [SIDES[5]]
        for pairs in (((a, b, c), (a, c, d)), ((b, c, d), (b, d, a)))
    )
    mesh = netmesh.mesh(CUBE, facets=[*open_cube, *closing.tolist()])
    assert mesh.volumes.sum() == pytest.approx(1, abs=1e-12)
    assert netmesh.close_holes(CUBE, open_cube, 3).shape == (0, 3)
    assert len(netmesh.close_holes(SimpleNamespace(vertices=CUBE, faces=TRIANGLES[:10]))) == 2
    assert len(netmesh.close_holes(CUBE)) == 0


def test_polygons_become_triangles():
    bent = np.array(CUBE, float)
    bent[6] += [0.1, 0.2, 0.3]
    with pytest.raises(netmesh.InvalidArgumentError, match="is not plane"):
        netmesh.mesh(bent, facets=SIDES)
    triangles, parents = netmesh.triangulate_facets(bent, SIDES)
    assert triangles.shape == (12, 3) and triangles.dtype == parents.dtype == np.int32
    assert parents.tolist() == [side for side in range(6) for _ in range(2)]
    assert all(set(triangle) <= set(SIDES[parent]) for triangle, parent in zip(triangles, parents))
    assert netmesh.mesh(bent, facets=triangles).volumes.sum() > 1
    same, own = netmesh.triangulate_facets(SimpleNamespace(vertices=CUBE, faces=TRIANGLES))
    assert same.tolist() == [list(triangle) for triangle in TRIANGLES] and own.tolist() == list(range(12))
    assert [len(found) for found in netmesh.triangulate_facets(CUBE)] == [0, 0]
    bent[7] += [0, 0, 3]
    assert len(netmesh.triangulate_facets(bent, SIDES)[0]) == 12
    # A polygon without an area is a triangle without one, for the run to refuse or leave out.
    points = np.array([*bent, (bent[0] + bent[1]) / 2])
    triangles, parents = netmesh.triangulate_facets(points, [*SIDES, [0, 8, 1]])
    assert (triangles[-1].tolist(), parents[-1]) == ([0, 8, 1], 6)
    with pytest.raises(netmesh.InvalidArgumentError, match=r"facets\[12\] has no area"):
        netmesh.mesh(points, facets=triangles)
    assert netmesh.mesh(points, facets=triangles, crossings="split").volumes.sum() > 1
    with pytest.raises(netmesh.InvalidArgumentError, match="dimension 2; polygons of facets are for 3D"):
        netmesh.triangulate_facets([[0, 0], [1, 0], [0, 1]])


def test_sizes_from_curvature_are_chords():
    angles = 2 * np.pi * np.arange(24) / 24
    rings = [np.column_stack([np.cos(angles), np.sin(angles), np.full(24, z)]) for z in (0.0, 2.0)]
    around = [[i, (i + 1) % 24, 24 + (i + 1) % 24, 24 + i] for i in range(24)]
    facets = [*around, list(range(23, -1, -1)), list(range(24, 48))]
    mesh = netmesh.mesh(np.concatenate(rings), facets=facets, size_from_curvature=0.01)
    assert mesh.sizes[:48] == pytest.approx(2 * np.sqrt(1 - 0.99**2), abs=1e-12)
    assert mesh.options["size_from_curvature"] == 0.01
    with pytest.raises(netmesh.InvalidArgumentError, match="size_from_curvature is 0.01; it needs facets"):
        netmesh.mesh(np.concatenate(rings), size_from_curvature=0.01)


def test_points_are_merged():
    doubled = np.array([*CUBE, *CUBE], float)
    doubled[8:] += 1e-14
    merged = netmesh.merge_points(doubled)
    assert merged.dtype == np.float64 and (merged == np.array([*CUBE, *CUBE])).all()
    assert (netmesh.merge_points(doubled, 0) == doubled).all()
    assert (netmesh.merge_points(doubled, 1e-15) == doubled).all()
    apart = np.array(TRIANGLES) + 8 * (np.arange(len(TRIANGLES)) % 2)[:, None]
    assert netmesh.odd_edges(doubled, apart)
    assert not netmesh.odd_edges(merged, apart)
    assert netmesh.mesh(merged, facets=apart).volumes.sum() == pytest.approx(1, abs=1e-12)
    for ratio in (-1, 0.1, float("nan")):
        with pytest.raises(netmesh.InvalidArgumentError, match="ratio is .*; it must be from 0 to 0.001"):
            netmesh.merge_points(doubled, ratio)
    with pytest.raises(netmesh.InvalidArgumentError, match="dim is 4; points are merged in 2D and 3D"):
        netmesh.merge_points(np.zeros((5, 4)))


@pytest.mark.parametrize("edges", [2, 1001, 4.0, "many", None])
def test_holes_of_no_size_are_refused(edges):
    with pytest.raises(netmesh.InvalidArgumentError) as error:
        netmesh.close_holes(CUBE, SIDES, edges)
    assert str(error.value) == f"max_edges is {edges!r}; it must be a whole number from 3 to 1000"


def test_odd_edges_are_found():
    open_box = [TRIANGLES[0][::-1], *TRIANGLES[1:-1]]
    found = netmesh.odd_edges(CUBE, open_box)
    missing, turned = TRIANGLES[-1], TRIANGLES[0]
    edges_of = lambda corners: {tuple(sorted((corners[k - 1], corners[k]))) for k in range(3)}
    assert {one.ends for one in found if one.fault == "open"} == edges_of(missing)
    assert {one.ends for one in found if one.fault == "turned"} == edges_of(turned) - edges_of(missing)
    assert found == sorted(found, key=lambda one: one.ends)
    assert all(type(one.ends) is tuple and one.facets == 1 + (one.fault == "turned") for one in found)
    crowded = netmesh.odd_edges([*CUBE, [2, 2, 2]], [*SIDES, [0, 1, 8]])
    assert [(one.fault, one.ends, one.facets) for one in crowded if one.facets == 3] == [("crowded", (0, 1), 3)]
    assert netmesh.odd_edges(CUBE, SIDES) == netmesh.odd_edges(CUBE, TRIANGLES) == netmesh.odd_edges(CUBE) == []
    surface = SimpleNamespace(vertices=np.array(CROSSED), faces=[[0, 1, 2], [3, 4, 5]])
    assert len(netmesh.odd_edges(surface)) == 6


def test_what_crosses_is_refused():
    with pytest.raises(netmesh.InvalidArgumentError) as error:
        netmesh.mesh(CROSSED, facets=[[0, 1, 2], [3, 4, 5]])
    assert "cross" in str(error.value) and "[0]" in str(error.value) and "[1]" in str(error.value)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"facets": 7}, "facets is 7; it must be an array of triangles, or a sequence of polygons"),
        ({"facets": "cube"}, "facets is 'cube'; it must be an array"),
        ({"facets": [3, 4]}, "facets[0] is 3; it must be a polygon or a list of loops"),
        ({"facets": np.zeros(3, int)}, "facets has shape (3,); it must be an array of triangles"),
        ({"facets": np.zeros((2, 3))}, "facets has dtype float64; it must be of whole numbers"),
        ({"facets": [[0, 1, 2.5, 3]]}, "facets[0] has dtype float64; it must be of whole numbers"),
        ({"facets": [[[0, 1, 3, 2], 5]]}, "facets[0][1] is 5; it must be a list of inputs"),
        ({"facets": [[[0, 1, 3, 2], []]]}, "facets[0][1] has shape (0,); it must be (inputs,)"),
        ({"facets": [[0, 1, 8]]}, "facets[0] has the input 8; it must be less than the number of inputs, 8"),
        ({"facets": [[0, 1, 2], [0, -1, 3]]}, "facets[1] has the input -1; it must be at least 0"),
        ({"facets": [[0, 1, 3, 2], [[4, 6, 7, 5], [2**40]]]}, "facets[1] has the input 1099511627776;"),
        ({"facets": [[0, 1, 1]]}, "facets[0] has no area near ("),
        ({"facets": [[0, 1, 3, 3]]}, "facets[0] has input 3 twice in a row in its loop 0;"),
        ({"facets": [[[0, 1], [2]]]}, "facets[0] has no loop of three or more inputs;"),
        ({"facets": SIDES, "facet_markers": [1]}, "facet_markers has shape (1,); it must be that of the facets, (6,)"),
        ({"facets": SIDES[:1], "facet_markers": [2**31]}, "facet_markers[0] is 2147483648; it must be a number of"),
        ({"facet_markers": [1]}, "facet_markers is given; it must come with facets"),
        ({"facets": SIDES, "regions": [(0, 0, 1)]}, "regions[0] has 3 values; it must be (x, y, z, label) or"),
        ({"facets": SIDES, "holes": [[1, 2]]}, "holes[0] has 2 coordinates; it must have 3"),
        ({"facets": SIDES, "coplanar": 11}, "coplanar is 11; it must be 0 (default 0) or in [0, 10]"),
        ({"facets": SimpleNamespace(vertices=CUBE[1:], faces=SIDES)}, "points has shape (8, 3); they must begin"),
    ],
)
def test_what_cannot_be_is_refused(given, message):
    with pytest.raises(netmesh.InvalidArgumentError) as error:
        netmesh.mesh(CUBE, **given)
    assert str(error.value).startswith(message)


@pytest.mark.parametrize("dim", [2, 4])
def test_facets_are_for_space(dim):
    points = np.random.default_rng(1).random((8, dim))
    for facets, name in ((SIDES, "facets"), (TRIANGLES, "triangles")):
        with pytest.raises(netmesh.InvalidArgumentError, match=f"dimension {dim}; {name} are for 3D"):
            netmesh.mesh(points, facets=facets)
    with pytest.raises(netmesh.InvalidArgumentError, match="intersections are for 3D"):
        netmesh.intersections(points)
    with pytest.raises(netmesh.InvalidArgumentError, match="edges of facets are for 3D"):
        netmesh.odd_edges(points)
    with pytest.raises(netmesh.InvalidArgumentError, match=f"coplanar is 1; it must be 0 in {dim}D"):
        netmesh.mesh(points, coplanar=1.0)


def test_regions_above_space_are_refused():
    points = np.random.default_rng(1).random((8, 4))
    with pytest.raises(netmesh.InvalidArgumentError, match="dimension 4; regions and holes are for 2D and 3D"):
        netmesh.mesh(points, holes=[[0, 0, 0, 0]])


@pytest.mark.parametrize("extent", ["box", "hull"])
def test_boxes_and_hulls_of_points(extent):
    points = np.vstack([CUBE, np.random.default_rng(5).random((40, 3))])
    bound = dict(criterion="radius_edge", quality_bound=2.0)
    mesh = netmesh.mesh(points, extent=extent, **bound)
    assert mesh.volumes.sum() == pytest.approx(1, abs=1e-12) and mesh.validate().violations == 0
    assert mesh.parameters["extent"] == extent and (mesh.facet_parents == -1).all()
    assert (mesh.facet_simplices[:, 0] == -1).all() and (mesh.facet_simplices[:, 1] >= 0).all()
    # A facet on a side has its triangles.
    mesh = netmesh.mesh(points, facets=[SIDES[0]], extent=extent, **bound)
    a, b, c = mesh.points[mesh.facet_triangles[mesh.facet_parents == 0]].transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    assert area == pytest.approx(1, abs=1e-12) and mesh.volumes.sum() == pytest.approx(1, abs=1e-12)


def test_boxes_and_hulls_without_volume_are_refused():
    with pytest.raises(netmesh.Error, match="extent='box' has no volume") as error:
        netmesh.mesh(CUBE[:4], extent="box")
    assert "in a plane" in str(error.value)

"""Surfaces through points, beside SciPy's triangulation and trimesh's measures."""

import copy
import pickle

import numpy as np
import pytest

import netmesh

trimesh = pytest.importorskip("trimesh")


def on_torus(count: int) -> np.ndarray:
    random = np.random.default_rng(5)
    u, v, w = random.random((3, 4 * count))
    reach = 1 + 0.4 * np.cos(2 * np.pi * v)
    kept = w * 1.4 < reach
    u, v, reach = u[kept], v[kept], reach[kept]
    u, v = 2 * np.pi * u, 2 * np.pi * v
    return np.c_[reach * np.cos(u), reach * np.sin(u), 0.4 * np.sin(v)][:count]


def test_a_torus_is_what_trimesh_finds_it_to_be():
    points = on_torus(3000)
    found = netmesh.surface(points)
    outside = trimesh.Trimesh(found.vertices, found.faces, process=False)
    assert outside.is_watertight and outside.is_winding_consistent
    assert outside.euler_number == 0 and found.genera == (1,)
    assert outside.volume == pytest.approx(found.volume, rel=1e-12) and found.volume > 0
    assert len(found.left_out) == 0 and len(found.vertices) == 3000
    found.validate()


def test_duplicates_and_outliers_are_told_by_the_numbers_of_points():
    points = on_torus(3000)
    given = np.concatenate([[[0, 0, 5.0]], points, points[:10], [[0, 0, -5.0]], [[0, 0, 5.0]]])
    found = netmesh.surface(given)
    assert found.left_out.tolist() == [0, 3011]
    assert (given[found.point_facets] == found.vertices[found.facets]).all()
    assert found.is_inside.shape == (len(found.triangulation.simplices),)
    inside = found.triangulation.volumes[found.is_inside].sum()
    assert inside == pytest.approx(found.volume, rel=1e-12)


def test_the_way_goes_on_to_a_mesh_and_to_files(tmp_path):
    found = netmesh.surface(on_torus(1500))
    part = netmesh.mesh(found, min_dihedral=10)
    assert part.volumes.sum() == pytest.approx(found.volume, rel=1e-12)
    for name in ("a.off", "a.ply", "a.obj", "a.stl"):
        found.export(tmp_path / name)
        read = trimesh.load(tmp_path / name)
        read.merge_vertices()
        assert read.is_watertight and len(read.faces) == len(found.faces)
    again = pickle.loads(pickle.dumps(found))
    assert (again.faces == found.faces).all() and (copy.deepcopy(found).faces == found.faces).all()


def test_an_open_surface_ends_where_its_points_do():
    random = np.random.default_rng(2)
    u, v = random.random((2, 3000))
    tube = np.c_[np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), 3 * v]
    found = netmesh.surface(tube, closed=False)
    assert not found.closed and found.genera == (0,) and found.is_one_sided == (False,)
    outside = trimesh.Trimesh(found.vertices, found.faces, process=False)
    assert outside.is_winding_consistent and not outside.is_watertight
    assert outside.euler_number == 2 - sum(found.ends)
    loops = outside.outline().entities
    assert len(loops) == sum(found.ends) == 2
    assert found.volume == 0 and not found.is_inside.any() and "ends (2,)" in repr(found)
    assert pickle.loads(pickle.dumps(found)).ends == found.ends
    found.validate()


def test_sampling_is_the_circumradius_over_the_distance_to_the_poles():
    points = on_torus(3000)
    found = netmesh.surface(points)
    assert found.sampling.shape == (len(found.vertices),)
    a, b, c = (found.vertices[found.faces[:, k]] for k in range(3))
    lengths = [np.linalg.norm(x - y, axis=1) for x, y in ((a, b), (b, c), (c, a))]
    radii = np.prod(lengths, axis=0) / (2 * np.linalg.norm(np.cross(b - a, c - a), axis=1))
    largest = np.zeros(len(found.vertices))
    np.maximum.at(largest, found.faces.ravel(), np.repeat(radii, 3))
    # The medial axis of the tube is 0.4 away, which a few poles fall short of.
    sizes = largest / found.sampling
    assert np.median(sizes) == pytest.approx(0.4, rel=0.05) and (sizes < 0.41).all()


def test_what_has_no_surface_is_refused_by_name():
    with pytest.raises(netmesh.InvalidArgumentError, match="4 dimensions"):
        netmesh.surface(np.random.default_rng(0).random((30, 4)))
    with pytest.raises(netmesh.DegenerateInputError):
        netmesh.surface([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    curve = netmesh.surface([[0, 0], [1, 0], [1, 1], [0, 1]])
    with pytest.raises(AttributeError, match="no faces"):
        curve.faces
    with pytest.raises(netmesh.InvalidArgumentError, match="STL"):
        curve.export("a.stl")
    with pytest.raises(netmesh.InvalidArgumentError, match="extension"):
        curve.export("a.vtu")

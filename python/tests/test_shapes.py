"""Alpha shapes beside GUDHI's Betti numbers, and shapes whose topology is known."""

import netmesh
import numpy as np
import pytest
from netmesh import FaceClass


def alpha_of(points):
    return netmesh.mesh(points, algorithm="delaunay").filtration("alpha")


def test_betti_numbers_are_gudhis(random):
    gudhi = pytest.importorskip("gudhi")
    for points in [random.random((80, 2)), random.random((60, 3)), random.integers(4, size=(40, 3))]:
        alpha = alpha_of(np.unique(points, axis=0))
        values = np.concatenate([alpha.values(k) for k in range(alpha.dim + 1)])
        for value in np.quantile(values, [0, 0.2, 0.4, 0.6, 0.8, 1], method="nearest"):
            shape = alpha.shape(value)
            tree = gudhi.SimplexTree()
            for k in range(alpha.dim + 1):
                inside = alpha.values(k) <= value
                assert shape.face_counts[k] == inside.sum()
                assert ((shape.classes(k) > FaceClass.EXTERIOR) == inside).all()
                tree.insert_batch(alpha.faces(k)[inside].T, alpha.values(k)[inside])
            tree.compute_persistence(persistence_dim_max=True)
            betti = (tree.betti_numbers() + [0] * 4)[: alpha.dim]
            assert shape.betti == tuple(betti)


def torus(count_around, count_across):
    u = np.linspace(0, 2 * np.pi, count_around, endpoint=False)[:, None]
    v = np.linspace(0, 2 * np.pi, count_across, endpoint=False)[None]
    wide = 3 + np.cos(v)
    coordinates = [wide * np.cos(u), wide * np.sin(u), np.sin(v) + 0 * u]
    return np.stack(coordinates, axis=-1).reshape(-1, 3)


def test_a_torus_becomes_a_surface_and_a_solid(tmp_path):
    alpha = alpha_of(torus(90, 30))
    assert alpha.shape(0.04).betti == (1, 2, 1)
    solid = alpha.shape(1.2)
    assert solid.betti == (1, 1, 0) and solid.voids == 0 and solid.components == 1
    assert abs(solid.volume - 2 * np.pi**2 * 3) < 1
    # A closed, oriented surface: each of its edges is passed once in either direction.
    edges = solid.boundary[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    backward = {tuple(edge) for edge in edges[:, ::-1].tolist()}
    assert backward == {tuple(edge) for edge in edges.tolist()} and len(backward) == len(edges)
    assert len(solid.boundary) == (solid.classes(2) == FaceClass.REGULAR).sum()
    points = netmesh.mesh(torus(90, 30), algorithm="delaunay").points
    a, b, c = points[solid.boundary].transpose(1, 0, 2)
    assert np.isclose(np.einsum("ij,ij->", a, np.cross(b, c)) / 6, solid.volume)
    solid.export(tmp_path / "torus.off")
    lines = (tmp_path / "torus.off").read_text().splitlines()
    assert lines[0] == "OFF" and lines[1].split()[1] == str(len(solid.boundary))
    with pytest.raises(netmesh.InvalidArgumentError, match=".ply, .off, .stl or .obj"):
        solid.export(tmp_path / "torus.vtu")


def test_values_by_name():
    points = [[0, 0], [1, 0], [1, 1], [0, 1], [9, 0.5]]
    alpha = alpha_of(points)
    connected, optimal = alpha.shape("connected"), alpha.shape()
    assert connected.alpha == (64 + 0.25) / 4 and connected.components == 1
    assert optimal.alpha == ((64 - 0.25) / 16) ** 2 + 0.25
    assert optimal.simplices.tolist() == [0, 1, 2] and alpha.shape(0.5).simplices.size == 2
    assert alpha.shape("optimal", components=2).alpha == optimal.alpha
    assert repr(alpha.shape(0)) == "<netmesh.AlphaShape 0: 5, 0, 0 faces from dimension 0 on>"


def test_what_is_no_alpha_is_refused():
    alpha = alpha_of([[0, 0], [1, 0], [0, 1]])
    for wrong in [-1, float("nan"), "best"]:
        with pytest.raises(netmesh.InvalidArgumentError, match="alpha is"):
            alpha.shape(wrong)
    with pytest.raises(TypeError, match="alpha"):
        alpha.shape(None)
    with pytest.raises(netmesh.InvalidArgumentError, match="components is 0"):
        alpha.shape("optimal", components=0)
    with pytest.raises(netmesh.InvalidArgumentError, match="k is 3"):
        alpha.shape(1).classes(3)
    near = netmesh.mesh([[0, 0], [1, 0], [0, 1]], output="well_spaced").filtration("mesh")
    with pytest.raises(netmesh.InvalidArgumentError, match="kind 'alpha'"):
        near.shape(1)

"""Faces and filtrations beside GUDHI's, and the theorem of docs/topology.md on diagrams."""

import itertools
import math

import netmesh
import numpy as np
import pytest


def faces_of(filtration):
    return {
        tuple(face): value
        for k in range(filtration.dim + 1)
        for face, value in zip(filtration.faces(k).tolist(), filtration.values(k).tolist())
    }


def alpha_of(points, **options):
    return netmesh.mesh(points, algorithm="delaunay").filtration("alpha", **options)


def diagrams(filtration):
    """The diagrams in lengths, without what lasts for ever or not at all."""
    tree = filtration.to_gudhi()
    tree.compute_persistence()
    found = []
    for k in range(filtration.dim):
        pairs = tree.persistence_intervals_in_dimension(k).reshape(-1, 2)
        pairs = np.sqrt(pairs) if filtration.kind == "alpha" else pairs
        pairs = pairs[np.isfinite(pairs[:, 1])]
        found.append(pairs[pairs[:, 1] > pairs[:, 0]])
    return found


def generic_sets(random):
    for dim, count in [(2, 300), (3, 150), (4, 60), (5, 25), (6, 14)]:
        yield random.random((count, dim))
        yield random.normal(size=(count, dim)) + 1e6
        yield np.exp(3 * random.normal(size=(count, dim)))
        centers = random.random((5, dim))
        yield centers[random.integers(5, size=count)] + 1e-4 * random.normal(size=(count, dim))


def test_values_are_gudhis_exact_ones(random):
    gudhi = pytest.importorskip("gudhi")
    for points in generic_sets(random):
        found = faces_of(alpha_of(points, threads=2))
        tree = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
        expected = {tuple(sorted(face)): value for face, value in tree.get_simplices()}
        assert found.keys() == expected.keys()
        for face, value in expected.items():
            # GUDHI's rounds down, or up.
            assert math.isclose(found[face], value, rel_tol=4e-16), (points.shape, face)


def degenerate_sets():
    yield list(itertools.product(range(6), repeat=2))
    yield list(itertools.product(range(4), repeat=3))
    yield list(itertools.product(range(2), repeat=4))
    yield [(5 * x, 5 * y) for x, y in [(0, 1), (0, -1), (1, 0), (-1, 0)]] + [
        (x, y) for x in (3, -3) for y in (4, -4)
    ] + [(x, y) for x in (4, -4) for y in (3, -3)]
    yield [p for p in itertools.product((-1, 0, 1), repeat=3) if sum(map(abs, p)) == 2]


def test_degenerate_points_have_gudhis_diagrams():
    gudhi = pytest.importorskip("gudhi")
    for points in degenerate_sets():
        points = np.array(points, float)
        tree = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
        tree.compute_persistence()
        for k, found in enumerate(diagrams(alpha_of(points))):
            expected = tree.persistence_intervals_in_dimension(k).reshape(-1, 2)
            expected = np.sqrt(expected[np.isfinite(expected[:, 1])])
            expected = expected[expected[:, 1] > expected[:, 0]]
            assert gudhi.bottleneck_distance(found, expected, 0) < 1e-12


def shapes(random):
    angle = 2 * np.pi * random.random((2, 150))
    circle = np.c_[np.cos(angle[0]), np.sin(angle[0])]
    yield "circle", circle
    yield "noisy circle", circle + 0.05 * random.normal(size=circle.shape)
    yield "annulus", circle * (1 + 0.3 * random.random((150, 1)))
    yield "figure eight", np.c_[np.sin(angle[0]), np.sin(angle[0]) * np.cos(angle[0])]
    yield "clusters", random.integers(4, size=(60, 2)) + 0.01 * random.normal(size=(60, 2))
    sphere = random.normal(size=(120, 3))
    yield "sphere", sphere / np.linalg.norm(sphere, axis=1, keepdims=True)
    wide = 2 + np.cos(angle[1])
    yield "torus", np.c_[wide * np.cos(angle[0]), wide * np.sin(angle[0]), np.sin(angle[1])]
    yield "nested", np.exp(random.uniform(-6, 0, (60, 1))) * circle[:60]
    yield "Clifford torus", np.c_[circle[:40], np.cos(angle[1][:40]), np.sin(angle[1][:40])]


def test_diagrams_of_meshes_are_within_the_factor(random):
    gudhi = pytest.importorskip("gudhi")
    for name, points in shapes(random):
        near = netmesh.mesh(points, output="well_spaced").filtration("mesh")
        assert 1 < near.factor < 4, name
        for k, (found, expected) in enumerate(zip(diagrams(near), diagrams(alpha_of(points)))):
            # Inputs are born at 0, which has no logarithm: only deaths differ.
            found, expected = (np.log(np.where(d == 0, 1e-9, d)) for d in (found, expected))
            distance = gudhi.bottleneck_distance(found, expected, 0)
            assert distance <= math.log(near.factor) * (1 + 1e-9), (name, k)


def test_a_distance_ratio_makes_the_factor_smaller(random):
    gudhi = pytest.importorskip("gudhi")
    for ratio, points in [(0.2, random.random((40, 2))), (0.5, random.random((12, 3)))]:
        mesh = netmesh.mesh(points, output="well_spaced", distance_ratio=ratio)
        assert mesh.validate().violations == 0
        near = mesh.filtration("mesh")
        assert near.factor <= math.sqrt((1 + ratio) / (1 - ratio)) * (1 + 1e-5)
        for found, expected in zip(diagrams(near), diagrams(alpha_of(points))):
            found, expected = (np.log(np.where(d == 0, 1e-9, d)) for d in (found, expected))
            assert gudhi.bottleneck_distance(found, expected, 0) <= math.log(near.factor)
    with pytest.raises(netmesh.InvalidArgumentError, match="^distance_ratio is 0.5; it does not go with output='hierarchical'$"):
        netmesh.mesh(points, distance_ratio=0.5, output="hierarchical")


def test_a_filtration_has_boundary_and_coboundary(random):
    alpha = alpha_of(random.random((40, 3)))
    assert alpha.dim == 3 and alpha.factor == 1
    for k in range(1, 4):
        faces, below = alpha.faces(k), alpha.faces(k - 1)
        for i in range(k + 1):
            assert (below[alpha.facets(k)[:, i]] == np.delete(faces, i, 1)).all()
        indptr, indices = alpha.cofaces(k - 1)
        assert len(indptr) == len(below) + 1 and len(indices) == faces.size
        for face in range(len(below)):
            for above in indices[indptr[face] : indptr[face + 1]]:
                assert face in alpha.facets(k)[above]
        assert (alpha.values(k - 1)[alpha.facets(k)] <= alpha.values(k)[:, None]).all()
        assert not faces.flags.writeable and not alpha.values(k).flags.writeable
    assert "faces of dimension 0 to 3" in repr(alpha)


def test_files_hold_the_filtration(random, tmp_path):
    alpha = alpha_of(random.random((60, 3)))
    alpha.export(tmp_path / "a.filtration")
    lines = [line.split() for line in (tmp_path / "a.filtration").read_text().splitlines()]
    found = {tuple(sorted(map(int, line[1:-1]))): float(line[-1]) for line in lines}
    assert found == faces_of(alpha) and len(lines) == len(found)
    seen, last = set(), 0.0
    for dim, *vertices, value in lines:
        face = sorted(map(int, vertices))
        assert len(face) == int(dim) + 1 and float(value) >= last
        assert int(dim) == 0 or seen.issuperset(itertools.combinations(face, int(dim)))
        seen.add(tuple(face))
        last = float(value)
    alpha.export(str(tmp_path / "a.dipha"))
    numbers = np.fromfile(tmp_path / "a.dipha", "<i8")
    magic, kind, transposed, n, dim = numbers[:5]
    assert (magic, kind, transposed, n, dim) == (8067171840, 0, 0, len(found), 3)
    dims, values = numbers[5 : 5 + n], numbers[5 + n : 5 + 2 * n].view("<f8")
    starts, entries = numbers[5 + 2 * n : 5 + 3 * n], numbers[6 + 3 * n :]
    assert numbers[5 + 3 * n] == len(entries)
    faces = [tuple(face) for k in range(4) for face in alpha.faces(k).tolist()]
    for cell, (face, boundary) in enumerate(zip(faces, np.split(entries, starts[1:]))):
        assert found[face] == values[cell] and dims[cell] == len(face) - 1
        expected = itertools.combinations(face, len(face) - 1) if len(face) > 1 else []
        assert {faces[facet] for facet in boundary} == set(expected)
    with pytest.raises(netmesh.InvalidArgumentError, match="use .filtration or .dipha"):
        alpha.export(tmp_path / "a.vtu")


def test_threads_do_not_matter(random):
    points = random.random((3000, 3))
    one, two = alpha_of(points), alpha_of(points, threads=2)
    for k in range(4):
        assert (one.faces(k) == two.faces(k)).all() and (one.values(k) == two.values(k)).all()


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda m: m.filtration("beta"), "kind"),
        (lambda m: m.filtration("alpha"), "make it with algorithm='delaunay'"),
        (lambda m: m.filtration("mesh", threads=-1), "threads"),
        (lambda m: m.filtration("mesh").faces(3), "k is 3; it must be 0 to 2"),
        (lambda m: m.filtration("mesh").facets(0), "k is 0; it must be 1 to 2"),
        (lambda m: m.filtration("mesh").cofaces(2), "k is 2; it must be 0 to 1"),
        (lambda m: m.filtration("mesh").values(-1), "k"),
    ],
)
def test_what_is_wrong_is_named(call, message):
    with pytest.raises(netmesh.InvalidArgumentError, match=message):
        call(netmesh.mesh([[0, 0], [1, 0], [0, 1], [3, 3]]))

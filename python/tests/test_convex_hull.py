"""`ConvexHull` beside SciPy's, and where roundings would decide."""

import itertools

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


def check(hull):
    """Holds what holds of every hull."""
    points, facets = hull.points, hull.simplices
    assert set(facets.ravel().tolist()) == set(hull.vertices.tolist())
    for facet, around in zip(facets, hull.neighbors):
        for k, other in enumerate(around):
            assert set(np.delete(facet, k)) <= set(facets[other]) and set(facet) != set(facets[other])
    normals, offsets = hull.equations[:, :-1], hull.equations[:, -1]
    size = np.ptp(points, axis=0).max()
    assert np.allclose(np.linalg.norm(normals, axis=1), 1)
    assert (points @ normals.T + offsets).max() < 1e-12 * size
    on = np.einsum("fvk,fk->fv", points[facets], normals) + offsets[:, None]
    assert np.abs(on).max() < 1e-12 * size
    assert hull.nsimplex == len(facets) and hull.coplanar.shape == (0, 3) and hull.good is None


@pytest.mark.parametrize("n, dim", [(200, 2), (200, 3), (60, 4), (30, 5), (14, 7)])
def test_hulls_of_points_in_general_position(n, dim, random):
    points = random.normal(size=(n, dim))
    ours, theirs = netmesh.ConvexHull(points), scipy.spatial.ConvexHull(points)
    check(ours)
    facets = [{frozenset(facet.tolist()) for facet in hull.simplices} for hull in (ours, theirs)]
    assert facets[0] == facets[1]
    for name in ("volume", "area"):
        assert np.isclose(getattr(ours, name), getattr(theirs, name), rtol=1e-12)
    assert (np.sort(ours.vertices) == np.sort(theirs.vertices)).all()
    assert (ours.min_bound == points.min(axis=0)).all() and (ours.max_bound == points.max(axis=0)).all()
    assert (ours.ndim, ours.npoints) == (dim, n)


def test_vertices_of_the_plane_stand_counterclockwise(random):
    for points in (random.random((100, 2)), random.random((100, 2)) * 1e-200, [[0, 0], [3, 1], [1, 4]]):
        hull = netmesh.ConvexHull(points)
        corners = hull.points[hull.vertices]
        edges = np.roll(corners, -1, axis=0) - corners
        edges /= np.abs(edges).max()
        turned = np.roll(edges, -1, axis=0)
        assert (edges[:, 0] * turned[:, 1] - edges[:, 1] * turned[:, 0] > 0).all()
        check(hull)
        assert len(set(hull.vertices.tolist())) == len(hull.vertices) == hull.nsimplex


@pytest.mark.parametrize("dim, n", [(2, 9), (3, 5), (4, 3)])
def test_points_between_others_are_no_vertices(dim, n, random):
    grid = np.array(list(itertools.product(range(n), repeat=dim)), float)
    random.shuffle(grid)
    # Exact under a shear.
    for points in (grid, grid @ (np.eye(dim) + np.triu(np.full((dim, dim), 3.0), 1)) + 7):
        hull = netmesh.ConvexHull(points)
        check(hull)
        is_corner = ((grid == 0) | (grid == n - 1)).all(axis=1)
        assert set(hull.vertices.tolist()) == set(np.flatnonzero(is_corner).tolist())
        assert np.isclose(hull.volume, (n - 1) ** dim)
    assert np.isclose(netmesh.ConvexHull(grid).area, 2 * dim * (n - 1) ** (dim - 1))


@pytest.mark.parametrize("dim", [2, 3, 4])
def test_points_between_others_whose_determinants_are_rounded(dim, random):
    count = 30
    corners = 12.0 * random.integers(-(2**40), 2**40, (count, dim))
    facets = scipy.spatial.ConvexHull(corners).simplices
    # Middles of facets are whole numbers, too, which doubles have; their determinants are not zero.
    middles = corners[facets].sum(axis=1) / dim
    assert (middles * dim == corners[facets].sum(axis=1)).all()
    points = np.concatenate([middles[:3], middles, corners])
    hull = netmesh.ConvexHull(points)
    expected = scipy.spatial.ConvexHull(corners)
    assert (np.unique(hull.vertices) - len(middles) - 3).tolist() == np.unique(expected.vertices).tolist()
    assert np.isclose(hull.volume, expected.volume, rtol=1e-9)


@pytest.mark.parametrize("dim", [2, 3])
def test_a_point_that_is_outside_by_one_rounding_is_a_vertex(dim):
    corners = np.array(list(itertools.product([0.0, 1.0], repeat=dim)))
    for inward in (0.0, 0.5, -np.spacing(0.5)):
        point = np.full(dim, 0.5)
        # In the middle of a facet, below it or above it by as little as there is.
        point[-1] = np.nextafter(1, 2) if inward < 0 else np.nextafter(1, 0) if inward else 1
        hull = netmesh.ConvexHull(np.vstack([corners, point]))
        assert (len(corners) in hull.vertices) == (inward < 0)
        assert len(hull.vertices) == len(corners) + (inward < 0)


def test_equal_points_and_more_points(random):
    points = random.random((40, 3))
    twice = np.concatenate([points, points])
    hull = netmesh.ConvexHull(twice, incremental=True)
    assert hull.vertices.max() < 40 and (hull.vertices == netmesh.ConvexHull(points).vertices).all()
    assert hull.equations.shape == (hull.nsimplex, 4) and hull.area > 0
    assert hull.max_bound.max() < 1
    hull.add_points([[2, 2, 2], [0.5, 0.5, 0.5]])
    assert hull.max_bound.tolist() == [2, 2, 2] and hull.npoints == 82
    check(hull)
    assert 80 in hull.vertices and 81 not in hull.vertices and hull.volume > netmesh.ConvexHull(points).volume
    hull.close()
    with pytest.raises(netmesh.StateError):
        hull.add_points([[3, 3, 3]])
    with pytest.raises(netmesh.DegenerateInputError):
        netmesh.ConvexHull([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    with pytest.raises(netmesh.InvalidArgumentError, match="^qhull_options has QG0"):
        netmesh.ConvexHull(points, qhull_options="QG0")


def equations_by_facet(hull):
    return {frozenset(facet): row for facet, row in zip(hull.simplices.tolist(), hull.equations)}


@pytest.mark.parametrize("dim", [2, 3, 4])
@pytest.mark.parametrize("exponent", [-900, 500, 532, 1020])
def test_hulls_of_very_large_and_very_small_points_are_those_of_others(dim, exponent, random):
    # Among the corners of the cube are points of its facets.
    points = np.array(list(itertools.product([-1.0, 0.25, 1.0], repeat=dim)))
    points = np.concatenate([points, random.normal(size=(20, dim))])
    plain, scaled = (netmesh.ConvexHull(given) for given in (points, np.ldexp(points, exponent)))
    assert (scaled.vertices == plain.vertices).all() and len(plain.vertices) < 3**dim
    ours, theirs = equations_by_facet(scaled), equations_by_facet(plain)
    # Points in one hyperplane may be parted otherwise.
    normals = {tuple(np.round(row, 9) + 0.0) for row in plain.equations[:, :-1]}
    assert {tuple(np.round(row, 9) + 0.0) for row in scaled.equations[:, :-1]} == normals
    for facet in set(ours) & set(theirs):
        assert np.allclose(np.ldexp(ours[facet][-1], -exponent), theirs[facet][-1], rtol=1e-12)
    with np.errstate(over="ignore", under="ignore"):
        for name, power in (("area", dim - 1), ("volume", dim)):
            expected = np.ldexp(getattr(plain, name), power * exponent)
            assert np.isclose(getattr(scaled, name), expected, rtol=1e-9, atol=0)


@pytest.mark.parametrize("exponent", [-900, 0, 532])
def test_points_in_general_position_need_no_exact_determinants(exponent, random, monkeypatch):
    from netmesh import _convex_hull

    asked = []
    monkeypatch.setattr(_convex_hull, "_are_coplanar", lambda *given: asked.append(given))
    hull = netmesh.ConvexHull(np.ldexp(random.normal(size=(100, 3)), exponent))
    assert not asked and hull.nsimplex > 20


def test_small_facets_of_large_hulls_have_normals():
    hull = netmesh.ConvexHull([[0, 1e-200], [1e-200, 0], [1, 0.5], [1, 1], [0.5, 1]])
    check(hull)
    row = hull.equations[np.flatnonzero((hull.simplices < 2).all(axis=1))[0]]
    assert np.allclose(row[:2], -np.sqrt(0.5))


def test_points_whose_differences_are_no_doubles():
    most = np.finfo(float).max
    square = most * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [0, np.nextafter(-1, 0)]])
    hull = netmesh.ConvexHull(square)
    assert hull.vertices.tolist() == [0, 1, 2, 3] and hull.area == np.inf == hull.volume
    assert np.allclose(np.abs(hull.equations[:, -1]) / most, 1)

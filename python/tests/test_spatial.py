"""What spatial statistics need: projectors, points that stand for others, meshes with a coarse ring."""

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


@pytest.mark.parametrize("dim", [2, 3, 4])
def test_a_projector_interpolates(dim, random):
    m = netmesh.mesh(random.random((200 if dim < 4 else 30, dim)))
    x = random.random((300, dim))
    A = m.projector(x, threads=2)
    assert isinstance(A, scipy.sparse.csr_array) and A.has_canonical_format
    assert A.shape == (300, len(m.points))
    values = random.random((len(m.points), 3))
    assert np.allclose(A @ values, m.interpolate(values, x), rtol=0, atol=1e-12)
    assert np.allclose(A @ m.points, x, rtol=0, atol=1e-12)
    # The vertices of a row are those of the simplex that holds the point.
    held = np.sort(m.simplices[m.locate(x)], axis=1)
    for at in range(0, 300, 7):
        assert set(A.indices[A.indptr[at] : A.indptr[at + 1]]) <= set(held[at])
    assert (A.data > 0).all() and np.allclose(A.sum(axis=1), 1, rtol=0, atol=1e-14)


def test_a_projector_at_vertices_and_outside(random):
    points = random.random((50, 2))
    m = netmesh.mesh(points, algorithm="delaunay")
    A = m.projector(points)
    assert A.nnz == 50 and (A.toarray() == np.eye(50)).all()
    x = np.array([[0.5, 0.5], [5, 5], [-3, 0.5]])
    A = m.projector(x)
    assert np.diff(A.indptr).tolist() == [3, 0, 0]
    A = m.projector(x, outside="nearest")
    values = random.random(50)
    assert (A @ values)[1:].tolist() == m.interpolate(values, x[1:], outside="nearest").tolist()
    middles = points[m.hull.vertices].mean(axis=1)
    assert (m.locate(middles) == -1).any()
    A = m.projector(middles, outside="refuse")
    assert np.allclose(A @ points, middles, rtol=0, atol=1e-12)
    assert (np.diff(m.projector(middles, tol=0).indptr) == 0).tolist() == (m.locate(middles) == -1).tolist()
    for arguments, text in [
        ({"outside": "refuse"}, r"^points\[1\] is outside the mesh, as 2 points are; outside='zero'"),
        ({"outside": "far"}, "^outside is 'far'; it must be one of 'zero', 'nearest', 'refuse'"),
        ({"tol": -1}, "^tol is -1.0; it must be at least 0"),
    ]:
        with pytest.raises(netmesh.InvalidArgumentError, match=text):
            m.projector(x, **arguments)
    shape = r"^points has shape \(2,\); it must be \(n, 2\)"
    for wrong, text in [(x[0], shape), (x * np.nan, r"^points\[0\] has a non-finite")]:
        with pytest.raises(netmesh.InvalidArgumentError, match=text):
            m.projector(wrong)


def test_a_projector_of_a_mesh_that_is_cut_to_its_domain():
    ring = np.array([[0, 0], [3, 0], [3, 3], [0, 3], [1, 1], [2, 1], [2, 2], [1, 2.0]])
    sides = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    m = netmesh.mesh(ring, sides, interior="parity")
    A = m.projector([[0.5, 0.5], [1.5, 1.5], [3, 1.5], [3 + 1e-15, 1.5], [3.1, 1.5], [1.5, 1.001]])
    assert (np.diff(A.indptr) > 0).tolist() == [True, False, True, True, False, False]
    # Into the hole, too, simplices reach as far as a tolerance says.
    A = m.projector([[1.5, 1.001]], tol=0.1)
    assert np.allclose(A @ m.points, [[1.5, 1.001]], rtol=0, atol=1e-12)


def by_pairs(points, cutoff):
    """Representatives by a look at all pairs."""
    chosen = []
    for at, x in enumerate(points):
        if not any(np.linalg.norm(x - points[c]) < cutoff for c in chosen):
            chosen.append(at)
    distances = np.linalg.norm(points[:, None] - points[chosen], axis=2)
    found = np.array(chosen)[distances.argmin(axis=1)]
    found[chosen] = chosen
    return found


@pytest.mark.parametrize("dim", [2, 3, 5])
@pytest.mark.parametrize("cutoff", [0.0, 0.02, 0.2, 3.0])
def test_who_stands_for_whom(dim, cutoff, random):
    points = random.random((300, dim))
    points[100:120] = points[:20]
    found = netmesh.representatives(points, cutoff)
    assert found.dtype == np.int32 and (found == by_pairs(points, cutoff)).all()
    chosen = np.unique(found)
    assert (found[chosen] == chosen).all()
    if cutoff > 0:
        assert scipy.spatial.distance.pdist(points[chosen]).min(initial=np.inf) >= cutoff
        assert (np.linalg.norm(points - points[found], axis=1) < cutoff).all()
    assert (netmesh.representatives(points[::2], cutoff) == by_pairs(points[::2], cutoff)).all()


def test_who_stands_for_whom_at_the_distance_itself():
    points = [[0, 0], [1, 0], [0.5, 0], [2, 0]]
    assert netmesh.representatives(points, 1).tolist() == [0, 1, 0, 3]
    assert netmesh.representatives(points, np.nextafter(1, 2)).tolist() == [0, 0, 0, 3]
    assert netmesh.representatives(np.zeros((0, 2)), 1).tolist() == []
    for arguments, text in [
        (([[0, 0]], -1), "^cutoff is -1; it must be at least 0 and finite"),
        (([[0, 0]], np.inf), "^cutoff is inf"),
        (([[0, 0]], None), "^cutoff is of type NoneType"),
        (([[0], [1]], 1), "^points have 1 coordinates"),
        (([[0, 0], [0, np.nan]], 1), r"^points\[1\] has a non-finite coordinate 1"),
    ]:
        with pytest.raises(netmesh.Error, match=text):
            netmesh.representatives(*arguments)


@pytest.mark.parametrize("corners", [3, 8, 16])
def test_an_offset_hull_is_convex_and_touches_what_is_near(corners, random):
    angle = random.random(2000) * 2 * np.pi
    for points in (
        random.random((50, 2)) * [1, 40],
        np.column_stack([np.cos(angle), np.sin(angle)]) * 100 + 1e4,
        np.array([[0, 0], [1, 3], [2, 6.0]]),
        np.array([[7.0, -2.0]]),
    ):
        hull = netmesh.offset_hull(points, 0.5, corners)
        assert corners <= len(hull) <= 2 * corners
        edges = np.roll(hull, -1, axis=0) - hull
        turned = np.roll(edges, -1, axis=0)
        assert (edges[:, 0] * turned[:, 1] > edges[:, 1] * turned[:, 0]).all()
        normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.hypot(*edges.T)[:, None]
        # The farthest point in the direction of each side is 0.5 from it.
        reach = (hull * normals).sum(axis=1) - (points @ normals.T).max(axis=0)
        assert np.allclose(reach, 0.5, rtol=0, atol=1e-9)


@pytest.mark.parametrize("exponent", [-1000, 532, 1015])
def test_an_offset_hull_of_very_large_or_small_points_is_that_of_others(exponent, random):
    points = random.normal(size=(40, 2))
    hull = netmesh.offset_hull(np.ldexp(points, exponent), 2.0**exponent)
    assert (hull == np.ldexp(netmesh.offset_hull(points, 1), exponent)).all()
    # A point is small beside a large distance, and the other way round.
    assert netmesh.offset_hull([[1, 2]], 1e200, corners=4).max() == pytest.approx(1e200, rel=1e-12)
    assert len(netmesh.offset_hull([[1e200, 0], [0, 1e200], [0, 0]], 1e-200)) >= 16
    rule = "^distance is 1e[+]308; the hull must be within the range of doubles"
    with pytest.raises(netmesh.InvalidArgumentError, match=rule):
        netmesh.offset_hull([[1e308, 0]], 1e308)


def test_an_offset_hull_keeps_long_edges():
    turn = np.array([[0.8, 0.6], [-0.6, 0.8]])
    hull = netmesh.offset_hull([[0, 0], [10, 0], [10, 5], [0, 5]] @ turn, 1, 8) @ turn.T
    for axis, (low, high) in enumerate([(-1, 11), (-1, 6)]):
        for side in (low, high):
            assert np.isclose(hull[:, axis], side).sum() == 2
        assert np.isclose(hull[:, axis].min(), low) and np.isclose(hull[:, axis].max(), high)
    # Of edges that differ little in direction the longest counts.
    for given in ([[0, 0], [10, 0], [10.5, 0.05], [10.5, 5], [0, 5]], [[0.5, 0], [10.5, 0], [0, 0.05], [5, 9]]):
        hull = netmesh.offset_hull(given, 1, 8)
        assert np.isclose(hull[:, 1], -1, rtol=0, atol=1e-9).sum() == 2
    for arguments, text in [
        (([[0, 0]], 0), "^distance is 0.0; it must be above 0"),
        (([[0, 0]], np.nan), "^distance is nan"),
        (([[0, 0]], 1, 2), "^corners is 2; it must be at least 3"),
        (([[0, 0]], 1, 4.5), "^corners is of type float"),
        (([[0, 0, 0]], 1), r"^points has shape \(1, 3\); it must be \(n, 2\)"),
        ((np.zeros((0, 2)), 1), r"^points has shape \(0, 2\)"),
        (([[0, np.inf]], 1), r"^points\[0\] has a non-finite coordinate 1: inf"),
    ]:
        with pytest.raises(netmesh.Error, match=text):
            netmesh.offset_hull(*arguments)


def test_a_spatial_mesh_is_fine_inside_and_coarse_in_the_ring(random):
    points = random.random((400, 2))
    made = netmesh.spatial_mesh(points, max_edge=(0.08, 0.4), offset=(0.1, 1), cutoff=0.03)
    m = made.mesh
    assert m.validate().violations == 0 and m.quality().min_angle_degrees >= 25
    assert (made.representatives == netmesh.representatives(points, 0.03)).all()
    is_meshed = made.representatives == np.arange(400)
    assert 100 < is_meshed.sum() < 400
    assert (m.points[made.vertices] == points[made.representatives]).all()
    # Who is not meshed is no vertex.
    others = {tuple(x) for x in points[~is_meshed]}
    assert not others & {tuple(x) for x in m.points}
    corners = m.points[m.simplices]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    is_inner = m.simplex_regions == 1
    assert set(m.simplex_regions.tolist()) == {1, 2}
    assert longest[is_inner].max() <= 0.08 and 0.2 < longest[~is_inner].max() <= 0.4
    area = lambda p: 0.5 * abs((p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1)).sum())
    assert np.isclose(m.volumes[is_inner].sum(), area(made.inner))
    assert np.isclose(m.volumes.sum(), area(made.outer))
    assert (m.simplex_regions[m.locate(points)] == 1).all()
    A = m.projector(points, outside="refuse")
    assert np.allclose(A @ m.points, points, rtol=0, atol=1e-12)


def test_spatial_meshes_of_few_points_and_what_is_refused():
    for points in ([[3, 4]], [[0, 0], [1, 1], [2, 2]], np.zeros((5, 2))):
        made = netmesh.spatial_mesh(points, max_edge=(0.5, 2), offset=(1, 3), cutoff=0.1, seed=3)
        assert (made.mesh.points[made.vertices] == np.array(points)[made.representatives]).all()
        assert made.mesh.options["seed"] == 3 and (made.mesh.points[made.vertices[0]] == points[0]).all()
    good = {"max_edge": (1, 2), "offset": (1, 2)}
    for arguments, text in [
        ({"max_edge": 1}, "^max_edge is 1; it must be two finite lengths, inner and outer"),
        ({"max_edge": (1, 0)}, r"^max_edge is \(1, 0\); both lengths must be above 0"),
        ({"offset": (0, 1)}, r"^offset is \(0, 1\); both widths must be above 0"),
        ({"offset": (1, np.inf)}, "^offset is"),
        ({"cutoff": -1}, "^cutoff is -1"),
        ({"extent": "hull"}, "^extent is given by spatial_mesh itself"),
        ({"colour": 1}, "colour"),
    ]:
        with pytest.raises((netmesh.Error, TypeError), match=text):
            netmesh.spatial_mesh([[0, 0], [1, 0]], **{**good, **arguments})

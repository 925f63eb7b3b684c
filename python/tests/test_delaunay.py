"""`Delaunay` beside SciPy's."""

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


def sets(simplices):
    return set(map(tuple, np.sort(simplices, axis=1).tolist()))


@pytest.mark.parametrize("n, dim", [(2000, 2), (1000, 3), (300, 4), (80, 5), (30, 6), (20, 7)])
def test_the_same_triangulation(n, dim, random):
    points = random.random((n, dim))
    ours, theirs = netmesh.Delaunay(points), scipy.spatial.Delaunay(points)
    assert sets(ours.simplices) == sets(theirs.simplices)
    assert sets(ours.convex_hull) == sets(theirs.convex_hull)
    assert ours.simplices.dtype == ours.neighbors.dtype == np.int32
    for ptr, ids in [ours.vertex_neighbor_vertices]:
        their_ptr, their_ids = theirs.vertex_neighbor_vertices
        for v in range(n):
            assert set(ids[ptr[v] : ptr[v + 1]]) == set(their_ids[their_ptr[v] : their_ptr[v + 1]])
    order, their_order = (np.lexsort(np.sort(t.simplices, 1).T) for t in (ours, theirs))
    x = random.random((50, dim))
    distances = ours.plane_distance(x)[:, order]
    assert np.allclose(distances, theirs.plane_distance(x)[:, their_order], atol=1e-9)
    assert np.allclose(ours.lift_points(x), theirs.lift_points(x))
    assert np.allclose(ours.equations[order], theirs.equations[their_order], atol=1e-7)
    found, their_found = ours.find_simplex(x), theirs.find_simplex(x)
    assert ((found == -1) == (their_found == -1)).all()
    inside = found != -1
    found, their_found = found[inside], their_found[inside]
    assert (np.sort(ours.simplices[found]) == np.sort(theirs.simplices[their_found])).all()
    for key in ("ndim", "npoints", "nsimplex", "furthest_site"):
        assert getattr(ours, key) == getattr(theirs, key)
    assert (ours.min_bound == theirs.min_bound).all() and (ours.max_bound == theirs.max_bound).all()


def test_the_transform_gives_barycentric_coordinates(random):
    tri = netmesh.Delaunay(random.random((500, 3)))
    x = 0.1 + 0.8 * random.random((200, 3))
    found = tri.find_simplex(x)
    assert (found >= 0).all() and tri.transform.shape == (tri.nsimplex, 4, 3)
    b = np.einsum("sij,sj->si", tri.transform[found, :3], x - tri.transform[found, 3])
    b = np.column_stack([b, 1 - b.sum(axis=1)])
    assert (b >= -1e-12).all()
    corners = tri.points[tri.simplices[found]]
    assert np.allclose(np.einsum("si,sij->sj", b, corners), x, atol=1e-12)


def test_a_simplex_too_flat_for_doubles_has_no_transform():
    points = np.array([[0, 0], [1, 0], [0.5, 1e-17], [0.5, 1]])
    tri = netmesh.Delaunay(points)
    flat = np.isnan(tri.transform).all(axis=(1, 2))
    assert sets(tri.simplices[flat]) == {(0, 1, 2)} and len(flat) == 3
    assert np.isfinite(tri.transform[~flat]).all()
    assert tri.find_simplex(points.mean(axis=0)) >= 0


def test_hull_facets_are_oriented_outwards(random):
    for dim in range(2, 6):
        points = random.random((50, dim)) - 0.5
        tri = netmesh.Delaunay(points)
        center = points.mean(axis=0)
        rows = np.concatenate([points[tri.convex_hull] - center], axis=1)
        assert (np.linalg.det(rows) > 0).all()


def test_equal_points_are_coplanar(random):
    points = random.random((20, 3))
    points = np.concatenate([points[:10], points[[3, 5]], points[10:], points[[3]]])
    tri = netmesh.Delaunay(points)
    assert tri.coplanar[:, [0, 2]].tolist() == [[10, 3], [11, 5], [22, 3]]
    assert (tri.points == points).all() and tri.npoints == 23
    own = np.arange(23)
    own[[10, 11, 22]] = 3, 5, 3
    assert all(own[i] in tri.simplices[s] for i, s in enumerate(tri.vertex_to_simplex))
    assert set(tri.simplices.ravel()) == set(tri.convex_hull.ravel()) | set(own) == set(own)
    ptr, ids = tri.vertex_neighbor_vertices
    for i in range(23):
        around = tri.simplices[(tri.simplices == i).any(axis=1)]
        assert set(ids[ptr[i] : ptr[i + 1]]) == set(around.ravel()) - {i}


def test_points_are_added(random):
    points = random.random((40, 2))
    tri = netmesh.Delaunay(points[:20], incremental=True)
    assert tri.transform.shape[0] == tri.nsimplex and len(tri.vertex_to_simplex) == 20
    tri.add_points(points[20:])
    assert sets(tri.simplices) == sets(netmesh.Delaunay(points).simplices)
    assert tri.transform.shape[0] == tri.nsimplex and len(tri.vertex_to_simplex) == 40
    tri.close()
    with pytest.raises(netmesh.StateError, match="incremental"):
        tri.add_points(points)


def test_what_is_refused(random):
    points = random.random((10, 2))
    for arguments, text in [
        ({"furthest_site": True}, "furthest_site"),
        ({"qhull_options": "Qbb QG4"}, "qhull_options has QG4"),
    ]:
        with pytest.raises(netmesh.InvalidArgumentError, match=text):
            netmesh.Delaunay(points, **arguments)
    with pytest.raises(ValueError, match="masked"):
        netmesh.Delaunay(np.ma.masked_equal(points, points[0, 0]))
    tri = netmesh.Delaunay(points)
    with pytest.raises(ValueError, match=r"xi has shape \(3,\); it must be \(..., 2\)"):
        tri.find_simplex([1, 2, 3])
    with pytest.raises(ValueError, match="points"):
        netmesh.Delaunay(points, incremental=True).add_points([[1, 2, 3]])


def test_what_is_not_finite_is_outside(random):
    tri = netmesh.Delaunay(random.random((100, 2)))
    x = np.full((2, 3, 2), 0.5)
    x[0, 1, 0], x[1, 2, 1] = np.nan, np.inf
    assert ((tri.find_simplex(x) == -1) == [[False, True, False], [False, False, True]]).all()


def test_classes_of_scipys_names_tell_what_they_hold():
    points = np.array([[0, 0], [1, 0], [0, 1], [1, 2.0]])
    assert repr(netmesh.Delaunay(points)) == "<netmesh.Delaunay: dim 2, 4 points, 2 simplices>"
    assert repr(netmesh.Voronoi(points)) == "<netmesh.Voronoi: dim 2, 4 points>"
    assert repr(netmesh.ConvexHull(points)) == "<netmesh.ConvexHull: dim 2, 4 points, 4 facets>"
    for name in ("LinearNDInterpolator", "NearestNDInterpolator", "CloughTocher2DInterpolator"):
        made = getattr(netmesh, name)(points, points[:, 0])
        assert repr(made) == f"<netmesh.{name}: dim 2, 4 points>"

"""Locations and nearest vertices."""

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


@pytest.mark.parametrize("dim", [2, 3, 4])
def test_nearest_is_that_of_scipy(dim, random):
    m = netmesh.mesh(random.random((400, dim)))
    x = 3 * random.random((2, 500, dim)) - 1
    for among, points in [("vertices", m.points), ("inputs", m.points[:400])]:
        vertices, distances = m.nearest(x, among=among)
        their_distances, theirs = scipy.spatial.cKDTree(points).query(x)
        assert vertices.shape == distances.shape == (2, 500)
        assert (vertices == theirs).all() and np.allclose(distances, their_distances, rtol=1e-15)


def test_ties_have_the_least_id():
    m = netmesh.mesh([[0, 0], [1, 0], [1, 1], [0, 1]], algorithm="delaunay")
    assert m.nearest([[0.5, 0.5], [1, 0.5]])[0].tolist() == [0, 1]
    assert m.locate([[0.5, 0.5], [0, 0]]).tolist() == [0, m.locate([0, 0])]


@pytest.mark.parametrize("count", [1, 300_000])
def test_answers_do_not_depend_on_threads(count, random):
    m = netmesh.mesh(random.random((2000, 3)))
    x = random.random((count, 3))
    values = random.random(len(m.points))
    for ask in [
        lambda threads: m.locate(x, threads=threads),
        lambda threads: m.nearest(x, threads=threads)[1],
        lambda threads: m.interpolate(values, x, threads=threads),
    ]:
        one = ask(1)
        assert (one == ask(2)).all() and (one == ask(0)).all()


def test_no_points():
    m = netmesh.mesh(np.eye(3))
    assert m.locate(np.zeros((0, 3))).shape == (0,)
    assert m.nearest(np.zeros((4, 0, 3)))[1].shape == (4, 0)
    assert m.interpolate(np.zeros((len(m.points), 5)), np.zeros((0, 3))).shape == (0, 5)


def test_what_is_refused(random):
    m = netmesh.mesh(random.random((10, 2)))
    values = np.zeros(len(m.points))
    with pytest.raises(netmesh.InvalidArgumentError, match=r"one for each vertex; extend_values makes"):
        m.interpolate(values[:10], [0, 0])
    with pytest.raises(netmesh.InvalidArgumentError, match=r"one for each vertex$"):
        m.interpolate(values[:9], [0, 0])
    with pytest.raises(netmesh.InvalidArgumentError, match="^values has masked elements"):
        m.interpolate(np.ma.masked_equal(values, 0), [0, 0])
    for ask in (m.locate, m.nearest, lambda x: m.interpolate(values, x)):
        with pytest.raises(netmesh.NonFiniteError, match=r"points\[1\] .* coordinate 0: NaN"):
            ask([[0, 0], [np.nan, 0]])
        with pytest.raises(netmesh.InvalidArgumentError, match=r"points has shape \(3,\)"):
            ask([1, 2, 3])
        with pytest.raises(netmesh.InvalidArgumentError, match=r"points has shape \(\)"):
            ask(1)
        late = np.zeros((300_000, 2))
        late[299_999, 1] = np.inf
        with pytest.raises(netmesh.NonFiniteError, match=r"points\[299999\] .* coordinate 1: inf"):
            ask(late)
    with pytest.raises(ValueError, match="^among is 'all'; it must be 'vertices' or 'inputs'"):
        m.nearest([0, 0], among="all")
    for threads in (-1, 2**32):
        for ask in (m.locate, m.nearest):
            with pytest.raises(ValueError, match=f"^threads is {threads}; it must be 0 to"):
                ask([0, 0], threads=threads)


@pytest.mark.parametrize("dim", [2, 3])
def test_few_points_have_the_answers_that_many_have(dim, random):
    """Some are answered by the thread that asks, more by another one."""
    points, x = random.random((400, dim)), 1.2 * random.random((300, dim)) - 0.1
    m, values = netmesh.mesh(points), random.random((400, 2))
    at_vertices = m.extend_values(values)
    linear, nearest = netmesh.LinearNDInterpolator(points, values), netmesh.NearestNDInterpolator(points, values)
    asked = [m.locate, m.part("hull").locate, lambda x: m.nearest(x)[0], lambda x: m.nearest(x, among="inputs")[1]]
    asked += [lambda x: m.interpolate(at_vertices, x), lambda x: m.interpolate(at_vertices, x, interpolation="sibson")]
    asked += [linear, nearest, lambda x: linear.tri.find_simplex(x, tol=0.01)]
    if dim == 2:
        asked += [netmesh.CloughTocher2DInterpolator(points, values)]
    for ask in asked:
        whole = ask(x)
        for count in (1, 128, 256, 257):
            parts = [ask(x[at : at + count]) for at in range(0, len(x), count)]
            assert np.array_equal(np.concatenate(parts), whole, equal_nan=True)

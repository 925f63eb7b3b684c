"""`CloughTocher2DInterpolator`, `NearestNDInterpolator` and `griddata` beside SciPy's, tolerances at the
hull, and triangulations of SciPy's.
"""

import itertools
import pickle
import warnings

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


def wave(points):
    x, y = points[..., 0], points[..., 1]
    return np.sin(3 * x) * np.cos(2 * y) + x * y


def given_values(points, shape, is_complex, random):
    noise = random.random((len(points), *shape))
    values = wave(points).reshape(-1, *[1] * len(shape)) + 0.1 * noise
    return values + (1j * random.random(values.shape) if is_complex else 0)


@pytest.mark.parametrize("n", [20, 3000])
@pytest.mark.parametrize("shape, is_complex", [((), False), ((3,), False), ((2, 2), True)])
def test_cubic_values_are_scipys_on_its_triangulation(n, shape, is_complex, random):
    points, x = random.random((n, 2)), 1.2 * random.random((4, 500, 2)) - 0.1
    values = given_values(points, shape, is_complex, random)
    tri = scipy.spatial.Delaunay(points)
    for arguments in [{}, {"fill_value": -3.0}, {"tol": 1e-3, "maxiter": 50}]:
        ours = netmesh.CloughTocher2DInterpolator(tri, values, **arguments)
        theirs = scipy.interpolate.CloughTocher2DInterpolator(tri, values, **arguments)
        assert ours.tri is tri and ours.grad.shape == theirs.grad.shape
        assert ours.grad.dtype == theirs.grad.dtype
        assert np.abs(ours.grad - theirs.grad).max() < 1e-10 * np.abs(theirs.grad).max()
        found, expected = ours(x), theirs(x)
        assert found.shape == expected.shape == (4, 500, *shape) and found.dtype == expected.dtype
        assert (np.isnan(found) == np.isnan(expected)).all()
        assert np.nanmax(np.abs(found - expected)) < 1e-10
        assert arguments.get("fill_value") is None or (found == -3).any()


def test_cubic_values_are_scipys_where_the_triangulation_is_the_same(random):
    points, x = random.random((1000, 2)) * [1, 50], random.random((500, 2)) * [1, 50]
    for arguments in [{}, {"rescale": True}]:
        ours, theirs = (
            module.CloughTocher2DInterpolator(points, wave(points), **arguments)(x)
            for module in (netmesh, scipy.interpolate)
        )
        assert (np.isnan(ours) == np.isnan(theirs)).all()
        assert np.nanmax(np.abs(ours - theirs)) < 1e-10


def test_cubic_values_are_scipys_on_flat_triangles(random):
    # Qhull's triangulation of a grid has points that are no vertices, and cocircular ones.
    x, y = np.meshgrid(np.linspace(0, 1, 12), np.linspace(0, 1, 9))
    grid = np.column_stack([x.ravel(), y.ravel()])
    points = np.concatenate([grid, grid[5:6], grid[[0]] + 1e-14])
    tri = scipy.spatial.Delaunay(points)
    at = random.random((2000, 2))
    ours = netmesh.CloughTocher2DInterpolator(tri, wave(points))(at)
    theirs = scipy.interpolate.CloughTocher2DInterpolator(tri, wave(points))(at)
    assert np.abs(ours - theirs).max() < 1e-10


def test_cubics_err_a_tenth_of_what_linear_functions_do(random):
    points, at = random.random((10000, 2)), 0.1 + 0.8 * random.random((10000, 2))
    kinds = netmesh.CloughTocher2DInterpolator, netmesh.LinearNDInterpolator
    cubic, linear = (np.abs(kind(points, wave(points))(at) - wave(at)).mean() for kind in kinds)
    assert cubic < 0.15 * linear and linear < 1e-3


def test_values_at_the_points_and_of_equal_points(random):
    points = random.random((200, 2))
    twice = np.concatenate([points[:7], points])
    z = random.random(207)
    f = netmesh.CloughTocher2DInterpolator(twice, z)
    # In 2 of 3 triangles the weight of another vertex is a rounding, on the vertex it is none.
    assert (f(twice[:7]) == z[:7]).all() and (f(twice[14:]) == z[14:]).all()
    assert (f.grad[7:14] == f.grad[:7]).all()
    g = netmesh.CloughTocher2DInterpolator(points, np.concatenate([z[:7], z[14:]]))
    at = random.random((100, 2))
    assert np.allclose(f(at), g(at), rtol=0, atol=1e-12, equal_nan=True)


def test_gradients_may_be_written_and_survive_a_pickle(random):
    points = random.random((50, 2))
    values = wave(points) + 2j * wave(points[::-1])
    f = netmesh.CloughTocher2DInterpolator(points, values, outside="nearest")
    g = pickle.loads(pickle.dumps(f))
    at = random.random((40, 2)) * 1.5
    assert (f(at) == g(at)).all()
    g.grad[...] = 0
    assert not np.allclose(f(at), g(at))
    theirs = scipy.interpolate.CloughTocher2DInterpolator(scipy.spatial.Delaunay(points), values)
    theirs.grad[...] = 0
    inside = ~np.isnan(theirs(at))
    assert np.allclose(g(at)[inside], theirs(at)[inside], rtol=0, atol=1e-12)


def test_too_few_sweeps_are_told(random):
    points = random.random((500, 2))
    with pytest.warns(netmesh.GradientEstimationWarning, match="maxiter=1 sweeps"):
        netmesh.CloughTocher2DInterpolator(points, wave(points), maxiter=1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        netmesh.CloughTocher2DInterpolator(points, wave(points))


@pytest.mark.parametrize("dim", [2, 3, 4])
def test_linear_values_are_scipys_on_its_triangulation(dim, random):
    points, x = random.random((300, dim)), 1.2 * random.random((1000, dim)) - 0.1
    tri = scipy.spatial.Delaunay(points)
    values = random.random((300, 2)) + 1j * random.random((300, 2))
    ours = netmesh.LinearNDInterpolator(tri, values)(x)
    theirs = scipy.interpolate.LinearNDInterpolator(tri, values)(x)
    assert (np.isnan(ours) == np.isnan(theirs)).all() and np.isnan(ours).any()
    assert np.nanmax(np.abs(ours - theirs)) < 1e-12
    nearest = netmesh.LinearNDInterpolator(tri, values, outside="nearest")
    expected = scipy.interpolate.NearestNDInterpolator(points, values)(x)
    is_outside = np.isnan(theirs[:, 0])
    for f in (nearest, pickle.loads(pickle.dumps(nearest))):
        assert (f(x)[is_outside] == expected[is_outside]).all()


@pytest.mark.parametrize("dim", [2, 3, 5])
def test_a_tolerance_means_what_it_means_to_scipy(dim, random):
    """In a simplex in which barycentric coordinates of the point are from minus the tolerance to 1 and it."""
    points = random.random((60 if dim < 5 else 20, dim))
    points[: 2 * dim] = np.concatenate([np.eye(dim), 1 - np.eye(dim)])
    ours, theirs = netmesh.Delaunay(points), scipy.spatial.Delaunay(points)
    x = random.random((400, dim)) * 1.4 - 0.2
    for tol in (0, 1e-3, 0.1, 0.5):
        found, expected = ours.find_simplex(x, tol=tol), theirs.find_simplex(x, tol=tol, bruteforce=True)
        # SciPy's is also outside if it is farther from the box of the points than the number that the
        # tolerance is.
        is_near = ((x >= points.min(axis=0) - tol) & (x <= points.max(axis=0) + tol)).all(axis=1)
        assert ((found == -1) == (expected == -1))[is_near].all()
        assert (expected[~is_near] == -1).all()
        inside = found != -1
        of = ours.transform[found[inside]]
        first = np.einsum("nij,nj->ni", of[:, :-1], x[inside] - of[:, -1])
        weights = np.column_stack([first, 1 - first.sum(axis=1)])
        assert (weights >= -tol - 1e-9).all() and (weights <= 1 + tol + 1e-9).all() and inside.sum() > 20
    assert (ours.find_simplex(x, tol=0) == ours.find_simplex(x)).all()
    assert (ours.find_simplex(x) == -1).sum() > (ours.find_simplex(x, tol=0.1) == -1).sum() > 0
    near = x[(ours.find_simplex(x) == -1) & (ours.find_simplex(x, tol=0.5) != -1)][0]
    assert (ours.find_simplex([[np.nan] * dim, near], tol=0.5) == -1).tolist() == [True, False]
    assert ours.find_simplex(x.reshape(20, 20, dim), tol=0.1).shape == (20, 20)


def test_the_simplex_that_a_point_is_least_outside_of():
    tri = netmesh.Delaunay([[0, 0], [2, 0], [1, 1], [1, -3]])
    x = [[0.45, 0.5], [1.55, 0.5], [1, -3.01], [1, 9]]
    assert tri.nsimplex == 2 and tri.find_simplex(x).tolist() == [-1] * 4
    upper, lower = tri.find_simplex([[1, 0.5], [1, -0.5]])
    assert tri.find_simplex(x, tol=0.1).tolist() == [upper, upper, lower, -1]


def test_middles_of_hull_edges_have_values(random):
    """They are outside by a rounding in about a quarter of cases."""
    points = random.random((500, 2))
    tri = netmesh.Delaunay(points)
    middles = points[tri.convex_hull].mean(axis=1)
    expected = wave(points)[tri.convex_hull].mean(axis=1)
    is_outside = tri.find_simplex(middles) == -1
    assert is_outside.any()
    linear = netmesh.LinearNDInterpolator(points, wave(points))
    assert np.allclose(linear(middles), expected, rtol=0, atol=1e-12)
    assert not np.isnan(netmesh.CloughTocher2DInterpolator(points, wave(points))(middles)).any()
    exact = netmesh.LinearNDInterpolator(tri, wave(points), tol=0)
    assert (np.isnan(exact(middles)) == is_outside).all()
    exact = netmesh.CloughTocher2DInterpolator(tri, wave(points), simplex_tol=0)
    assert (np.isnan(exact(middles)) == is_outside).all()
    wide = netmesh.LinearNDInterpolator(points, points @ [2, 3], tol=0.5)
    beyond = middles + 0.01 * (middles - 0.5)
    assert np.allclose(wide(beyond), beyond @ [2, 3], rtol=0, atol=1e-12)


def test_values_of_nan_hide_only_what_they_weigh_in():
    corners = np.array([[0, 0], [1, 0], [0, 1.0]])
    for tri in (netmesh.Delaunay(corners), scipy.spatial.Delaunay(corners)):
        f = netmesh.LinearNDInterpolator(tri, [2, 4, np.nan], 7.0)
        found = f([[0, 0], [0.5, 0], [0.5, 0.25], [2, 2]])
        assert found[:2].tolist() == [2, 3] and np.isnan(found[2]) and found[3] == 7


def test_outside_nearest(random):
    points, z = random.random((100, 2)), random.random(100)
    x = np.concatenate([random.random((200, 2)) * 2 - 0.5, [[np.nan, 0.5]]])
    nearest = scipy.interpolate.NearestNDInterpolator(points, z)(x[:-1])
    for kind in (netmesh.LinearNDInterpolator, netmesh.CloughTocher2DInterpolator):
        plain, filled = kind(points, z)(x), kind(points, z, 7.0, outside="nearest")(x)
        outside = np.isnan(plain[:-1])
        assert (filled[:-1][outside] == nearest[outside]).all() and 50 < outside.sum() < 200
        assert (filled[:-1][~outside] == plain[:-1][~outside]).all()
        # No point is the nearest one.
        assert filled[-1] == 7
    twice = np.concatenate([points[:5], points])
    f = netmesh.LinearNDInterpolator(twice, np.concatenate([z[:5], z]), outside="nearest")
    assert (f(x[:-1])[outside] == nearest[outside]).all()


@pytest.mark.parametrize("method", ["linear", "nearest", "cubic"])
@pytest.mark.parametrize("rescale", [False, True])
def test_griddata_is_scipys(method, rescale, random):
    points = random.random((400, 2)) * [1, 30]
    grid = tuple(np.meshgrid(np.linspace(-0.1, 1.1, 30), np.linspace(-1, 31, 20)))
    values = given_values(points, (2,), True, random)
    arguments = {"method": method, "fill_value": -1.0, "rescale": rescale}
    ours = netmesh.griddata(points, values, grid, **arguments)
    theirs = scipy.interpolate.griddata(points, values, grid, **arguments)
    assert ours.shape == theirs.shape == (20, 30, 2) and ours.dtype == theirs.dtype
    assert np.abs(ours - theirs).max() < 1e-10
    filled = netmesh.griddata(points, values, grid, method, rescale=rescale, outside="nearest")
    assert not np.isnan(filled).any()
    again = netmesh.griddata(points, values, grid, method, rescale=rescale, outside="nearest", threads=2)
    assert (filled == again).all()


def test_griddata_of_triangulations_and_of_one_dimension(random):
    points, values, x = random.random((50, 2)), random.random(50), random.random((20, 2))
    for tri, method in itertools.product(
        (netmesh.Delaunay(points), scipy.spatial.Delaunay(points)), ("linear", "nearest", "cubic")
    ):
        expected = scipy.interpolate.griddata(points, values, x, method)
        assert np.allclose(netmesh.griddata(tri, values, x, method), expected, atol=1e-12, equal_nan=True)
    line = np.sort(random.random(9))
    for method in ("linear", "nearest", "cubic"):
        kinds = netmesh.griddata, scipy.interpolate.griddata
        ours, theirs = (kind(line, np.sin(line), line[1:] - 0.01, method) for kind in kinds)
        assert (ours == theirs).all()
    middles = points[netmesh.Delaunay(points).convex_hull].mean(axis=1)
    assert np.isnan(netmesh.griddata(points, values, middles, tol=0)).any()
    assert not np.isnan(netmesh.griddata(points, values, middles)).any()


@pytest.mark.parametrize("dim", [2, 3, 8])
def test_the_nearest_is_scipys(dim, random):
    points, x = random.random((500, dim)), random.random((30, 20, dim))
    values = random.random((500, 2, 1)) + 1j
    for rescale in (False, True):
        ours = netmesh.NearestNDInterpolator(points * np.arange(1, dim + 1), values, rescale)
        theirs = scipy.interpolate.NearestNDInterpolator(points * np.arange(1, dim + 1), values, rescale)
        assert (ours(x) == theirs(x)).all() and ours(x).shape == (30, 20, 2, 1)
        bound = {"distance_upper_bound": 0.08}
        assert np.array_equal(ours(x, **bound, workers=2), theirs(x, **bound), equal_nan=True)
        assert (pickle.loads(pickle.dumps(ours))(x) == ours(x)).all()


def test_the_nearest_of_points_in_a_line_and_of_equal_ones():
    f = netmesh.NearestNDInterpolator([[0, 0], [1, 1], [1, 1], [2, 2]], [1, 2, 3, 4])
    assert f([[0.9, 1.2], [9, 9], [0.5, 0.5]]).tolist() == [2, 4, 1]
    # At the bound itself it is not nearer than that.
    assert np.isnan(f([2, 3], distance_upper_bound=1)).all() and f(2, 3, distance_upper_bound=1.1) == 4


def test_what_is_refused(random):
    points, z = random.random((10, 2)), random.random(10)
    space, line = random.random((10, 3)), random.random((10, 1))
    tri, theirs = netmesh.Delaunay(points), scipy.spatial.Delaunay(points)
    cubic, linear = netmesh.CloughTocher2DInterpolator, netmesh.LinearNDInterpolator
    nearest, griddata = netmesh.NearestNDInterpolator, netmesh.griddata
    not_finite = netmesh.NonFiniteError
    for call, kind, text in [
        (lambda: cubic(space, z), ValueError, r"^points has shape \(10, 3\); it must be \(npoints, 2\)"),
        (lambda: cubic(points, z, tol=-1), ValueError, "^tol is -1; it must be at least 0"),
        (lambda: cubic(points, z, tol="x"), TypeError, "^tol is of type str"),
        (lambda: cubic(points, z, maxiter=-1), ValueError, "^maxiter is -1"),
        (lambda: cubic(points, z, simplex_tol=-1), ValueError, "^simplex_tol is -1.0; it must be"),
        (lambda: cubic(theirs, z, rescale=True), ValueError, "^Rescaling is not supported"),
        (lambda: cubic(theirs, z[:9]), ValueError, r"^values has shape \(9,\); it must be \(10, ...\)"),
        (lambda: cubic(points, z, outside="far"), ValueError, "^outside is 'far'; it must be 'fill' or"),
        (lambda: linear(points, z, tol=np.nan), ValueError, "^tol is nan; it must be at least 0 and finite"),
        (lambda: linear(points, z, tol=np.inf), ValueError, "^tol is inf"),
        (lambda: linear(theirs, z, rescale=True), ValueError, "^Rescaling is not supported"),
        (lambda: tri.find_simplex(points, tol=-1e-9), ValueError, "^tol is -1e-09; it must be at least 0"),
        (lambda: tri.find_simplex(points, tol=[1]), ValueError, r"^tol has shape \(1,\); it must be a"),
        (lambda: griddata(points, z, points, "quintic"), ValueError, "^method is 'quintic'; it must be"),
        (lambda: griddata(space, z, [[0, 0, 0]], "cubic"), ValueError, "^points has shape"),
        (lambda: nearest(line, z), netmesh.DimensionError, r"^x has shape \(10, 1\); points must"),
        (lambda: nearest(np.zeros((0, 2)), []), ValueError, r"^x has shape \(0, 2\)"),
        (lambda: nearest(points, z[:4]), ValueError, r"^y has shape \(4,\)"),
        (lambda: nearest(points, z)([[np.nan, 0]]), not_finite, r"^xi\[0\] has a non-finite coordinate 0"),
        (lambda: nearest(points + [[np.inf, 0]], z), not_finite, r"^x\[0\] has a non-finite coordinate 0"),
        (lambda: nearest(points, z)([0, 0], k=2), TypeError, "^k is no option of a query"),
        (lambda: nearest(points, z)([0, 0], p=1), ValueError, "^p is 1; only 2"),
        (lambda: nearest(points, z)([0, 0], workers=1.5), TypeError, "^workers is of type float"),
        (lambda: nearest(points, z, threads=-1)([0, 0]), ValueError, "^threads is -1"),
    ]:
        with pytest.raises(kind, match=text) as error:
            call()
        assert isinstance(error.value, netmesh.Error)


def test_ctrl_c_ends_an_estimate_of_gradients(random):
    import signal
    import time

    points = random.random((20000, 2))
    tri = netmesh.Delaunay(points)
    signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        netmesh.CloughTocher2DInterpolator(tri, wave(points), tol=0, maxiter=10**8)
    assert time.perf_counter() - start < 5


KINDS = ("LinearNDInterpolator", "CloughTocher2DInterpolator", "NearestNDInterpolator")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("shape", [(30, 0), (30, 2, 0), (30, 0, 2)])
def test_values_without_a_component_have_scipys_shapes(kind, shape, random):
    points, x = random.random((30, 2)), random.random((4, 5, 2))
    for dtype in (float, complex):
        values = np.zeros(shape, dtype)
        ours, theirs = (getattr(module, kind)(points, values) for module in (netmesh, scipy.interpolate))
        assert ours.values.shape == theirs.values.shape
        assert ours(x).shape == theirs(x).shape == (4, 5, *shape[1:])
        assert ours(x).dtype == theirs(x).dtype
        if kind.startswith("Clough"):
            assert ours.grad.shape == theirs.grad.shape and ours.grad.dtype == theirs.grad.dtype
    with pytest.raises(netmesh.InvalidArgumentError, match=r"must be \(30, \.\.\.\), one for each point"):
        getattr(netmesh, kind)(points, np.zeros((29, 0)))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("dtype", ["complex64", "complex128", "float32", "int32", "bool"])
def test_results_have_scipys_types(kind, dtype, random):
    points, x = random.random((30, 2)), 0.3 + 0.4 * random.random((20, 2))
    values = (10 * random.random(30) + (3j if dtype.startswith("c") else 0)).astype(dtype)
    ours, theirs = (getattr(module, kind)(points, values) for module in (netmesh, scipy.interpolate))
    assert ours(x).dtype == theirs(x).dtype
    if dtype.startswith("c"):
        assert ours.values.dtype == theirs.values.dtype
    assert np.allclose(ours(x), theirs(x), rtol=1e-6)

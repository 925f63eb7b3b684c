"""`LinearNDInterpolator` beside SciPy's, and values of a mesh."""

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


@pytest.mark.parametrize("n, dim", [(3000, 2), (1000, 3), (200, 4)])
@pytest.mark.parametrize("shape", [(), (3,), (2, 2)])
@pytest.mark.parametrize("is_complex", [False, True])
def test_the_same_values(n, dim, shape, is_complex, random):
    points, x = random.random((n, dim)), 1.2 * random.random((4, 50, dim)) - 0.1
    values = random.random((n, *shape)) + (1j * random.random((n, *shape)) if is_complex else 0)
    for arguments in [{}, {"fill_value": -3.0}, {"rescale": True}]:
        ours = netmesh.LinearNDInterpolator(points, values, **arguments)(x)
        theirs = scipy.interpolate.LinearNDInterpolator(points, values, **arguments)(x)
        assert ours.shape == theirs.shape == (4, 50, *shape) and ours.dtype == theirs.dtype
        outside = np.isnan(theirs) | (theirs == -3.0)
        assert ((np.isnan(ours) | (ours == -3.0)) == outside).all() and outside.any()
        # SciPy inverts matrices, which loses digits on flat simplices at the hull.
        assert np.abs(np.where(outside, 0, ours - theirs)).max() < 1e-11


def test_every_way_to_give_points(random):
    x, y, z = random.random((3, 40))
    points = np.column_stack([x, y])
    f = netmesh.LinearNDInterpolator((x, y), z)
    g = scipy.interpolate.LinearNDInterpolator((x, y), z)
    for at in [(0.5, 0.5), ([0.4, 0.5], 0.6), ([[0.3, 0.4]],), ([0.3, 0.4],), ((0.5, [0.5, 0.4]),)]:
        assert f(*at).shape == g(*at).shape and np.allclose(f(*at), g(*at), atol=1e-12)
    tri = netmesh.Delaunay(points)
    assert netmesh.LinearNDInterpolator(tri, z).tri is tri
    assert (netmesh.LinearNDInterpolator(tri, z)(points) == z).all()


def test_nan(random):
    points, z = random.random((60, 2)), random.random(60)
    z[7] = np.nan
    f = netmesh.LinearNDInterpolator(points, z, fill_value=5)
    inside = points[f.tri.simplices[(f.tri.simplices == 7).any(axis=1)][0]].mean(axis=0)
    assert np.isnan(f(inside)).all() and f([3, 3]) == 5
    assert f([[np.nan, 0.5], [3, 3], points[3]]).tolist() == [5, 5, z[3]]
    assert np.isnan(netmesh.LinearNDInterpolator(points, z)([[np.nan, 0.5]])[0])


def test_values_of_equal_points_are_the_first_ones(random):
    points, z = random.random((30, 2)), random.random(31)
    f = netmesh.LinearNDInterpolator(np.append(points, points[:1], axis=0), z)
    assert (f(points) == z[:30]).all()


def test_what_is_refused(random):
    points, z = random.random((10, 2)), random.random(10)
    for arguments, text in [
        ((points, z[:9]), r"values has shape \(9,\); it must be \(10, ...\)"),
        ((points, "abc"), "values is an array of"),
        ((np.zeros((2, 2, 2)), z), r"points has shape \(2, 2, 2\)"),
        ((netmesh.Delaunay(points), z, 0.0, True), "Rescaling is not supported"),
    ]:
        with pytest.raises(netmesh.InvalidArgumentError, match=text):
            netmesh.LinearNDInterpolator(*arguments)
    with pytest.raises(ValueError, match="xi has shape"):
        netmesh.LinearNDInterpolator(points, z)([[1, 2, 3]])


@pytest.mark.parametrize("interpolation", ["linear", "sibson", "laplace"])
def test_linear_functions_are_reproduced(interpolation, random):
    m = netmesh.mesh(random.random((300, 3)))
    slope = np.array([[1.0, 2j], [-3, 1], [0.5, 0]])
    x = random.random((5, 20, 3))
    found = m.interpolate(m.points @ slope, x, interpolation=interpolation)
    assert found.shape == (5, 20, 2) and np.allclose(found, x @ slope, rtol=0, atol=1e-11)


def test_outside(random):
    m = netmesh.mesh(random.random((30, 2)), algorithm="delaunay")
    values = random.random(30)
    assert np.isnan(m.interpolate(values, [9, 9]))
    nearest, distance = m.nearest([9, 9])
    assert m.interpolate(values, [9, 9], outside="nearest") == values[nearest]
    assert distance == np.linalg.norm(m.points[nearest] - 9)
    for arguments, text in [
        ({"interpolation": "cubic"}, "^interpolation is 'cubic'; it must be 'linear' or 'sibson'"),
        ({"outside": None}, "^outside is None; it must be 'nan' or 'nearest'"),
    ]:
        with pytest.raises(ValueError, match=text):
            m.interpolate(values, [9, 9], **arguments)
    with pytest.raises(ValueError, match=r"^values has shape \(29,\); it must be \(30, ...\)"):
        m.interpolate(values[:29], [9, 9])
    with pytest.raises(ValueError, match="components is 0"):
        m.interpolate(np.zeros((30, 0)), [9, 9])

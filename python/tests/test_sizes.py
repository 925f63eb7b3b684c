"""Functions that tell sizes, in all the ways that they may be called."""

import pickle

import numpy as np
import pytest

import netmesh

POINTS = np.random.default_rng(7).random((40, 2))
SPACE = np.random.default_rng(8).random((30, 3))


def made(size, points=POINTS):
    return netmesh.mesh(points, size=size, output="well_spaced", extent="hull").points


def of_point(x):
    return 0.1 + 0.2 * float(x[0])


def of_coordinates(x, y):
    return 0.1 + 0.2 * x


def of_coordinates_in_space(x, y, z):
    return 0.3 + 0.2 * z


def of_rows(rows):
    return 0.1 + 0.2 * rows[:, 0]


def test_a_point_its_coordinates_and_rows_of_points_are_asked_alike():
    expected = made(of_point)
    assert len(expected) > 1.5 * len(POINTS)
    for size in (of_coordinates, of_rows, lambda x: 0.1 + 0.2 * x[..., 0], lambda x, scale=0.2: 0.1 + scale * x[0]):
        np.testing.assert_array_equal(made(size), expected)
    in_space = made(lambda x: 0.3 + 0.2 * float(x[2]), SPACE)
    np.testing.assert_array_equal(made(of_coordinates_in_space, SPACE), in_space)
    np.testing.assert_array_equal(made(lambda rows: 0.3 + 0.2 * rows[:, 2], SPACE), in_space)


def test_rows_are_asked_once_for_all_points():
    shapes = []

    def size(rows):
        shapes.append(rows.shape)
        return 0.1 + 0.2 * rows[:, 0]

    found = made(size)
    # A point alone has been tried first.
    assert shapes[:2] == [(2,), POINTS.shape]
    assert set(shapes[2:]) == {(1, 2)} and len(shapes) - 2 < 3 * (len(found) - len(POINTS))


def test_interpolators_are_sizes():
    corners = np.array([[-1, -1], [2, -1], [2, 2], [-1, 2.0]])
    interpolator = netmesh.LinearNDInterpolator(corners, 0.1 + 0.2 * corners[:, 0])
    np.testing.assert_allclose(made(interpolator), made(of_point), atol=1e-12)


def test_a_mesh_with_such_a_size_is_pickled():
    for size in (of_coordinates, of_rows):
        m = netmesh.mesh(POINTS, size=size, output="well_spaced")
        assert m.options["size"] is size
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(m)).points, m.points)


def test_what_a_function_raises_is_raised():
    def fails(x):
        raise LookupError("no size here")

    with pytest.raises(LookupError, match="no size here"):
        made(fails)


@pytest.mark.parametrize("answer", [np.ones(3), np.ones((40, 2)), np.zeros(0)])
def test_answers_of_a_wrong_shape_are_refused(answer):
    with pytest.raises(netmesh.InvalidArgumentError, match="^size answered shape .* for 40 points; it must be"):
        made(lambda x: answer)

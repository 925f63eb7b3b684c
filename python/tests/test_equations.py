"""`Delaunay.equations` and what goes with them beside exact fractions, also where squares are no doubles."""

from fractions import Fraction

import netmesh
import numpy as np
import pytest


def exact(array):
    return np.vectorize(Fraction, otypes=[object])(array)


def solved(rows, right):
    """The solution of linear equations in fractions."""
    rows = [[*row, value] for row, value in zip(rows, right)]
    for column in range(len(rows)):
        pivot = next(at for at in range(column, len(rows)) if rows[at][column] != 0)
        rows[column], rows[pivot] = rows[pivot], rows[column]
        rows[column] = [x / rows[column][column] for x in rows[column]]
        for at, row in enumerate(rows):
            if at != column:
                rows[at] = [x - row[column] * y for x, y in zip(row, rows[column])]
    return [row[-1] for row in rows]


def paraboloid(points):
    """Scale and shift in fractions, as Qhull's option Qbb defines them."""
    squares = [point @ point for point in points]
    low, high = min(squares), Fraction(1.1) * max(squares)
    scale = abs(points).max() / (high - low)
    return scale, -low * scale


def planes(points, simplices):
    """For each simplex the plane through its lifted corners: the height of x is gradient @ x + offset."""
    scale, shift = paraboloid(points)
    for simplex in simplices:
        *others, last = points[simplex]
        gradient = solved([x - last for x in others], [scale * (x @ x - last @ last) for x in others])
        yield gradient, scale * (last @ last) + shift - np.array(gradient) @ last


@pytest.mark.parametrize("dim, n", [(2, 30), (3, 20), (4, 9)])
@pytest.mark.parametrize("exponent", [-1000, -532, 0, 532, 1020])
def test_equations_are_those_of_fractions(dim, n, exponent, random):
    points = np.ldexp(random.normal(size=(n, dim)) / 8, exponent)
    tri = netmesh.Delaunay(points)
    assert np.isfinite(tri.equations).all() and np.isfinite(tri.transform).all()
    assert np.allclose(np.linalg.norm(tri.equations[:, :-1], axis=1), 1, rtol=1e-14)
    given = exact(points)
    scale, shift = paraboloid(given)
    assert tri.paraboloid_scale == pytest.approx(float(scale), rel=1e-14)
    assert tri.paraboloid_shift == pytest.approx(float(shift), rel=1e-14)
    for row, (gradient, offset) in zip(tri.equations, planes(given, tri.simplices)):
        assert row[-2] < 0
        assert row[:-2] / -row[-2] == pytest.approx(list(map(float, gradient)), rel=1e-9, abs=1e-9)
        size = np.ldexp(1.0, exponent)
        assert row[-1] / -row[-2] / size == pytest.approx(float(offset) / size, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("exponent", [-1000, 0, 532, 1020])
def test_positive_distances_are_of_points_in_the_ball(exponent, random):
    points, x = np.ldexp(random.normal(size=(2, 20, 2)), exponent - 3)
    tri, given, asked = netmesh.Delaunay(points), exact(points), exact(x)
    distances = tri.plane_distance(x)
    assert np.isfinite(distances).all()
    for simplex, column in zip(tri.simplices, distances.T):
        last, *others = given[simplex]
        center = np.array(solved([2 * (x - last) for x in others], [x @ x - last @ last for x in others]))
        square = (last - center) @ (last - center)
        assert ((column > 0) == [(q - center) @ (q - center) < square for q in asked]).all()


def test_small_simplices_far_from_the_centre_have_their_planes(random):
    # Heights of their corners agree in nine digits.
    points = np.concatenate([[[0, 0], [4, 0], [0, 4]], 1 + 1e-9 * random.random((6, 2))])
    tri = netmesh.Delaunay(points)
    is_small = (tri.simplices >= 3).all(axis=1)
    assert is_small.sum() > 3
    expected = [list(map(float, gradient)) for gradient, _ in planes(exact(points), tri.simplices[is_small])]
    found = tri.equations[is_small]
    assert np.allclose(found[:, :-2] / -found[:, -2:-1], expected, rtol=1e-12)


def test_one_flat_simplex_makes_no_other_flat():
    points = np.array([[0, 0], [1, 0], [0.5, 1e-17], [0.5, 1]])
    for exponent in (-1000, -600, 0, 600):
        tri = netmesh.Delaunay(np.ldexp(points, exponent))
        assert np.isnan(tri.transform).all(axis=(1, 2)).sum() == 1

"""Locations in meshes that break others: no wrong simplex, and no -1 inside the hull.

Signs are checked with doubles and a bound of their error, undecided ones with fractions.
NETMESH_QUERIES points are located in each mesh.
"""

import os
from fractions import Fraction

import netmesh
import numpy as np
import pytest

QUERIES = int(os.environ.get("NETMESH_QUERIES", 5_000))


def uniform(dim):
    return np.random.default_rng(dim).random((3000, dim))


def two_skew_lines():
    x = np.random.default_rng(1).random(60)
    zero, one = np.zeros(60), np.ones(60)
    return np.concatenate([np.column_stack([x, zero, zero]), np.column_stack([zero, x, one])])


def moved_grid(dim, side):
    axes = np.meshgrid(*[np.linspace(0, 1, side)] * dim)
    grid = np.stack(axes, axis=-1).reshape(-1, dim)
    return np.nextafter(grid, np.random.default_rng(dim).choice([-9, 9], grid.shape))


def nested():
    """Scales from 2^-900 to 2^900."""
    random = np.random.default_rng(5)
    return np.concatenate(
        [np.ldexp(random.random((4, 2)) - 0.5, scale) for scale in range(-900, 901, 60)]
    )


MESHES = {
    "uniform 2D": (uniform(2), "delaunay"),
    "uniform 3D": (uniform(3), "delaunay"),
    "uniform 4D": (uniform(4)[:600], "delaunay"),
    "skew lines": (two_skew_lines(), "delaunay"),
    "moved grid 2D": (moved_grid(2, 30), "delaunay"),
    "moved grid 3D": (moved_grid(3, 9), "delaunay"),
    "nested": (nested(), "netmesh"),
    "nested, inputs alone": (nested(), "delaunay"),
    "finished 2D": (uniform(2), "well_spaced"),
    "finished 3D": (uniform(3)[:500], "well_spaced"),
}


def orientations(corners, x):
    """Signs of the simplices (rows of d corners) with x in the place of each one left out."""
    d = x.shape[-1]
    rows = corners - x[:, None]
    with np.errstate(all="ignore"):
        signs = np.linalg.det(rows)
        bounds = 1e-13 * np.prod(np.linalg.norm(rows, axis=2), axis=1)
    # Squares of tiny numbers are lost, those of huge ones too.
    sound = (bounds > 1e-250) & (bounds < 1e250) & (np.abs(signs) > bounds)
    signs = np.sign(signs, where=sound, out=np.zeros(len(signs)))
    for i in np.flatnonzero(~sound):
        signs[i] = exact_sign([[Fraction(a) - Fraction(b) for a, b in zip(row, x[i])]
                               for row in corners[i].tolist()], d)
    return signs


def exact_sign(rows, d):
    sign = 1
    for column in range(d):
        pivot = next((i for i in range(column, d) if rows[i][column] != 0), None)
        if pivot is None:
            return 0
        if pivot != column:
            rows[pivot], rows[column] = rows[column], rows[pivot]
            sign = -sign
        sign = sign if rows[column][column] > 0 else -sign
        for i in range(column + 1, d):
            factor = rows[i][column] / rows[column][column]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[column])]
    return sign


def queries(m, inputs, count):
    """Random points, vertices, points on edges and faces, and those next to the hull."""
    random = np.random.default_rng(7)
    low, high = inputs.min(axis=0), inputs.max(axis=0)
    box = low + (high - low) * (1.1 * random.random((count, m.dim)) - 0.05)
    weights = random.dirichlet(np.ones(m.dim + 1), count // 4)
    weights[::3, 0], weights[1::3, :2] = 0, 0
    weights /= weights.sum(axis=1, keepdims=True)
    picked = random.integers(len(m.simplices), size=len(weights))
    faces = np.einsum("ni,nij->nj", weights, m.points[m.simplices[picked]])
    hull = m.points[m.hull.vertices].mean(axis=1)
    beside = np.nextafter(hull, hull.mean(axis=0)), np.nextafter(hull, 2 * hull)
    x = np.concatenate([box, faces, m.points, hull, *beside])
    return random.permutation(x)[:count]


@pytest.mark.parametrize("name", MESHES)
def test_every_point_is_where_it_is_said_to_be(name):
    inputs, kind = MESHES[name]
    options = {"output": kind} if kind == "well_spaced" else {"algorithm": kind}
    m = netmesh.mesh(inputs, **options)
    x = queries(m, inputs, min(QUERIES, 1000) if name.startswith("nested") else QUERIES)
    found = m.locate(x)
    inside = found != -1
    assert inside.any() and (~inside).any()
    # Inside: no sign of the simplex with the point in a corner's place is negative.
    corners = m.points[m.simplices[found[inside]]]
    for i in range(m.dim + 1):
        signs = orientations(np.delete(corners, i, axis=1), x[inside])
        assert ((-1) ** i * signs >= 0).all()
    # Outside: beyond a facet of the hull. The farthest is tried first.
    facets, outside = m.points[m.hull.vertices], x[~inside]
    for start in range(0, len(outside), 1000):
        some = outside[start : start + 1000]
        assert all(is_beyond_one(facets, point) for point in some)


def is_beyond_one(facets, point):
    rows = facets - point
    with np.errstate(all="ignore"):
        signs = np.linalg.det(rows)
        bounds = 1e-13 * np.prod(np.linalg.norm(rows, axis=2), axis=1)
        far = np.argmin(np.where(bounds > 1e-250, signs / bounds, np.inf))
        if 1e-250 < bounds[far] < 1e250 and signs[far] < -bounds[far]:
            return True
    return (orientations(facets, np.broadcast_to(point, facets[:, 0].shape)) < 0).any()

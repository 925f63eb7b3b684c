"""Histograms of the quality, beside NumPy's of all values."""

import itertools

import netmesh
import numpy as np
import pytest


def counted(m, hull):
    """Mask of the simplices that count."""
    on_hull = np.zeros(len(m.points), dtype=bool)
    on_hull[m.hull.vertices] = True
    return np.full(len(m.simplices), hull) | ~on_hull[m.simplices].any(axis=1)


def angles(m, hull):
    """All angles between facets, by the gradients of barycentric coordinates."""
    corners = m.points[m.simplices[counted(m, hull)]]
    gradients = np.linalg.inv(corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1)
    gradients = np.concatenate([-gradients.sum(axis=1, keepdims=True), gradients], axis=1)
    gradients /= np.linalg.norm(gradients, axis=2, keepdims=True)
    i, j = np.triu_indices(m.dim + 1, 1)
    cosines = -(gradients @ gradients.transpose(0, 2, 1))[:, i, j]
    return np.degrees(np.arccos(cosines.clip(-1, 1)))


def ratios(m, hull):
    """Circumradius over shortest edge."""
    corners = m.points[m.simplices[counted(m, hull)]]
    pairs = itertools.combinations(range(m.dim + 1), 2)
    edges = [np.linalg.norm(corners[:, i] - corners[:, j], axis=1) for i, j in pairs]
    return m.circumradii[counted(m, hull)] / np.min(edges, axis=0)


@pytest.mark.parametrize("hull", [False, True])
@pytest.mark.parametrize("dim, n", [(2, 200), (3, 100), (4, 10)])
def test_counts_are_numpys(dim, n, hull, random):
    m = netmesh.mesh(random.random((n, dim)))
    all_angles = angles(m, hull)
    # Cages are symmetric: no edge is at an angle that is theirs, as 60 and 90 degrees are.
    for measure, values, given in [
        ("dihedral_angle", all_angles, {"bins": 17, "range": (0, 180)}),
        ("dihedral_angle", all_angles, {"bins": [10.5, 33, 60.1, 95]}),
        ("smallest_angle", all_angles.min(axis=1), {"bins": 7, "range": (0, 90)}),
        ("radius_edge", ratios(m, hull), {"bins": 7, "range": (0.5, 1.9)}),
    ]:
        counts, edges = m.quality_histogram(measure, hull=hull, **given)
        expected, expected_edges = np.histogram(values, **given)
        assert (edges == expected_edges).all() and edges.dtype == np.float64
        assert (counts == expected).all() and counts.dtype == np.int64
        assert counts.sum() > 0


def test_defaults_hold_all_values(random):
    m = netmesh.mesh(random.random((100, 3)))
    count = counted(m, False).sum()
    counts, edges = m.quality_histogram()
    assert counts.sum() == 6 * count and (edges == np.arange(0, 181, 10)).all()
    counts, edges = m.quality_histogram("smallest_angle")
    assert counts.sum() == count and edges[0] == 0 and edges[-1] == 90 and len(counts) == 18
    counts, edges = m.quality_histogram("radius_edge")
    assert counts.sum() == count and edges[-1] == m.quality().worst_radius_edge
    counts, edges = m.quality_histogram("aspect", bins=5)
    assert len(counts) == 5 and edges[-1] == m.quality().worst_aspect_anywhere
    assert counts.sum() == (m.vertex_domains >= 0).sum() - (m.kinds == 2).sum() + len(m.domains) - 1


def test_a_triangle_has_no_simplex_off_the_hull():
    m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
    counts, edges = m.quality_histogram("radius_edge")
    assert counts.sum() == 0 and (edges[0], edges[-1]) == (0, 1)
    assert m.quality_histogram(bins=[44, 46, 89, 91], hull=True)[0].tolist() == [2, 0, 1]


def test_bad_arguments(random):
    m = netmesh.mesh(random.random((20, 2)))
    with pytest.raises(netmesh.InvalidArgumentError, match="measure is 'angle'; it must be"):
        m.quality_histogram("angle")
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^bins\[1\] is 1.0; it must be above"):
        m.quality_histogram(bins=[2, 1])
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^bins\[0\] is nan"):
        m.quality_histogram(bins=[np.nan, 1])
    with pytest.raises(netmesh.InvalidArgumentError, match=r"bins has shape \(1,\)"):
        m.quality_histogram(bins=[1])
    with pytest.raises(ValueError, match="bins"):
        m.quality_histogram(bins=0)
    with pytest.raises(TypeError):
        m.quality_histogram(bins="auto")

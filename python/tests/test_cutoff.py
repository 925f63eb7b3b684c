"""`cutoff` of `mesh`: points that are merged before they are meshed."""

import pickle

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


def pairs_nearer(points, cutoff):
    return set(map(tuple, scipy.spatial.cKDTree(points).query_pairs(cutoff * (1 - 1e-12), output_type="ndarray").tolist()))


@pytest.mark.parametrize("dim", [2, 3, 5])
def test_a_cutoff_merges_points(dim, random):
    points = random.random((150, dim))
    points[100:110] = points[:10]
    cutoff = 0.1 if dim < 5 else 0.3
    m = netmesh.mesh(points, cutoff=cutoff, seed=1)
    assert (m.representatives == netmesh.representatives(points, cutoff)).all()
    assert len(set(m.representatives.tolist())) < 140 and m.representatives.dtype == np.int32
    assert (m.points[m.input_vertices] == points[m.representatives]).all()
    is_input = m.kinds == netmesh.VertexKind.INPUT
    assert (m.points[is_input] == points[m.representatives[m.vertex_inputs[is_input]]]).all()
    assert not pairs_nearer(m.points[is_input], cutoff)
    # The mesh is that of the points that stand for others, in their order.
    chosen = points[list(dict.fromkeys(m.representatives.tolist()))]
    assert (netmesh.mesh(chosen, seed=1).simplices == m.simplices).all()
    again = pickle.loads(pickle.dumps(m))
    assert (again.representatives == m.representatives).all() and (again.points == m.points).all()


def test_without_a_cutoff_points_stand_for_their_equals(random):
    points = random.random((30, 2))
    points[10:20] = points[:10]
    m = netmesh.mesh(points)
    assert m.representatives.tolist() == [*range(10), *range(10), *range(20, 30)]
    with pytest.raises(ValueError, match="read-only"):
        m.representatives[0] = 3


def test_ends_of_segments_stay_and_points_near_them_are_merged_with_them(random):
    ring = np.array([[0, 0], [1, 0], [1.02, 0], [1, 1], [0, 1.0]])
    near = np.array([[0.03, 0.01], [0.98, 0.96]])
    points = np.concatenate([near, random.random((300, 2)), ring])
    first = len(points) - len(ring)
    segments = first + np.array([[0, 1], [1, 2], [2, 3], [3, 4], [4, 0]])
    m = netmesh.mesh(points, segments, cutoff=0.05, markers=[1, 2, 3, 4, 5])
    assert m.representatives[first:].tolist() == list(range(first, len(points)))
    assert m.representatives[:2].tolist() == [first, first + 3]
    assert (m.points[m.input_vertices[first:]] == ring).all()
    assert set(m.segment_markers.tolist()) == {1, 2, 3, 4, 5}
    kept = np.unique(m.representatives)
    close = pairs_nearer(points[kept], 0.05)
    assert {tuple(kept[[a, b]] - first) for a, b in close} == {(1, 2)}
    # Points on the other side of the ring's sides count as outside ones do.
    equal = np.concatenate([ring, ring[:2], [[0.5, 0.5]]])
    m = netmesh.mesh(equal, [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [6, 2]], cutoff=0.01)
    assert m.representatives.tolist() == [0, 1, 2, 3, 4, 0, 1, 7]


def test_corners_of_facets_stay(random):
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1.0)])
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    points = np.concatenate([0.02 + 0.96 * random.random((200, 3)), corners])
    m = netmesh.mesh(points, facets=200 + np.array(sides), cutoff=0.3)
    assert m.representatives[200:].tolist() == list(range(200, 208))
    assert (m.representatives[:200] >= 200).any()
    assert (m.points[m.input_vertices[200:]] == corners).all()
    assert m.volumes.sum() == pytest.approx(1, rel=1e-12)


def test_the_least_size_of_merged_points_counts():
    points = np.array([[0, 0], [0.01, 0], [1, 0], [0, 1], [1, 1]])
    sizes = np.array([1, 0.05, 1, 1, 1])
    m = netmesh.mesh(points, cutoff=0.1, size=sizes)
    assert m.sizes[m.input_vertices].tolist() == [0.05, 0.05, 1, 1, 1]
    assert m.options["size"].tolist() == sizes.tolist()
    again = pickle.loads(pickle.dumps(m))
    assert (again.points == m.points).all() and len(m.points) > 20
    m = netmesh.mesh(points, cutoff=0.1, size=lambda x: 0.5)
    assert set(m.sizes[m.input_vertices].tolist()) == {0.5}


@pytest.mark.parametrize(
    "cutoff, kind, text",
    [
        (-1, "InvalidArgument", "^cutoff is -1.0; it must be at least 0 and finite"),
        (np.inf, "InvalidArgument", "^cutoff is inf; it must be at least 0 and finite"),
        (np.nan, "InvalidArgument", "^cutoff is nan; it must be at least 0 and finite"),
        ("0.1", "ArgumentType", "^cutoff is of type str; it must be a number"),
        (3, "DegenerateInput", "distinct"),
    ],
)
def test_wrong_cutoffs_are_refused(cutoff, kind, text):
    with pytest.raises(getattr(netmesh, f"{kind}Error"), match=text):
        netmesh.mesh([[0, 0], [1, 0], [0, 1]], cutoff=cutoff)


def test_points_are_named_by_their_own_numbers_with_a_cutoff():
    with pytest.raises(netmesh.NonFiniteError, match=r"^points\[2\] has a non-finite coordinate 1: nan"):
        netmesh.mesh([[0, 0], [1, 0], [0, np.nan]], [[0, 1]], cutoff=0.1)
    with pytest.raises(netmesh.InvalidArgumentError, match=r"segments\[0\] has the end 7"):
        netmesh.mesh([[0, 0], [1, 0], [0, 1]], [[0, 7]], cutoff=0.1)

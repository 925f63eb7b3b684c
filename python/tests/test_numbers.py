"""Whose numbers answers have where points are given twice: beside SciPy's and GUDHI's."""

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


def repeated(random, n, dim):
    """Points of which about half repeat an earlier one, in a random order."""
    points = random.random((n, dim))
    return points[np.concatenate([np.arange(n), random.integers(n, size=n)])][random.permutation(2 * n)]


def firsts(points):
    """Number of the first point that equals each."""
    _, first, inverse = np.unique(points, axis=0, return_index=True, return_inverse=True)
    return first[inverse.reshape(-1)]


@pytest.mark.parametrize("options", [{}, {"algorithm": "delaunay"}, {"output": "well_spaced"}])
@pytest.mark.parametrize("dim", [2, 3])
def test_inputs_and_vertices_are_inverse(dim, options, random):
    points = repeated(random, 40, dim)
    m = netmesh.mesh(points, **options)
    of_inputs, of_vertices, first = m.input_vertices, m.vertex_inputs, firsts(points)
    is_input = m.kinds == netmesh.VertexKind.INPUT
    assert of_vertices.shape == (len(m.points),) and of_vertices.dtype == np.int32
    assert ((of_vertices >= 0) == is_input).all() and is_input.sum() == 40
    assert (of_inputs[of_vertices[is_input]] == np.flatnonzero(is_input)).all()
    assert (of_vertices[of_inputs] == first).all()
    assert (points[of_vertices[is_input]] == m.points[is_input]).all()
    assert (np.diff(of_vertices[is_input]) > 0).all()


@pytest.mark.parametrize("dim", [2, 3, 4])
def test_the_nearest_input_is_that_of_scipy(dim, random):
    points = repeated(random, 30, dim)
    for options in [{}, {"algorithm": "delaunay"}]:
        m = netmesh.mesh(points, **options)
        x = 2 * random.random((300, dim)) - 0.5
        found, lengths = m.nearest(x, among="inputs", threads=2)
        distances, theirs = scipy.spatial.cKDTree(points).query(x)
        assert (points[found] == points[theirs]).all() and np.allclose(lengths, distances, rtol=1e-15)
        assert (found == firsts(points)[theirs]).all()
        vertices, _ = m.nearest(x)
        assert (vertices == scipy.spatial.cKDTree(m.points).query(x)[1]).all()
    # The first of inputs that are equally near.
    square = [[1, 1], [0, 0], [1, 0], [0, 0], [0, 1], [1, 1]]
    m = netmesh.mesh(square, algorithm="delaunay")
    assert m.nearest([[0.5, 0.5], [0, 0], [1, 0.5]], among="inputs")[0].tolist() == [0, 1, 0]


def test_delaunay_with_duplicates_is_scipys(random):
    points = repeated(random, 50, 2)
    ours, theirs = netmesh.Delaunay(points), scipy.spatial.Delaunay(points)
    first = firsts(points)
    rows = lambda simplices: {frozenset(row) for row in first[simplices].tolist()}
    assert rows(ours.simplices) == rows(theirs.simplices)
    # Qhull leaves out the same number of points, if others of those that are equal.
    assert len(ours.coplanar) == len(theirs.coplanar) == 50
    assert (first[ours.coplanar[:, 0]] == ours.coplanar[:, 2]).all()
    assert (first[ours.simplices] == ours.simplices).all()
    mesh = ours.mesh
    assert (mesh.vertex_inputs[mesh.simplices] == ours.simplices).all()


def gudhis(points):
    """The alpha complex of GUDHI, with the first of equal points for each vertex."""
    gudhi = pytest.importorskip("gudhi")
    tree = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
    first = firsts(points)
    # The tree must live as long as what it answers.
    return {tuple(sorted(first[face].tolist())): value for face, value in tree.get_simplices()}


@pytest.mark.parametrize("dim", [2, 3])
def test_an_alpha_filtration_is_gudhis_of_the_callers_points(dim, random, tmp_path):
    points = repeated(random, 25, dim)
    alpha = netmesh.mesh(points, algorithm="delaunay").filtration("alpha")
    expected = gudhis(points)
    assert (alpha.points == points).all() and not alpha.points.flags.writeable
    found = {
        tuple(face): value
        for k in range(dim + 1)
        for face, value in zip(alpha.faces(k).tolist(), alpha.values(k).tolist())
    }
    tree = alpha.to_gudhi()
    of_tree = {tuple(sorted(face)): value for face, value in tree.get_simplices()}
    alpha.export(tmp_path / "a.filtration")
    lines = [line.split() for line in (tmp_path / "a.filtration").read_text().splitlines()]
    of_file = {tuple(sorted(map(int, line[1:-1]))): float(line[-1]) for line in lines}
    for each in (found, of_tree, of_file):
        assert each.keys() == expected.keys()
        assert all(np.isclose(each[face], expected[face], rtol=1e-15, atol=0) for face in each)
    # Faces are ascending and sorted in these numbers too, and boundaries fit.
    for k in range(1, dim + 1):
        faces = alpha.faces(k)
        assert (np.diff(faces, axis=1) > 0).all() and faces.tolist() == sorted(faces.tolist())
        for i in range(k + 1):
            assert (alpha.faces(k - 1)[alpha.facets(k)[:, i]] == np.delete(faces, i, 1)).all()


def test_alpha_shapes_are_of_the_callers_points(random):
    points = repeated(random, 60, 3)
    once = points[np.unique(firsts(points))]
    shape = netmesh.mesh(points, algorithm="delaunay").filtration("alpha").shape("optimal")
    alone = netmesh.mesh(once, algorithm="delaunay").filtration("alpha").shape("optimal")
    assert (shape.points == points).all() and (alone.points == once).all()
    assert (shape.points[shape.boundary] == alone.points[alone.boundary]).all()
    assert (firsts(points)[shape.boundary] == shape.boundary).all()
    a, b, c = points[shape.boundary].transpose(1, 0, 2)
    assert np.isclose(np.einsum("ij,ij->", a, np.cross(b, c)) / 6, shape.volume, rtol=1e-12)


def test_a_mesh_filtration_is_of_vertices(random):
    m = netmesh.mesh(repeated(random, 20, 2), output="well_spaced")
    near = m.filtration("mesh")
    assert (near.points == m.points).all()
    assert (near.faces(0).ravel() == np.arange(len(m.points))).all()
    assert {tuple(sorted(s)) for s in m.simplices.tolist()} == set(map(tuple, near.faces(2).tolist()))


def test_values_of_inputs_go_with_the_callers_numbers(random):
    points = repeated(random, 30, 2)
    values = random.random(60)
    m = netmesh.mesh(points)
    of_vertices = m.extend_values(values)
    is_input = m.vertex_inputs >= 0
    assert (of_vertices[is_input] == values[m.vertex_inputs[is_input]]).all()
    f = netmesh.LinearNDInterpolator(points, values)
    assert (f(points) == values[firsts(points)]).all()

"""The program that measures conditioning, on matrices that are known."""

import importlib.util

import netmesh
import numpy as np
import pytest
from checkout import needed

pytest.importorskip("scipy")


@pytest.fixture(scope="module")
def conditioning():
    path = needed("python", "benchmarks", "conditioning.py")
    spec = importlib.util.spec_from_file_location("conditioning", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_matrices_of_single_simplices(conditioning):
    triangle = conditioning.stiffness(np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1, 2]]))
    expected = np.array([[2, -1, -1], [-1, 1, 0], [-1, 0, 1]]) / 2
    assert np.allclose(triangle.toarray(), expected)
    corner = np.concatenate([np.zeros((1, 3)), 2 * np.eye(3)])
    tetrahedron = conditioning.stiffness(corner, np.array([[3, 1, 0, 2]]))
    expected = np.diag([3.0, 1, 1, 1])
    expected[0, 1:] = expected[1:, 0] = -1
    # Eight times the volume, a quarter of the squared gradients.
    assert np.allclose(tetrahedron.toarray(), expected / 3)
    assert np.allclose(conditioning.loads(corner, np.array([[3, 1, 0, 2]])), 8 / 6 / 4)


def grid(n):
    """The unit square in (n + 1)^2 squares of two triangles each."""
    axis = np.linspace(0, 1, n + 2)
    points = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    corner = (np.arange(n + 1)[:, None] * (n + 2) + np.arange(n + 1)).ravel()
    right, up = corner + n + 2, corner + 1
    lower = np.stack([corner, right, up], axis=1)
    upper = np.stack([right, right + 1, up], axis=1)
    return points, np.concatenate([lower, upper])


def test_a_grid_is_the_five_point_stencil(conditioning):
    n = 12
    points, triangles = grid(n)
    inner = conditioning.inner_vertices(points, triangles)
    assert len(inner) == n * n and ((points[inner] > 0) & (points[inner] < 1)).all()
    matrix = conditioning.stiffness(points, triangles)[inner][:, inner]
    line = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    stencil = np.kron(line, np.eye(n)) + np.kron(np.eye(n), line)
    assert np.allclose(matrix.toarray(), stencil)
    eigenvalue, plain, jacobi = conditioning.measure(points, triangles)
    assert np.isclose(eigenvalue, 4 + 4 * np.cos(np.pi / (n + 1)), rtol=1e-5)
    # The diagonal is 4 everywhere, and changes nothing.
    assert plain == jacobi and 10 < plain < n * n
    right = conditioning.loads(points, triangles)[inner]
    assert np.allclose(right, 1 / (n + 1) ** 2)
    steps, solution = conditioning.iterations(matrix, right)
    assert steps == plain and np.allclose(solution, np.linalg.solve(stencil, right), rtol=1e-6)
    # The largest value of -div grad u = 1 in the unit square is 0.0737.
    assert abs(solution.max() - 0.0737) < 0.002


def test_conjugate_gradients_end_after_as_many_steps_as_there_are_eigenvalues(conditioning):
    matrix, right = np.diag([1.0, 1, 4, 4, 9]), np.arange(1.0, 6)
    steps, solution = conditioning.iterations(matrix, right)
    assert steps == 3 and np.allclose(solution, right / np.diag(matrix))
    assert conditioning.iterations(matrix, right, 1 / np.diag(matrix))[0] == 1


def test_simplices_beyond_the_inputs_are_left_out(conditioning):
    points = np.array([[0.0, 0], [2, 0], [0, 2], [1, 1], [3, 3]])
    triangles = np.array([[0, 1, 3], [1, 4, 3], [2, 0, 3]])
    assert conditioning.within_inputs(points, triangles, 3).tolist() == [[0, 1, 3], [2, 0, 3]]


def test_files_are_read(conditioning, random, tmp_path):
    m = netmesh.mesh(random.random((60, 3)), output="well_spaced")
    m.export(tmp_path / "mesh.node")
    points, simplices = conditioning.read(tmp_path / "mesh.node")
    assert (points == m.points).all() and (simplices == m.simplices).all()
    inner = conditioning.inner_vertices(points, simplices)
    assert set(inner) == set(range(len(points))) - set(m.hull.vertices.ravel())
    eigenvalue, plain, jacobi = conditioning.measure(points, simplices)
    assert eigenvalue > 0 and jacobi <= plain

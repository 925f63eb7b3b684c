"""Worth of a mesh to those who solve on it:

    python conditioning.py [--inputs N] MESH.node [MESH.node ...]

Of each mesh (TetGen's files, .node with the .ele beside it, in 2D or 3D): the P1 stiffness matrix of
the Laplacian with zero on the hull, its largest eigenvalue, and the iterations that conjugate gradients
take on -div grad u = 1 until the residual is a part of 1e-8 of the right-hand side, without and with
Jacobi's preconditioner. Slivers make the eigenvalue and both counts large; in 3D so do long edges.
With --inputs only the simplices in the box of the first N vertices, the inputs, are a mesh.
"""

import argparse
import math
import pathlib

import numpy as np
import scipy.sparse
import scipy.sparse.linalg


def volumes_and_gradients(points, simplices):
    """Volumes of simplices, and the gradients of their barycentric coordinates, a row for each."""
    corners = points[simplices]
    edges = corners[:, 1:] - corners[:, :1]
    gradients = np.linalg.inv(edges).transpose(0, 2, 1)
    first = -gradients.sum(axis=1, keepdims=True)
    dim = points.shape[1]
    volumes = np.abs(np.linalg.det(edges)) / math.factorial(dim)
    return volumes, np.concatenate([first, gradients], axis=1)


def stiffness(points, simplices):
    """The matrix of the integrals of grad u . grad v, for the hat functions of all vertices."""
    volumes, gradients = volumes_and_gradients(points, simplices)
    entries = volumes[:, None, None] * (gradients @ gradients.transpose(0, 2, 1))
    width = simplices.shape[1]
    rows = np.repeat(simplices, width, axis=1).ravel()
    columns = np.tile(simplices, width).ravel()
    shape = (len(points), len(points))
    return scipy.sparse.coo_matrix((entries.ravel(), (rows, columns)), shape=shape).tocsr()


def loads(points, simplices):
    """The integrals of the hat functions."""
    volumes, _ = volumes_and_gradients(points, simplices)
    width = simplices.shape[1]
    return np.bincount(
        simplices.ravel(), np.repeat(volumes / width, width), minlength=len(points)
    )


def inner_vertices(points, simplices):
    """The vertices that are in a simplex and on no facet of a single one."""
    width = simplices.shape[1]
    facets = [np.delete(simplices, apex, axis=1) for apex in range(width)]
    facets = np.sort(np.concatenate(facets), axis=1)
    facets, counts = np.unique(facets, axis=0, return_counts=True)
    is_inner = np.zeros(len(points), dtype=bool)
    is_inner[simplices] = True
    is_inner[facets[counts == 1]] = False
    return np.flatnonzero(is_inner)


def largest_eigenvalue(matrix):
    """Largest eigenvalue of a symmetric matrix, to six digits."""
    start = np.random.default_rng(1).random(matrix.shape[0])
    found = scipy.sparse.linalg.eigsh(matrix, k=1, which="LA", v0=start, tol=1e-6)
    return float(found[0][0])


def iterations(matrix, right, inverse_diagonal=None, part=1e-8):
    """Number of steps that conjugate gradients take from zero, and what they find."""
    scale = np.ones(len(right)) if inverse_diagonal is None else inverse_diagonal
    solution, residual = np.zeros(len(right)), right.copy()
    direction = scale * residual
    product = residual @ direction
    goal = part * np.linalg.norm(right)
    for step in range(10 * len(right)):
        if np.linalg.norm(residual) <= goal:
            return step, solution
        image = matrix @ direction
        length = product / (direction @ image)
        solution += length * direction
        residual -= length * image
        scaled = scale * residual
        product, last = residual @ scaled, product
        direction = scaled + product / last * direction
    raise RuntimeError("conjugate gradients do not converge")


def measure(points, simplices):
    """The largest eigenvalue, and the iterations without and with Jacobi's preconditioner."""
    inner = inner_vertices(points, simplices)
    matrix = stiffness(points, simplices)[inner][:, inner]
    right = loads(points, simplices)[inner]
    plain, _ = iterations(matrix, right)
    jacobi, _ = iterations(matrix, right, 1 / matrix.diagonal())
    return largest_eigenvalue(matrix), plain, jacobi


def read(path):
    """Points and simplices of a pair of files that TetGen, or this library, wrote."""
    path = pathlib.Path(path)
    nodes = np.loadtxt(path, skiprows=1, ndmin=2)
    dim = int(path.read_text().split(None, 2)[1])
    elements = np.loadtxt(path.with_suffix(".ele"), dtype=np.int64, skiprows=1, ndmin=2)
    first = int(nodes[0, 0])
    return nodes[:, 1 : dim + 1], elements[:, 1 : dim + 2] - first


def within_inputs(points, simplices, count):
    """The simplices all of whose vertices are in the box of the first vertices."""
    low, high = points[:count].min(axis=0), points[:count].max(axis=0)
    is_inside = ((low <= points) & (points <= high)).all(axis=1)
    return simplices[is_inside[simplices].all(axis=1)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--inputs", type=int, metavar="N")
    parser.add_argument("meshes", nargs="+", metavar="MESH.node")
    arguments = parser.parse_args()
    print(f"{'':32} {'unknowns':>9} {'largest eigenvalue':>19} {'CG':>6} {'with Jacobi':>12}")
    for path in arguments.meshes:
        points, simplices = read(path)
        if arguments.inputs:
            simplices = within_inputs(points, simplices, arguments.inputs)
        eigenvalue, plain, jacobi = measure(points, simplices)
        print(f"{path:32} {len(inner_vertices(points, simplices)):9} {eigenvalue:19.6g} {plain:6} {jacobi:12}", flush=True)


if __name__ == "__main__":
    main()

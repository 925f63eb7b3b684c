"""Poisson's equation on an L, on meshes that follow the error: adaptive.py [ROUNDS]

Needs netmesh and scikit-fem.
"""
import sys

import netmesh
import numpy as np
import skfem
from skfem.models.poisson import laplace, unit_load

L = netmesh.domain([(-1, -1), (0, -1), (0, 0), (1, 0), (1, 1), (-1, 1)])
#: The square of the energy norm of the solution of -div grad u = 1, u = 0 at the boundary.
ENERGY = 0.2140758036


def solve(mesh):
    """Return the solution at the vertices, and the square of its energy norm."""
    basis = skfem.Basis(mesh.to_skfem(), skfem.ElementTriP1())
    stiffness, load = laplace.assemble(basis), unit_load.assemble(basis)
    boundary = np.unique(mesh.hull.vertices)
    u = skfem.solve(*skfem.condense(stiffness, load, D=boundary))
    return u, float(load @ u)


def indicators(mesh, u):
    """Return for each triangle the root of the load's part of the error plus the jumps of the gradient."""
    corners = mesh.points[mesh.simplices]
    edges = np.roll(corners, 1, axis=1) - np.roll(corners, -1, axis=1)  # opposite each corner, clockwise
    turned = np.stack([-edges[..., 1], edges[..., 0]], axis=-1) / (-2 * mesh.volumes[:, None, None])
    gradients = np.einsum("tk,tkd->td", u[mesh.simplices], turned)
    lengths = np.linalg.norm(edges, axis=2)
    others = gradients[mesh.neighbors]
    jumps = np.where(mesh.neighbors >= 0, np.einsum("tkd,tkd->tk", gradients[:, None] - others, edges[..., ::-1] * [1, -1]), 0)
    return np.sqrt(lengths.max(axis=1) ** 2 * mesh.volumes + (jumps**2).sum(axis=1) / 2)


# [adapt]
def adapt(mesh, u):
    """Return a mesh of the same domain whose triangles are small where the error is large."""
    error = indicators(mesh, u)
    longest = mesh.circumradii * np.sqrt(3)
    wanted = longest * np.sqrt(0.5 * np.median(error) / error).clip(0.25, 1)
    sizes = np.full(len(mesh.points), np.inf)
    np.minimum.at(sizes, mesh.simplices, wanted[:, None])
    return netmesh.mesh(L, min_angle=28, background=(mesh, sizes))
# [end]


def main(rounds=6):
    """Return the numbers of vertices and the errors in the energy, round by round."""
    mesh = netmesh.mesh(L, min_angle=28, max_edge=0.5)
    found = []
    for _ in range(rounds):
        u, energy = solve(mesh)
        found.append((len(mesh.points), ENERGY - energy))
        mesh = adapt(mesh, u)
    return found


if __name__ == "__main__":
    for vertices, error in main(*map(int, sys.argv[1:2])):
        print(f"{vertices:8} vertices, {error:.2e} of the energy are missing")

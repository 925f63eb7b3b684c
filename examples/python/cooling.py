"""Heat that leaves a square in time, by implicit steps on one mesh: cooling.py [MAX_EDGE]

Needs netmesh, scikit-fem and SciPy.
"""
import sys

import netmesh
import numpy as np
import skfem
from scipy.sparse.linalg import splu
from skfem.models.poisson import laplace, mass


def main(max_edge=0.05, steps=40, end=0.05):
    """Return the largest difference from the solution in closed form, relative to its largest value."""
    square = netmesh.domain([(0, 0), (1, 0), (1, 1), (0, 1)])
    mesh = netmesh.mesh(square, min_angle=28, max_edge=max_edge)
    basis = skfem.Basis(mesh.to_skfem(), skfem.ElementTriP1())
    # [steps]
    stiffness, weights, dt = laplace.assemble(basis), mass.assemble(basis), end / steps
    inside = np.setdiff1d(np.arange(len(mesh.points)), mesh.hull.vertices)  # the boundary stays cold
    inner = np.ix_(inside, inside)
    # Crank and Nicolson; the matrix is the same in all steps.
    forward, backward = (weights - dt / 2 * stiffness)[inner], splu((weights + dt / 2 * stiffness)[inner].tocsc())
    u = np.sin(np.pi * mesh.points).prod(axis=1)[inside]
    for _ in range(steps):
        u = backward.solve(forward @ u)
    # [end]
    exact = np.exp(-2 * np.pi**2 * end) * np.sin(np.pi * mesh.points[inside]).prod(axis=1)
    return float(np.abs(u - exact).max() / exact.max())


if __name__ == "__main__":
    print(f"{main(*map(float, sys.argv[1:2])):.2e} of the largest temperature is the largest error")

"""From a scan to a part and the heat in it: scan.py [POINTS [PICTURE]]

Needs netmesh, scikit-fem and SciPy; PyVista for the picture.
"""
import sys

import netmesh
import numpy as np
import skfem
from scipy.sparse.linalg import splu
from skfem.models.poisson import laplace, mass


def scan(count, noise=0.002):
    """Return points on a ring whose tube is bent up and down, with noise, in no order."""
    random = np.random.default_rng(7)
    turn, round_tube = 2 * np.pi * random.random((2, count))
    out = 1 + 0.3 * np.cos(round_tube)
    points = np.c_[out * np.cos(turn), out * np.sin(turn), 0.3 * np.sin(round_tube) + 0.2 * np.cos(3 * turn)]
    return points + noise * random.normal(size=points.shape)


def heat(mesh, end=0.2, steps=20):
    """Return the temperature, the heat that came in and the heat that is there, after implicit steps.

    The part begins at 0, is held at 1 where x > 1.2, and is insulated elsewhere.
    """
    basis = skfem.Basis(mesh.to_skfem(), skfem.ElementTetP1())
    stiffness, weights, dt = laplace.assemble(basis), mass.assemble(basis), end / steps
    system = (weights + dt * stiffness).tocsr()
    is_held = mesh.points[:, 0] > 1.2
    free = np.flatnonzero(~is_held)
    backward = splu(system[np.ix_(free, free)].tocsc())
    u, came_in = np.zeros(len(mesh.points)), 0.0
    for _ in range(steps):
        before, u = weights @ u, is_held.astype(float)
        u[free] = backward.solve((before - system @ u)[free])
        came_in += (system @ u - before)[is_held].sum()
    return u, came_in, (weights @ u).sum()


def main(count=20_000, picture=None):
    """Return the surface, the mesh, the temperature, the heat that came in and the heat that is there."""
    # [scan]
    points = scan(count)
    # Points nearer to each other than triangles shall be would only make thin ones.
    kept = netmesh.mesh(points, cutoff=0.06, algorithm="delaunay").points
    surface = netmesh.surface(kept)
    mesh = netmesh.mesh(surface, min_dihedral=10)
    # [end]
    u, came_in, there = heat(mesh)
    if picture is not None:
        mesh.to_pyvista(point_data={"heat": u}).plot(off_screen=True, screenshot=picture, show_edges=True)
    return surface, mesh, u, came_in, there


if __name__ == "__main__":
    surface, mesh, u, came_in, there = main(*map(int, sys.argv[1:2]), *sys.argv[2:3])
    print(surface, mesh, f"heat {there:.6f}, of which {abs(came_in / there - 1):.0e} came from nowhere", sep="\n")

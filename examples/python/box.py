"""Poisson's equation in a box of points: box.py [POINTS]

Needs netmesh and scikit-fem.
"""
import sys

import netmesh
import numpy as np
import skfem
from skfem.models.poisson import laplace, unit_load


def main(count=300):
    """Return the mesh, and the largest value of u where -div grad u = 1 and u = 0 on the sides."""
    # [box]
    inside = np.random.default_rng(5).random((count, 3))
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    mesh = netmesh.mesh(np.vstack([corners, inside]), extent="box", min_dihedral=10, max_edge=0.12)

    basis = skfem.Basis(mesh.to_skfem(), skfem.ElementTetP1())
    stiffness, load = laplace.assemble(basis), unit_load.assemble(basis)
    u = skfem.solve(*skfem.condense(stiffness, load, D=np.unique(mesh.hull.vertices)))
    # [end]
    return mesh, float(u.max())


if __name__ == "__main__":
    mesh, largest = main(*map(int, sys.argv[1:2]))
    print(mesh, f"largest u {largest:.4f}")

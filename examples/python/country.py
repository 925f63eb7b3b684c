"""A country's outline, from GeoJSON to a solved Poisson problem and its picture: country.py [PICTURE]

Needs netmesh, scikit-fem and Matplotlib.
"""
import dataclasses
import sys
from pathlib import Path

import matplotlib
import netmesh
import numpy as np
import skfem
from skfem.models.poisson import laplace, unit_load

OUTLINE = Path(__file__).parents[2] / "samples" / "iceland.geojson"


def main(picture=None):
    """Return the mesh, and the solution of -div grad u = 1 that is 0 at the coast."""
    # [solve]
    country = netmesh.domain(OUTLINE)  # longitudes and latitudes
    kilometres = 111.2 * country.points * [np.cos(np.radians(65)), 1]
    country = dataclasses.replace(country, points=kilometres)

    mesh = netmesh.mesh(country, min_angle=28, max_edge=12)

    basis = skfem.Basis(mesh.to_skfem(), skfem.ElementTriP1())
    stiffness, load = laplace.assemble(basis), unit_load.assemble(basis)
    coast = np.unique(mesh.hull.vertices)
    u = skfem.solve(*skfem.condense(stiffness, load, D=coast))
    # [end]
    if picture is not None:
        draw(mesh, u, picture)
    return mesh, u


def draw(mesh, u, picture):
    """Write the picture of a solution."""
    matplotlib.use("agg")
    # [draw]
    import matplotlib.pyplot as plt

    colors = plt.tripcolor(*mesh.points.T, u, triangles=mesh.simplices, shading="gouraud")
    plt.colorbar(colors)
    mesh.plot(linewidth=0.2).figure.savefig(picture, dpi=150)
    # [end]


if __name__ == "__main__":
    mesh, u = main(*sys.argv[1:2])
    print(mesh, f"least angle {mesh.quality().min_angle_degrees:.1f} degrees, largest u {u.max():.1f}")

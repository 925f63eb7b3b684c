"""The outline of points as polygons with holes, by an alpha shape: alpha_polygons.py [PICTURE]

Needs netmesh, shapely and, for the picture, Matplotlib.
"""
import sys

import netmesh
import numpy as np


def main(picture=None):
    """Return the polygons of two rings of points and a disc."""
    # [shape]
    random = np.random.default_rng(3)
    angle, radius = random.random(6000) * 2 * np.pi, np.sqrt(random.uniform(0.7**2, 1, 6000))
    ring = np.c_[radius * np.cos(angle), radius * np.sin(angle)]
    points = np.vstack([ring, ring + [3, 0], 0.3 * random.normal(size=(3000, 2)) + [1.5, 2]])

    alpha = netmesh.mesh(points, algorithm="delaunay").filtration("alpha")
    shape = alpha.shape(0.07**2)  # the square of the radius of balls that fit between points
    polygons = [polygon for polygon in shape.polygons() if polygon.area > 0.1]
    # [end]
    if picture is not None:
        import matplotlib

        matplotlib.use("agg")
        shape.plot().figure.savefig(picture, dpi=100)
    return polygons


if __name__ == "__main__":
    for polygon in main(*sys.argv[1:2]):
        print(f"area {polygon.area:.3f}, {len(polygon.interiors)} holes")

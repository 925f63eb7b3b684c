"""Rainfall between gauges, on a map and along a road: a script for SciPy of which only the two lines that
import have changed. It needs netmesh and numpy.

With SciPy these lines are

    from scipy.interpolate import (
        CloughTocher2DInterpolator, LinearNDInterpolator, NearestNDInterpolator, griddata)
    from scipy.spatial import ConvexHull, Delaunay, Voronoi
"""
import numpy as np
from netmesh import (
    CloughTocher2DInterpolator, LinearNDInterpolator, NearestNDInterpolator, griddata)
from netmesh import ConvexHull, Delaunay, Voronoi


def rainfall(x, y):
    """Return millimetres a day at places in kilometres."""
    return 12 + 5 * np.sin(x / 20) * np.cos(y / 15) + 0.05 * x


def main():
    rng = np.random.default_rng(7)
    gauges = 100 * rng.random((500, 2))
    measured = rainfall(*gauges.T)

    tri = Delaunay(gauges)
    cubic = CloughTocher2DInterpolator(tri, measured)
    linear = LinearNDInterpolator(tri, measured)
    nearest = NearestNDInterpolator(gauges, measured)
    x, y = np.meshgrid(np.linspace(10, 90, 41), np.linspace(10, 90, 41))
    errors = {
        name: float(np.abs(found(x, y) - rainfall(x, y)).mean())
        for name, found in [("cubic", cubic), ("linear", linear), ("nearest", nearest)]
    }

    road = np.column_stack([np.linspace(-10, 110, 25), np.full(25, 42.0)])
    along = griddata(gauges, measured, road, method="cubic", fill_value=-1.0)
    is_inside = tri.find_simplex(road) >= 0

    # The area that each gauge stands for, where that is on the map.
    vor = Voronoi(gauges)
    area = {}
    for at, region in enumerate(vor.point_region):
        corners = vor.vertices[vor.regions[region]]
        if -1 not in vor.regions[region] and (corners >= 0).all() and (corners <= 100).all():
            area[at] = float(cell_area(corners))

    return {
        "errors": errors,
        "along": along,
        "kilometres inside": float(5 * is_inside.sum()),
        "triangles": len(tri.simplices),
        "area of the hull": float(ConvexHull(gauges).volume),
        "cells on the map": len(area),
        "largest cell": max(area, key=area.get),
        "its area": max(area.values()),
    }


def cell_area(corners):
    """Return the area of a polygon whose corners stand in their order round it."""
    x, y = corners.T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value}")

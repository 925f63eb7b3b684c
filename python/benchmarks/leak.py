"""Resident memory after ever more meshes, which are freed: python leak.py [--meshes N].

Prints it ten times, each a tenth of N (10,000) meshes after the last; it must not grow. Each mesh is asked for all
that a mesh can be asked for; what takes long only every tenth.
"""

import argparse
import gc
import pathlib

import netmesh
import numpy as np

POINTS, X = np.random.default_rng(1).random((2, 12, 2))


def resident():
    """In bytes; of Linux."""
    gc.collect()
    status = pathlib.Path("/proc/self/status").read_text().split()
    return int(status[status.index("VmRSS:") + 1]) * 1024


def use(rare):
    m = netmesh.mesh(POINTS, progress=lambda report: None)
    m.locate(X), m.nearest(X), m.nearest(X, among="inputs"), m.domains, m.stats, m.quality()
    for interpolation in ("linear", "sibson", "laplace"):
        m.interpolate(m.points, X, interpolation=interpolation, outside="nearest")
    if rare:
        m.edges, m.facets, m.hull, m.vertex_simplices, m.vertex_neighbors, m.circumcenters, m.volumes, m.voronoi
        m.validate(), m.extend_values(POINTS), m.placements("box"), m.part("hull").volumes
        netmesh.Voronoi(POINTS).ridge_dict
    tri = netmesh.Delaunay(POINTS)
    tri.transform, tri.simplices, tri.find_simplex(X), netmesh.LinearNDInterpolator(tri, POINTS)(X)
    try:
        m.locate([np.nan, 0])
    except netmesh.NonFiniteError:
        pass


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--meshes", type=int, default=10_000)
    tenth = max(1, parser.parse_args().meshes // 10)
    for done in range(tenth, 10 * tenth + 1, tenth):
        for i in range(tenth):
            use(rare=i % 10 == 0)
        print(f"{done:8} meshes  {resident():12} bytes", flush=True)


main()

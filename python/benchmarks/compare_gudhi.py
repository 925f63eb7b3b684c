"""Alpha filtrations beside GUDHI's, in one run: python compare_gudhi.py [--scale S] [--repeat R].

Times are the least of R repetitions, in turns, from points on. `--scale` multiplies the numbers of
points.
"""

import argparse
import time

import gudhi
import netmesh
import numpy as np

SETS = [(2, 100_000), (3, 20_000), (4, 5_000), (5, 1_000), (6, 500)]


def seconds(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def alpha(points, threads):
    return netmesh.mesh(points, algorithm="delaunay").filtration("alpha", threads=threads)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--repeat", type=int, default=3)
    arguments = parser.parse_args()
    random = np.random.default_rng(1)
    print(f"{'':20} {'GUDHI safe':>11} | over it: arrays, SimplexTree | filtration alone: two threads")
    for dim, count in SETS:
        points = random.random((max(dim + 2, int(count * arguments.scale)), dim))
        mesh = netmesh.mesh(points, algorithm="delaunay")
        calls = [
            lambda: gudhi.AlphaComplex(points=points, precision="safe").create_simplex_tree(),
            lambda: alpha(points, 1),
            lambda: alpha(points, 1).to_gudhi(),
            lambda: mesh.filtration("alpha", threads=1),
            lambda: mesh.filtration("alpha", threads=2),
        ]
        times = np.array([[seconds(call) for call in calls] for _ in range(arguments.repeat)])
        theirs, arrays, tree, one, two = times.min(axis=0)
        print(
            f"{dim}D, {len(points):7} points {theirs:10.3f} s | {theirs / arrays:6.2f} times "
            f"{theirs / tree:6.2f} times | {one:.3f} s, {one / two:.2f} times",
            flush=True,
        )


main()

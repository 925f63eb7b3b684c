"""netmesh beside SciPy, in one run: python compare_scipy.py [--scale S] [--repeat R] [--threads T].

Times are the least of R repetitions, in turns. `--scale` multiplies the numbers of points.
"""

import argparse
import time

import netmesh
import numpy as np
import scipy.interpolate
import scipy.spatial

BUILDS = [(2, 100_000), (3, 100_000), (4, 10_000), (5, 2_000), (6, 500)]


def seconds(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def compare(name, ours, theirs, repeat, count=None):
    times = np.array([[seconds(ours), seconds(theirs)] for _ in range(repeat)]).min(axis=0)
    line = f"{name:34} {times[0]:9.4f} s {times[1]:9.4f} s   {times[1] / times[0]:7.2f} times"
    if count:
        line += f"   {count / times[0] / 1e6:6.2f} M/s"
    print(line, flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--threads", type=int, default=1)
    arguments = parser.parse_args()
    repeat, threads = arguments.repeat, arguments.threads
    random = np.random.default_rng(1)
    print(f"{'':34} {'netmesh':>11} {'SciPy':>11}   SciPy over netmesh, {threads} threads", flush=True)
    for dim, count in BUILDS:
        n = max(dim + 2, int(count * arguments.scale))
        points = random.random((n, dim))
        name = f"{dim}D, {n} points: "
        compare(
            name + "Delaunay",
            lambda: netmesh.Delaunay(points).simplices,
            lambda: scipy.spatial.Delaunay(points),
            repeat,
        )
        if dim > 4:
            continue
        m, theirs = netmesh.mesh(points, algorithm="delaunay"), scipy.spatial.Delaunay(points)
        count = int(1_000_000 * arguments.scale)
        x = random.random((count, dim))
        # SciPy's takes a tenth of a second for a thousand random points.
        few = x[: max(1, count // 20)]
        start = time.perf_counter()
        theirs.find_simplex(few)
        theirs_rate = len(few) / (time.perf_counter() - start)
        m.locate(x[:1])
        ours = min(seconds(lambda: m.locate(x, threads=threads)) for _ in range(repeat))
        print(
            f"{name + 'find_simplex':34} {ours:9.4f} s {count / theirs_rate:9.4f} s   "
            f"{count / theirs_rate / ours:7.2f} times   {count / ours / 1e6:6.2f} M/s",
            flush=True,
        )
        tree = scipy.spatial.cKDTree(points)
        workers = threads or -1
        compare(
            name + "nearest, cKDTree",
            lambda: m.nearest(x, threads=threads),
            lambda: tree.query(x, workers=workers),
            repeat,
            count,
        )
        values = random.random(n)
        compare(
            name + "LinearND with build",
            lambda: netmesh.LinearNDInterpolator(points, values, threads=threads)(few),
            lambda: scipy.interpolate.LinearNDInterpolator(points, values)(few),
            1,
        )


main()

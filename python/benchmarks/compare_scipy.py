"""netmesh beside SciPy, in one run: python compare_scipy.py [--scale S] [--repeat R] [--threads T] [--only WORD].

Times are the least of R repetitions, in turns. `--scale` multiplies the numbers of points. `--only` leaves out the
rows without that word. The last rows have netmesh alone: natural neighbours, and one thread beside two.
"""

import argparse
import time

import netmesh
import numpy as np
import scipy.interpolate
import scipy.spatial

BUILDS = [(2, 100_000), (3, 100_000), (4, 10_000), (5, 2_000), (6, 500)]

#: Random points that are asked about.
QUERIES = 1_000_000


def seconds(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


class Rows:
    """Prints times of two calls, and how many times as long the second one takes."""

    def __init__(self, repeat, only):
        self.repeat, self.only = repeat, only

    def heading(self, *texts):
        print(f"\n{texts[0]:44} {texts[1]:>11} {texts[2]:>11}   {texts[3]}", flush=True)

    def add(self, name, first, second, count=None, *, asked=None, repeat=None):
        """Times calls of `count` things each. If the second call is `asked` for fewer its time is multiplied."""
        if self.only not in name:
            return
        rounds = range(repeat or self.repeat)
        times = np.array([[seconds(first), seconds(second)] for _ in rounds]).min(axis=0)
        if asked:
            times[1] *= count / asked
        line = f"{name:44} {times[0]:9.4f} s {times[1]:9.4f} s   {times[1] / times[0]:7.2f} times"
        print(line + (f"   {count / times[0] / 1e6:6.2f} M/s" if count else ""), flush=True)


def beside_scipy(rows, dim, points, x, threads):
    name = f"{dim}D, {len(points)} points: "
    rows.add(
        name + "Delaunay",
        lambda: netmesh.Delaunay(points).simplices,
        lambda: scipy.spatial.Delaunay(points),
    )
    if dim > 4:
        return
    ours, theirs = netmesh.Delaunay(points, threads=threads), scipy.spatial.Delaunay(points)
    ours.find_simplex(x[:1]), theirs.find_simplex(x[:1])
    # SciPy's takes a tenth of a second for a thousand random points.
    few = x[: max(1, len(x) // 20)]
    rows.add(
        name + "find_simplex",
        lambda: ours.find_simplex(x),
        lambda: theirs.find_simplex(few),
        len(x),
        asked=len(few),
    )
    # Near ones in turn, which SciPy's search needs.
    in_order = x[scipy.spatial.cKDTree(x).indices]
    rows.add(
        name + "find_simplex, sorted",
        lambda: ours.find_simplex(in_order),
        lambda: theirs.find_simplex(in_order),
        len(x),
    )
    tree = scipy.spatial.cKDTree(points)
    rows.add(
        name + "nearest, cKDTree",
        lambda: ours.mesh.nearest(x, threads=threads),
        lambda: tree.query(x, workers=threads or -1),
        len(x),
    )
    values = np.sin(points).sum(axis=1)
    for queries in (few, x[: len(points)]):
        rows.add(
            f"{name}LinearND and build, {len(queries)}",
            lambda: netmesh.LinearNDInterpolator(points, values, threads=threads)(queries),
            lambda: scipy.interpolate.LinearNDInterpolator(points, values)(queries),
            repeat=1,
        )


def natural_neighbours(rows, dim, points, x, threads):
    m, values = netmesh.mesh(points, algorithm="delaunay"), np.sin(points).sum(axis=1)
    few = x[: max(1, len(x) // 20)]
    m.locate(x[:1])

    def interpolate(interpolation):
        m.interpolate(values, few, interpolation=interpolation, threads=threads)

    name = f"{dim}D, {len(points)} points: {len(few)} "
    for interpolation in ("sibson", "laplace"):
        rows.add(
            name + interpolation,
            lambda: interpolate(interpolation),
            lambda: interpolate("linear"),
            len(few),
        )


def threads_beside_one(rows, dim, points, x):
    m, values = netmesh.mesh(points, algorithm="delaunay"), np.sin(points).sum(axis=1)
    m.locate(x[:1])
    few = x[: max(1, len(x) // 20)]
    calls = {
        "locate": lambda threads: m.locate(x, threads=threads),
        "nearest": lambda threads: m.nearest(x, threads=threads),
        "interpolate": lambda threads: m.interpolate(values, x, threads=threads),
        "sibson": lambda threads: m.interpolate(values, few, interpolation="sibson", threads=threads),
    }
    for name, call in calls.items():
        rows.add(f"{dim}D, {len(points)} points: {name}", lambda: call(2), lambda: call(1))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    rows, threads = Rows(arguments.repeat, arguments.only), arguments.threads
    random = np.random.default_rng(1)
    data = {}
    for dim, count in BUILDS:
        points = random.random((max(dim + 2, int(count * arguments.scale)), dim))
        data[dim] = points, random.random((max(1, int(QUERIES * arguments.scale)), dim))
    rows.heading("", "netmesh", "SciPy", f"SciPy over netmesh, {threads} threads")
    for dim, (points, x) in data.items():
        beside_scipy(rows, dim, points, x, threads)
    searched = {dim: data[dim] for dim in (2, 3, 4)}
    rows.heading("", "natural", "linear", "linear over natural neighbours")
    for dim, (points, x) in searched.items():
        natural_neighbours(rows, dim, points, x, threads)
    rows.heading("", "2 threads", "1 thread", "one thread over two")
    for dim, (points, x) in searched.items():
        threads_beside_one(rows, dim, points, x)


main()

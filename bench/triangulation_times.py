"""Prints the seconds of plain Delaunay triangulations: triangulation_times.py DELAUNAY_RATIO > TIMES.csv.

netmesh and CGAL take turns in `delaunay_ratio`, SciPy has a process of its own, on points of the same
distributions; medians of three turns, of one from a million points on. One thread each. Needs NumPy
and SciPy.
"""

import statistics
import subprocess
import sys
import time

import numpy as np

TURN, MOST_SECONDS = "--turn", 120


def points_of(dim, distribution, count):
    """Returns points in the unit cube, or on the unit sphere."""
    random = np.random.default_rng(1)
    if distribution == "uniform":
        return random.random((count, dim))
    directions = random.normal(size=(count, dim))
    return directions / np.linalg.norm(directions, axis=1)[:, None]


def turn(dim, distribution, count):
    """Prints the seconds of SciPy's triangulation."""
    from scipy.spatial import Delaunay

    points = points_of(dim, distribution, count)
    begun = time.perf_counter()
    Delaunay(points)
    print(time.perf_counter() - begun)


def measure_scipy(dim, distribution, count, turns):
    """Returns the median of the turns' seconds."""
    command = [sys.executable, __file__, TURN, str(dim), distribution, str(count)]
    printed = [
        subprocess.run(command, timeout=MOST_SECONDS, check=True, capture_output=True).stdout
        for _ in range(turns)
    ]
    return statistics.median(map(float, printed))


def measure_others(program, dim, distribution, count, turns):
    """Returns the medians of netmesh and CGAL, which the program prints in its last line but one."""
    command = [program, str(dim), str(count), str(turns), distribution]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    medians = [line.split() for line in printed.splitlines() if line.startswith("median")]
    return tuple(map(float, medians[-1][1:3]))


def main(words):
    """Prints a row for each triangulation that ends."""
    if words[:1] == [TURN]:
        return turn(int(words[1]), words[2], int(words[3]))
    print("dim,distribution,mesher,points,vertices,seconds")
    for dim, distribution, count in (
        (dim, distribution, 10**power)
        for dim in (2, 3)
        for distribution in ("uniform", "sphere")
        for power in range(3, 7)
    ):
        turns = 3 if count < 1_000_000 else 1
        found = dict(
            zip(
                ("netmesh", "CGAL Delaunay"),
                measure_others(words[0], dim, distribution, count, turns),
                strict=True,
            )
        )
        try:
            found["SciPy"] = measure_scipy(dim, distribution, count, turns)
        except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
            print(f"left out: {dim}D {distribution}, {count} points: {error}", file=sys.stderr)
        for mesher, seconds in found.items():
            print(dim, distribution, mesher, count, count, f"{seconds:.6f}", sep=",", flush=True)


main(sys.argv[1:])

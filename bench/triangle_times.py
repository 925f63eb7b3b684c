"""Prints rows of Triangle beside those of `mesh_times`: triangle_times.py TIMES.csv >> TIMES.csv.

A row for each of netmesh's in 2D that Triangle meshes, on points of the same distributions. Needs the
package `triangle`, which is not free software. A run has a process of its own: where Triangle fails,
it ends the process or never ends.
"""

import csv
import importlib.util
import statistics
import subprocess
import sys
import time

import numpy as np

TURN, MOST_SECONDS = "--turn", 120


def points_of(distribution, count):
    random = np.random.default_rng(1)
    if distribution == "uniform":
        return random.random((count, 2))
    angle = 2 * np.pi * random.random(count)
    return np.c_[np.cos(angle), np.sin(angle)]


def turn(distribution, count):
    """Prints the number of vertices of Triangle's mesh, and its seconds."""
    import triangle

    points = points_of(distribution, count)
    begun = time.perf_counter()
    mesh = triangle.triangulate({"vertices": points}, "q20.7")
    print(len(mesh["vertices"]), time.perf_counter() - begun)


def measure(distribution, count, turns):
    """Returns the medians of vertices and seconds over the turns."""
    command = [sys.executable, __file__, TURN, distribution, str(count)]
    printed = [
        subprocess.run(command, timeout=MOST_SECONDS, check=True, capture_output=True).stdout
        for _ in range(turns)
    ]
    figures = [map(float, line.split()) for line in printed]
    return tuple(map(statistics.median, zip(*figures, strict=True)))


def main(words):
    if words[:1] == [TURN]:
        return turn(words[1], int(words[2]))
    if importlib.util.find_spec("triangle") is None:
        sys.exit("the package triangle is not installed")
    with open(words[0], encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if (row["dim"], row["mesher"]) == ("2", "netmesh")]
    for row in rows:
        count = int(row["points"])
        try:
            vertices, seconds = measure(row["distribution"], count, 3 if count < 1_000_000 else 1)
        except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
            print(f"left out: {count} points, {row['distribution']}: {error}", file=sys.stderr)
            continue
        print("2", row["distribution"], "Triangle", count, round(vertices), f"{seconds:.6f}", sep=",")


main(sys.argv[1:])

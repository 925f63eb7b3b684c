"""Draws what meshes take against the number of points: python draw_times.py TIMES.csv OUT.svg.

TIMES.csv is what `mesh_times` prints (bench/README.md). Rows of Triangle are added by a run here, on
points of the same distributions, where the package `triangle` is installed: it is not free software.
"""

import csv
import importlib.util
import math
import statistics
import subprocess
import sys
import time

import numpy as np

TRIANGLE_TURN, MOST_SECONDS = "--triangle-turn", 120
WIDTH, PANEL, GAP, LEFT, TOP, HEIGHT = 760, 300, 70, 60, 40, 190
COLORS = {
    "netmesh": "#b03a2e",
    "TetGen": "#1f618d",
    "Triangle": "#117a65",
    "CGAL Mesh_2": "#7d3c98",
    "CGAL Delaunay": "#7f8c8d",
}
TITLES = {
    ("2", "uniform"): "2D, uniform, 20.7 degrees",
    ("2", "sphere"): "2D, circle, 20.7 degrees",
    ("3", "uniform"): "3D, uniform, radius-edge 2",
    ("3", "sphere"): "3D, sphere, radius-edge 2",
}


def points_of(distribution, count):
    random = np.random.default_rng(1)
    if distribution == "uniform":
        return random.random((count, 2))
    angle = 2 * np.pi * random.random(count)
    return np.c_[np.cos(angle), np.sin(angle)]


def triangle_turn(distribution, count):
    """Prints the number of vertices of Triangle's mesh, and its seconds."""
    import triangle

    points = points_of(distribution, count)
    begun = time.perf_counter()
    mesh = triangle.triangulate({"vertices": points}, "q20.7")
    print(len(mesh["vertices"]), time.perf_counter() - begun)


def triangle_turns(distribution, count, turns):
    """Each in a process of its own, as Triangle ends the process, or never ends, where it fails."""
    command = [sys.executable, __file__, TRIANGLE_TURN, distribution, str(count)]
    for _ in range(turns):
        turn = subprocess.run(command, timeout=MOST_SECONDS, check=True, capture_output=True)
        yield tuple(map(float, turn.stdout.split()))


def triangle_rows(rows):
    """A row for each of netmesh's in 2D that Triangle meshes."""
    if importlib.util.find_spec("triangle") is None:
        print("skipped: Triangle: the package triangle is not installed", file=sys.stderr)
        return
    for row in rows:
        if (row["dim"], row["mesher"]) != ("2", "netmesh"):
            continue
        count = int(row["points"])
        try:
            turns = list(triangle_turns(row["distribution"], count, 3 if count < 1_000_000 else 1))
        except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
            name = TITLES["2", row["distribution"]]
            print(f"left out: Triangle, {count} points ({name}): {error}", file=sys.stderr)
            continue
        vertices, seconds = map(statistics.median, zip(*turns, strict=True))
        yield {
            **row,
            "mesher": "Triangle",
            "vertices": str(round(vertices)),
            "seconds": str(seconds),
        }


def panel(rows, key, left, top):
    """Microseconds a point against points, both logarithmic."""
    own = [row for row in rows if (row["dim"], row["distribution"]) == key]
    at = {
        mesher: sorted(
            (int(row["points"]), 1e6 * float(row["seconds"]) / int(row["points"]))
            for row in own
            if row["mesher"] == mesher
        )
        for mesher in COLORS
    }
    every = [point for line in at.values() for point in line]
    counts, values = [n for n, _ in every], [value for _, value in every]
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    first, last = math.log10(min(counts)), math.log10(max(counts))

    def x(count):
        return left + PANEL * (math.log10(count) - first) / max(last - first, 1)

    def y(value):
        return top + HEIGHT * (high - math.log10(value)) / (high - low)

    yield f'<text x="{left}" y="{top - 8}" font-size="13">{TITLES[key]}</text>'
    for power in range(low, high + 1):
        line = y(10.0**power)
        yield f'<path d="M{left} {line:.1f}h{PANEL}" stroke="#ddd"/>'
        label = f"{10.0**power:g}"
        yield f'<text x="{left - 6}" y="{line + 4:.1f}" font-size="11" text-anchor="end">{label}</text>'
    for power in range(math.ceil(first), math.floor(last) + 1):
        place = x(10**power)
        yield (
            f'<text x="{place:.1f}" y="{top + HEIGHT + 16}" font-size="11" text-anchor="middle">'
            f'10<tspan dy="-4" font-size="8">{power}</tspan></text>'
        )
    for mesher, line in at.items():
        if line:
            path = " ".join(f"{x(count):.1f},{y(value):.1f}" for count, value in line)
            color = COLORS[mesher]
            yield f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="2"/>'
            for count, value in line:
                yield f'<circle cx="{x(count):.1f}" cy="{y(value):.1f}" r="3" fill="{color}"/>'


def drawing(rows):
    height = 2 * (TOP + HEIGHT + 36) + 44
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        f'width="{WIDTH}" font-family="sans-serif">'
        '<rect width="100%" height="100%" fill="white"/>'
    )
    for number, key in enumerate(TITLES):
        across, down = number % 2, number // 2
        yield from panel(rows, key, LEFT + across * (PANEL + GAP), TOP + down * (TOP + HEIGHT + 36))
    for number, (mesher, color) in enumerate(COLORS.items()):
        left = LEFT + 140 * number
        yield f'<rect x="{left}" y="{height - 24}" width="14" height="4" fill="{color}"/>'
        yield f'<text x="{left + 20}" y="{height - 18}" font-size="12">{mesher}</text>'
    yield (
        f'<text x="{LEFT}" y="{height - 38}" font-size="11">'
        "across: points; up: microseconds a point, one thread</text>"
    )
    yield "</svg>"


def main():
    if sys.argv[1:2] == [TRIANGLE_TURN]:
        triangle_turn(sys.argv[2], int(sys.argv[3]))
        return
    times, out = sys.argv[1:]
    with open(times, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    rows += list(triangle_rows(rows))
    for row in rows:
        print(*row.values(), sep=",")
    with open(out, "w", encoding="utf-8") as file:
        file.write("\n".join(drawing(rows)) + "\n")


main()

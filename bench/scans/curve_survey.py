"""Tells which edges of the curves of curves.py are found, by the crust and NN-crust on SciPy's Delaunay
triangulation and by netmesh.

    curve_survey.py INDEX [--netmesh PROGRAM] [--options="..."] [--open="..."] > table.md
    curve_survey.py INDEX --measure FILE [POINTS]

FILE is what a tool made: OBJ with lines, OFF with faces of two vertices, or lines of two indices from 0.
POINTS is the name of the points there, which is that of FILE if left out. Of netmesh is read what
`netmesh POINTS --surface -o FILE.obj` writes, with more options: `--open=--open` gives one to open curves alone.
The first table counts the sets that are right of each kind, with wrong and missing ones of 1,000 edges.
"""
import argparse
import json
import subprocess
import tempfile
from collections import defaultdict
from pathlib import Path

import numpy as np
from scipy.spatial import Delaunay, Voronoi, cKDTree

# Voronoi vertices farther than so many times the size of the points are left out of the crust.
FAR = 10


def keys(edges):
    return {(min(edge), max(edge)) for edge in np.asarray(edges).reshape(-1, 2).tolist()}


def measure_curve(edges, record):
    """Returns the numbers of right, wrong and missing edges, and of points where a wrong number of edges meets."""
    found, known = keys(edges), keys(record["edges"])
    degrees = [np.bincount([end for edge in some for end in edge], minlength=record["n"]) for some in (found, known)]
    return {
        "right": len(found & known),
        "wrong": len(found - known),
        "missing": len(known - found),
        "points_of_wrong_degree": int((degrees[0] != degrees[1]).sum()),
    }


def delaunay_edges(points):
    triangles = Delaunay(points).simplices
    return np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)


def crust(points):
    """Returns the Delaunay edges between points in the triangulation of points and Voronoi vertices."""
    poles = Voronoi(points).vertices
    # Those of points on a line are so far that Qhull would take all points for one.
    is_near = (np.abs(poles - points.mean(axis=0)) < FAR * np.ptp(points, axis=0).max()).all(axis=1)
    both = np.vstack([points, poles[is_near]])
    edges = delaunay_edges(both)
    return edges[(edges < len(points)).all(axis=1)]


def nearest_neighbor_crust(points):
    """Returns each point's shortest Delaunay edge, and its shortest one at more than 90 degrees to that."""
    edges = delaunay_edges(points)
    both = np.vstack([edges, edges[:, ::-1]])
    ways = points[both[:, 1]] - points[both[:, 0]]
    lengths = (ways**2).sum(axis=1)
    order = np.lexsort([lengths, both[:, 0]])
    both, ways = both[order], ways[order]
    starts = np.searchsorted(both[:, 0], np.arange(len(points) + 1))
    chosen = []
    for first, last in zip(starts, starts[1:]):
        chosen.append(both[first])
        opposite = np.flatnonzero(ways[first:last] @ ways[first] < 0)
        if len(opposite):
            chosen.append(both[first + opposite[0]])
    return np.array(chosen)


def read_edges(path, points):
    """Returns the edges of a file between the given points, which its vertices are."""
    lines = [line.split() for line in path.read_text().splitlines() if line.strip() and line[0] != "#"]
    if path.suffix == ".obj":
        vertices = np.array([line[1:3] for line in lines if line[0] == "v"], dtype=float)
        chains = [[int(word) - 1 for word in line[1:]] for line in lines if line[0] == "l"]
        edges = np.array([edge for chain in chains for edge in zip(chain, chain[1:])])
    elif lines[0][0] == "OFF":
        count = int(lines[1][0])
        vertices = np.array([line[:2] for line in lines[2 : 2 + count]], dtype=float)
        edges = np.array([line[1:3] for line in lines[2 + count :]], dtype=int)
    else:
        return np.array(lines, dtype=int)
    distance, number = cKDTree(points).query(vertices)
    far = int((distance > 1e-9 * np.ptp(points, axis=0).max()).sum())
    if far:
        raise SystemExit(f"{path}: {far} vertices are none of the points")
    return number[edges]


def by_netmesh(arguments, record, points):
    path = arguments.index.parent / record["points"]
    options = arguments.options.split() + ([] if record["closed"] else arguments.open.split())
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "curve.obj"
        command = [arguments.netmesh, path, "--surface", *options, "-o", out]
        ended = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        return read_edges(out, points) if ended.returncode == 0 and out.exists() else None


def cell(result):
    if result is None:
        return "fails"
    told = f"{result['wrong']} wrong, {result['missing']} missing"
    return "right" if result["wrong"] == result["missing"] == 0 else told


def kind(record):
    """Returns the row of the first table: smooth curves by their ratio, others by how they are sampled."""
    name, _, how = Path(record["points"]).stem.partition("_")
    if record["ratio"]:
        return f"{'circles, ellipses, flower' if record['closed'] else 'spiral'}, ratio {record['ratio']}"
    how = how.lstrip("0123456789_") or how
    return f"{name + 's' * (name in ('corner', 'island'))}, {how.replace('_', ' ')}"


def summary_cell(results):
    made = [result for result in results if result is not None]
    right = sum(cell(result) == "right" for result in results)
    edges = sum(result["right"] + result["missing"] for result in made)
    if right == len(results):
        return f"{right}"
    wrong, missing = (1000 * sum(result[key] for result in made) / max(edges, 1) for key in ("wrong", "missing"))
    return f"{right}; {wrong:.0f}, {missing:.0f}"


def print_rows(head, rows):
    print(f"| {' | '.join(head)} |\n|{'---|' * len(head)}")
    for row in rows:
        print(f"| {' | '.join(row)} |")


def print_tables(arguments, records):
    tools = {"crust": lambda _, points: crust(points), "NN-crust": lambda _, points: nearest_neighbor_crust(points)}
    if arguments.netmesh:
        tools["netmesh"] = lambda record, points: by_netmesh(arguments, record, points)
    rows, kinds = [], defaultdict(list)
    for record in records:
        points = np.loadtxt(arguments.index.parent / record["points"])
        edges = [tool(record, points) for tool in tools.values()]
        results = [None if own is None else measure_curve(own, record) for own in edges]
        rows.append([Path(record["points"]).stem, str(len(record["edges"])), *map(cell, results)])
        kinds[kind(record)].append(results)
    counts = ([name, str(len(own)), *map(summary_cell, zip(*own))] for name, own in kinds.items())
    print_rows(["kind", "sets", *tools], counts)
    print()
    print_rows(["points", "edges", *tools], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("index", type=Path)
    parser.add_argument("--netmesh")
    parser.add_argument("--options", default="")
    parser.add_argument("--open", default="")
    parser.add_argument("--measure", nargs="+")
    arguments = parser.parse_args()
    records = json.loads(arguments.index.read_text())
    if not arguments.measure:
        return print_tables(arguments, records)
    name = Path(arguments.measure[-1]).name
    name = name.removesuffix(".xy") if len(arguments.measure) == 2 else name.rpartition(".")[0]
    record = next(record for record in records if record["points"] == f"{name}.xy")
    points = np.loadtxt(arguments.index.parent / record["points"])
    print(json.dumps(measure_curve(read_edges(Path(arguments.measure[0]), points), record)))


if __name__ == "__main__":
    main()

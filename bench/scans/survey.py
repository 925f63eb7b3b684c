"""Reconstructs the surfaces of samples.py with several tools, and tells what became of each.

    survey.py INDEX OUT [--tools A,B] [--netmesh PROGRAM] [--options="..."] [--cgal PROGRAM] [--sets 10000,vertices]
              [--seconds S] [--table-only] > table.md

INDEX is the index.json of samples.py. OUT keeps the meshes and measures, OUT/TOOL/POINTS.json each, so
that a table may show tools of several runs. CGAL's program is cgal_surface of this folder; the Python that
runs this has numpy, scipy, trimesh, open3d and pymeshlab. `--sets` names sizes and `vertices`. Every tool
has one thread; seconds are those of the processor, with files for netmesh and without for others.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

import numpy as np

from measures import find_record, measure
from samples import read_result

PEERS = ["cgal-front", "cgal-scale-space", "open3d-poisson", "pymeshlab-poisson", "open3d-ball", "pymeshlab-ball"]
TOOLS = ["netmesh", *PEERS]
HERE = Path(__file__).parent


def command(arguments, tool, points, out):
    if tool == "netmesh":
        return [arguments.netmesh, points, "--surface", *arguments.options.split(), "-o", out]
    if tool.startswith("cgal-"):
        return [arguments.cgal, tool.removeprefix("cgal-"), points, out]
    return [sys.executable, HERE / "peers.py", tool, points, out]


def run(arguments, tool, points, out):
    """Returns the seconds and MiB of a tool whose mesh is in `out`, or what became of it."""
    out.unlink(missing_ok=True)
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (arguments.seconds, arguments.seconds + 5))  # noqa: E731
    with tempfile.TemporaryFile("w+", errors="replace") as text:
        child = subprocess.Popen(
            [str(word) for word in command(arguments, tool, points, out)],
            stdout=text,
            stderr=subprocess.STDOUT,
            preexec_fn=limit,
            env=os.environ | {"OMP_NUM_THREADS": "1"},
        )
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        text.seek(0)
        lines = text.read().strip().splitlines() or [""]
    record = {"seconds": used.ru_utime + used.ru_stime, "mib": used.ru_maxrss / 1024}
    if child.returncode != 0 or not out.exists():
        return record | {"failure": f"status {child.returncode}: {lines[-1][:120]}"}
    if tool != "netmesh":
        record |= json.loads(lines[-1])
    return record


def survey(arguments, tool, record):
    folder = arguments.out / tool
    folder.mkdir(parents=True, exist_ok=True)
    name = Path(record["points"]).stem
    mesh_file = folder / f"{name}.off"
    result = run(arguments, tool, Path(record["points"]), mesh_file)
    if "failure" not in result:
        mesh = read_result(mesh_file)
        result |= measure(mesh.vertices, mesh.faces, record)
    (folder / f"{name}.json").write_text(json.dumps(result, indent=1))


def verdict(result):
    """Returns the first thing that is wrong with a mesh in a word or two, or `right`."""
    if "failure" in result:
        return "fails"
    if result["triangles"] == 0:
        return "empty"
    if result["edges_of_many"]:
        return "not manifold"
    if result["boundary_edges"]:
        return f"open ({result['boundary_edges']})"
    if not result["manifold"]:
        return "not manifold"
    if not result["orientable"]:
        return "one-sided"
    return "right" if result["topology_right"] else f"genera {shortened(result['genera'])}"


def shortened(genera):
    told = ", ".join(str(genus) for genus in genera[:4])
    return told if len(genera) <= 4 else f"{told}, ... ({len(genera)} parts)"


def largest(result):
    return max(result["largest_to_truth"], result["largest_from_truth"])


def print_details(names, tools, results):
    print("Each cell: what the mesh is; largest distance of the two surfaces in sampling distances; seconds.\n")
    print(f"| points | {' | '.join(tools)} |")
    print(f"|---{'|---' * len(tools)}|")
    for name in names:
        cells = []
        for tool in tools:
            result = results.get((tool, name))
            if result is None:
                cells.append("")
            elif "largest_to_truth" not in result:
                cells.append(verdict(result))
            else:
                cells.append(f"{verdict(result)}; {largest(result):.2f}; {result['seconds']:.1f}")
        print(f"| {name} | {' | '.join(cells)} |")


def print_summary(records, tools, results):
    print(
        "| set | tool | sets | right | watertight | manifold | largest distance: median | worst "
        "| mean distance: median | points used | outliers used | seconds |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    groups = defaultdict(list)
    for record in records:
        kind = record["kind"]
        groups[kind if kind == "vertices" else f"{record['n']} {kind}"].append(record)
    for group, members in groups.items():
        for tool in tools:
            every = [results.get((tool, Path(record["points"]).stem)) for record in members]
            every = [result for result in every if result is not None]
            if every:
                print_summary_row(group, tool, every)


def print_summary_row(group, tool, every):
    count = lambda key: sum(result.get(key, False) for result in every)  # noqa: E731
    made = [result for result in every if "largest_to_truth" in result]
    start = (
        f"| {group} | {tool} | {len(every)} | {count('topology_right')} | {count('watertight')} | {count('manifold')} "
    )
    if not made:
        print(start + "| | | | | | |")
        return
    far = [largest(result) for result in made]
    mean = [max(result["mean_to_truth"], result["mean_from_truth"]) for result in made]
    print(
        f"{start}| {np.median(far):.2f} | {max(far):.2f} | {np.median(mean):.3f} "
        f"| {np.median([result['points_used'] for result in made]):.3f} "
        f"| {sum(result['outliers_used'] for result in made)} | {sum(result['seconds'] for result in every):.1f} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("index", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--tools", default=",".join(TOOLS))
    parser.add_argument("--netmesh", default="netmesh")
    parser.add_argument("--options", default="")
    parser.add_argument("--cgal", default="cgal_surface")
    parser.add_argument("--sets", default="10000,vertices")
    parser.add_argument("--seconds", type=int, default=300)
    parser.add_argument("--table-only", action="store_true")
    arguments = parser.parse_args()
    sets, tools = arguments.sets.split(","), arguments.tools.split(",")
    records = [
        find_record(arguments.index, record["points"])
        for record in json.loads(arguments.index.read_text())
        if (record["kind"] if record["kind"] == "vertices" else str(record["n"])) in sets
    ]
    for record in [] if arguments.table_only else records:
        for tool in tools:
            survey(arguments, tool, record)
    files = {(tool, Path(record["points"]).stem): arguments.out / tool for tool in tools for record in records}
    results = {}
    for (tool, name), folder in files.items():
        if (folder / f"{name}.json").exists():
            results[tool, name] = json.loads((folder / f"{name}.json").read_text())
    print_summary(records, tools, results)
    print()
    print_details([Path(record["points"]).stem for record in records], tools, results)


main()

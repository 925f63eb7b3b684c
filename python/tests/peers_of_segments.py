"""Domains that others gave, with Triangle and CGAL's Mesh_2 beside.

`python peers_of_segments.py [MESH_2]` prints a table; MESH_2 is the program that the target mesh_2 of
bench builds. Peers run in processes of their own, which may fail, hang or end without a message.
"""

import json
import pathlib
import pickle
import shutil
import subprocess
import sys
import tarfile
import tempfile

import numpy as np

ATLAS = "world-atlas@2.0.2"

# Reads vertices, segments and holes, and an angle; writes the number of vertices.
TRIANGLE = """
import pickle, sys, triangle
domain, options = pickle.load(sys.stdin.buffer)
print(len(triangle.triangulate(domain, options)["vertices"]))
"""


def of_triangle(name):
    """Points, segments and holes of one of Triangle's examples."""
    import triangle

    data = triangle.get_data(name)
    segments = data.get("segments", np.empty((0, 2), np.int32))
    return data["vertices"], np.asarray(segments), data.get("holes", np.empty((0, 2)))


def fetch_atlas(place):
    """The maps of npm's world-atlas; raises OSError, or what the client ends with."""
    if shutil.which("npm") is None:
        raise OSError("npm is not installed")
    subprocess.run(
        ["npm", "pack", "--silent", ATLAS], cwd=place, check=True, capture_output=True, timeout=120
    )
    (package,) = pathlib.Path(place).glob("*.tgz")
    with tarfile.open(package) as archive:
        return {
            pathlib.Path(member.name).stem: json.load(archive.extractfile(member))
            for member in archive
            if member.name.endswith("m.json")
        }


def of_atlas(topology):
    """Points and segments of all arcs of a map, on the integers that it is given in."""
    arcs = [np.cumsum(arc, axis=0) for arc in topology["arcs"]]
    points, at = np.unique(np.concatenate(arcs), axis=0, return_inverse=True)
    ends = np.cumsum([0] + [len(arc) for arc in arcs])
    pairs = [np.stack([at[a : b - 1], at[a + 1 : b]], axis=1) for a, b in zip(ends, ends[1:])]
    pairs = np.sort(np.concatenate(pairs), axis=1)
    return points.astype(float), np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0)


def outcome(command, given, timeout):
    """The number that a process prints, or how it failed."""
    try:
        made = subprocess.run(command, input=given, capture_output=True, timeout=timeout)
    except subprocess.TimeoutExpired:
        return f"no end in {timeout} s"
    if made.returncode:
        return "crashes" if made.returncode < 0 else "fails"
    return int(made.stdout)


def triangles_vertices(points, segments, holes, angle, more="", timeout=60):
    """The number of Triangle's vertices, or how it failed."""
    domain = {"vertices": points, "segments": segments}
    if len(holes):
        domain["holes"] = holes
    given = pickle.dumps((domain, f"pq{angle}Q{more}"))
    return outcome([sys.executable, "-c", TRIANGLE], given, timeout)


def mesh_2s_vertices(program, points, segments, holes, angle, timeout=60):
    """The same of CGAL's Mesh_2."""
    rows = [[len(points), len(segments), len(holes)], *points.tolist(), *segments.tolist()]
    rows += np.asarray(holes).tolist()
    given = "\n".join(" ".join(map(repr, row)) for row in rows)
    return outcome([program, str(angle)], given.encode(), timeout)


def domains(names=("A", "box", "double_hex", "double_hex2", "double_hex3", "face", "la",
                   "square_circle_hole"), maps=()):
    """Name, points, segments, holes."""
    for name in names:
        yield (name, *of_triangle(name))
    with tempfile.TemporaryDirectory() as place:
        atlas = fetch_atlas(place) if maps else {}
    for name in maps:
        yield (name, *of_atlas(atlas[name]), np.empty((0, 2)))


def main(program=None):
    import netmesh

    maps = [f"{what}-{scale}" for what in ("land", "countries") for scale in ("110m", "50m", "10m")]
    print("| domain | segments | degrees | netmesh | Triangle | with -D | Mesh_2 |\n|---|---|---|---|---|---|---|")
    for name, points, segments, holes in domains(maps=maps):
        for angle in (20.7, 30):
            mesh = netmesh.mesh(points, segments, holes=holes, extent="boundary",
                                crossings="split", output="well_spaced", min_angle=angle)
            report = mesh.validate()
            assert (report.level, report.violations) == (3, 0), report.first
            row = [name, len(segments), angle, len(mesh.points)]
            row += [triangles_vertices(points, segments, holes, angle, more) for more in ("", "D")]
            row += [mesh_2s_vertices(program, points, segments, holes, angle) if program else ""]
            cells = (f"{cell:,}" if isinstance(cell, int) else str(cell) for cell in row)
            print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])

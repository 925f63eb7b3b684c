"""Shows how meshes and Delaunay triangulations grow with points on lines, curves and cylinders in space.

    skew.py NETMESH [--sizes 1000,10000,...] [--sets A,B] [--gib G --seconds S] > table.md

Of each set and size there are the mesh, by `netmesh FILE -o -`, and the triangulation, by the same with
`--algorithm delaunay`, which has limits; where it reaches one, larger sizes are not tried. Seconds are those
of the processor in user mode, of whole runs: reading, meshing, measuring the quality and writing VTU, which
nobody keeps (processor seconds, of which the limit is, have the system's as well). Memory is the largest resident size, less that of a run of four points.
"""
import argparse
import re
import subprocess
import tempfile
from pathlib import Path

import numpy as np

MODES = {"mesh": [], "delaunay": ["--algorithm", "delaunay"]}
# Of the mesh, which is expected to need far less: so that a mistake does not take the machine.
GIB, SECONDS = 14, 1200


def skew_lines(n, random):
    """Draws points on two lines a unit apart, whose triangulation has (n/2 - 1)^2 tetrahedra."""
    points = np.zeros((n, 3))
    points[::2, 0] = 2 * random.random(len(points[::2])) - 1
    points[1::2, 1] = 2 * random.random(len(points[1::2])) - 1
    points[1::2, 2] = 1
    return points


def linked_circles(n, random):
    """Draws points on two circles, each through the middle of the other."""
    turn = 2 * np.pi * random.random(n)
    zeros = np.zeros(n)
    first = np.stack([np.cos(turn), np.sin(turn), zeros], axis=1)
    second = np.stack([1 + np.cos(turn), zeros, np.sin(turn)], axis=1)
    return np.where(np.arange(n)[:, None] % 2 == 0, first, second)


def moment_curve(n, random):
    t = 2 * random.random(n) - 1
    return np.stack([t, t**2, t**3], axis=1)


def cylinder_helix(n, _):
    """Returns a scan in one spiral: root n turns of root n points, as far apart along as across
    [Erickson, Nice point sets can have nasty Delaunay triangulations, 2003]."""
    turn = 2 * np.pi * np.arange(n) / np.sqrt(n)
    return np.stack([np.cos(turn), np.sin(turn), turn / np.sqrt(n)], axis=1)


def cylinder_rings(n, _):
    """Returns rings of points above each other: any two rings beside each other are on a sphere."""
    count = round(np.sqrt(n))
    turn = 2 * np.pi * (np.arange(n) % count) / count
    return np.stack([np.cos(turn), np.sin(turn), 2 * np.pi / count * (np.arange(n) // count)], axis=1)


def cylinder_random(n, random):
    turn = 2 * np.pi * random.random(n)
    return np.stack([np.cos(turn), np.sin(turn), 2 * np.pi * random.random(n)], axis=1)


SETS = {
    one.__name__: one
    for one in (skew_lines, linked_circles, moment_curve, cylinder_helix, cylinder_rings, cylinder_random)
}


def run(netmesh, file, mode, gib, seconds):
    """Returns the figures of a run, or the limit that it reached."""
    command = [netmesh, str(file), *MODES[mode], "-o", "-", "--output-format", "vtu"]
    used = file.with_suffix(".time")
    # A child of this process would be told to be as large as this process, which it is when it begins.
    shell = f"ulimit -v {gib * 2**20}; ulimit -t {seconds}; exec /usr/bin/time -f '%U %M' -o {used} \"$@\""
    done = subprocess.run(
        ["sh", "-c", shell, "sh", *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    taken, kib = map(float, used.read_text().splitlines()[-1].split())
    if done.returncode != 0:
        if taken > 0.5 * seconds and "allocation" not in done.stderr:
            return {"failure": f"{seconds} s"}
        if "allocation" in done.stderr:
            return {"failure": f"{gib} GiB"}
        raise SystemExit(f"{' '.join(command)}: status {done.returncode}\n{done.stderr}")
    vertices, simplices = (
        int("".join(re.search(rf"(\d[\d\s]*)\s{word}", done.stderr)[1].split())) for word in ("vert", "simpl")
    )
    return {"vertices": vertices, "simplices": simplices, "seconds": taken, "bytes": kib * 1024}


def cells(figures, n, base):
    """Returns simplices, seconds and bytes of a run, for each point."""
    if "failure" in figures:
        return [figures["failure"], "", ""]
    memory = max(figures["bytes"] - base, 0) / n
    return [f"{figures['simplices'] / n:.1f}", f"{1e6 * figures['seconds'] / n:.0f}", f"{memory:,.0f}"]


def survey(arguments, folder):
    file = folder / "points.xyz"
    np.savetxt(file, np.vstack([np.zeros(3), np.eye(3)]), fmt="%.17g")
    base = run(arguments.netmesh, file, "delaunay", GIB, SECONDS)["bytes"]
    verdicts = []
    print("| points | n | mesh: vertices a point | tetrahedra | us | bytes | Delaunay: tetrahedra a point | us | bytes |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name in arguments.sets.split(","):
        counts, plain = [], {}
        for n in map(int, arguments.sizes.split(",")):
            np.savetxt(file, SETS[name](n, np.random.default_rng(1)), fmt="%.17g")
            mesh = run(arguments.netmesh, file, "mesh", GIB, SECONDS)
            if "failure" not in plain:
                plain = run(arguments.netmesh, file, "delaunay", arguments.gib, arguments.seconds)
            else:
                plain = {"failure": "not tried"}
            share = "" if "failure" in mesh else f"{mesh['vertices'] / n:.2f}"
            row = [name, f"{n:,}", share, *cells(mesh, n, base), *cells(plain, n, base)]
            print(f"| {' | '.join(row)} |", flush=True)
            counts.append(mesh["simplices"] / n if "failure" not in mesh else np.inf)
        verdicts.append(f"{name}: most over least tetrahedra a point of the mesh {max(counts) / min(counts):.2f}")
    print("\n" + "\n".join(verdicts))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("netmesh")
    parser.add_argument("--sizes", default="1000,10000,100000,1000000")
    parser.add_argument("--sets", default=",".join(SETS))
    parser.add_argument("--gib", type=int, default=6)
    parser.add_argument("--seconds", type=int, default=60)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        survey(arguments, Path(folder))


if __name__ == "__main__":
    main()

"""Tells how long it takes to find all pairs of a million triangles that meet.

    pairs.py NETMESH [--triangles N] [--tetgen TETGEN] > table.md

NETMESH and TETGEN are programs; `netmesh --diagnose` tells the pairs, `tetgen -d` is its counterpart.
Spheres of triangles are alone, cross each other along a circle, or have noise of their triangles' size.
"""
import argparse
import re
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np


def sphere(triangles, middle, noise, random):
    """Returns the points and triangles of a sphere of radius 1 by meridians and parallels."""
    rings = int(np.sqrt(triangles / 4))
    around = 2 * rings
    polar = np.pi * np.arange(1, rings) / rings
    angle = 2 * np.pi * np.arange(around) / around
    ring = np.stack(
        [
            np.outer(np.sin(polar), np.cos(angle)),
            np.outer(np.sin(polar), np.sin(angle)),
            np.outer(np.cos(polar), np.ones(around)),
        ],
        axis=2,
    ).reshape(-1, 3)
    points = np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]])
    points *= 1 + noise * random.standard_normal((len(points), 1)) * np.pi / rings
    row, at = np.meshgrid(np.arange(rings - 2), np.arange(around), indexing="ij")
    a, b = row * around + at, row * around + (at + 1) % around
    c, d = a + around, b + around
    top, bottom = len(ring), len(ring) + 1
    first, next_ = np.arange(around), (np.arange(around) + 1) % around
    last = (rings - 2) * around
    faces = np.concatenate(
        [
            np.stack([a, c, b], axis=2).reshape(-1, 3),
            np.stack([b, c, d], axis=2).reshape(-1, 3),
            np.stack([np.full(around, top), first, next_], axis=1),
            np.stack([np.full(around, bottom), last + next_, last + first], axis=1),
        ]
    )
    return points + middle, faces


def write(path, surfaces):
    points, faces, first = [], [], 0
    for own, own_faces in surfaces:
        points.append(own)
        faces.append(own_faces + first)
        first += len(own)
    points, faces = np.concatenate(points), np.concatenate(faces)
    with open(path, "w") as out:
        out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        np.savetxt(out, points, fmt="%.17g")
        np.savetxt(out, np.insert(faces, 0, 3, axis=1), fmt="%d")
    return len(faces)


def timed(command):
    before = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, errors="replace")
    return done.stdout + done.stderr, time.perf_counter() - before


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("netmesh")
    parser.add_argument("--triangles", type=int, default=1_000_000)
    parser.add_argument("--tetgen")
    arguments = parser.parse_args()
    random = np.random.default_rng(1)
    n = arguments.triangles
    kinds = {
        "one sphere": [(n, [0, 0, 0], 0)],
        "two spheres that cross": [(n // 2, [0, 0, 0], 0), (n // 2, [0.31, 0.17, 0.23], 0)],
        "two with noise": [(n // 2, [0, 0, 0], 0.3), (n // 2, [0.31, 0.17, 0.23], 0.3)],
        "a sphere of noise": [(n, [0, 0, 0], 2)],
    }
    print("| surface | triangles | pairs | seconds | TetGen `-d` |\n|---|---|---|---|---|", flush=True)
    for name, spheres in kinds.items():
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "surface.off")
            made = [sphere(*own, random) for own in spheres]
            count = write(path, made)
            text, taken = timed([arguments.netmesh, str(path), "--diagnose", f"{folder}/bad.vtu"])
            pairs = re.findall(r"([\d ]+) pairs? that (?:cross|touch|overlap)", text)
            pairs = sum(int(number.replace(" ", "")) for number in pairs)
            peer = ""
            if arguments.tetgen:
                told, seconds = timed(["timeout", "300", arguments.tetgen, "-d", str(path)])
                peer = f"{seconds:.1f}; {told.strip().splitlines()[-1][:60]}"
            print(f"| {name} | {count:,} | {pairs:,} | {taken:.1f} | {peer} |", flush=True)


if __name__ == "__main__":
    main()

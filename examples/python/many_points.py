"""A large mesh with a line of progress, which Ctrl-C ends: many_points.py [POINTS]

Needs netmesh.
"""
import sys

import netmesh
import numpy as np


# [progress]
def show(progress):
    """Write how far the run is; the library calls it about every 30 ms."""
    if progress.fraction >= 0:
        sys.stderr.write(f"\r{progress.phase:8} {progress.fraction:6.1%} {progress.vertices:12,} vertices")
        sys.stderr.flush()


def main(count=2_000_000):
    """Return the mesh, or None where Ctrl-C has ended the run."""
    points = np.random.default_rng(1).random((count, 3))
    try:
        return netmesh.mesh(points, threads=0, progress=show)
    except KeyboardInterrupt:
        return None
    finally:
        sys.stderr.write("\n")
# [end]


if __name__ == "__main__":
    mesh = main(*map(int, sys.argv[1:2]))
    if mesh is None:
        sys.exit("stopped; nothing is left of the run")
    print(mesh)

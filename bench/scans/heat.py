"""Goes the whole way from scans to a solved heat equation: points, surface, mesh of what is inside, heat in time.

    heat.py INDEX OUT [--scans A,B] [--sets 10000_clean,100000_noise_10] [--picture FILE.png] > table.md

INDEX is the index.json of samples.py. Sets of 100,000 points are thinned as a scan would be: to points no
nearer to each other than 0.8 sampling distances of 10,000 points. Each part begins cold, is held warm at one
end and else insulated; tetrahedra that are flat in a facet are left out. OUT gets a mesh with its temperature
(VTU) for each set; PICTURE shows the parts of the last set, cut open. Ends with 1 unless, of each part,

- the mesh fills what the surface encloses: 1e-10 of the volume is the largest difference;
- a linear temperature that is held at the boundary is solved inside: 1e-8 of its range;
- the heat that came in at the warm end is the heat that the part has: 1e-10;
- every tetrahedron has dihedral angles of 10 degrees, unless all its vertices are on the surface.

Needs the Python package netmesh, scikit-fem, SciPy, and for pictures PyVista. Seconds are those of the processor.
"""
import argparse
import json
import sys
import time
import warnings
from itertools import combinations
from pathlib import Path

import netmesh
import numpy as np
import skfem
from scipy.sparse.linalg import splu
from skfem.models.poisson import laplace, mass

SCANS = ["3holes", "quadknot", "humanoid", "horse", "blub_triangulated"]
DEGREES = 10
# Of the sampling distance of so many points.
THINNED, THINNED_TO = 0.8, 10_000
# Parts of the extent along the longest axis: the warm end, and how far heat goes in all steps.
WARM_END, REACH, STEPS = 0.04, 0.3, 30


def thinned(points, distance):
    """Returns points that are no nearer to each other than the distance, and stand for all."""
    return netmesh.mesh(points, cutoff=distance, algorithm="delaunay").points


def least_angles(mesh):
    """Returns the smallest dihedral angle of each tetrahedron, in degrees."""
    corners = mesh.points[mesh.simplices]
    edges = corners[:, 1:] - corners[:, :1]
    gradients = np.linalg.inv(edges).transpose(0, 2, 1)
    gradients = np.concatenate([-gradients.sum(axis=1, keepdims=True), gradients], axis=1)
    gradients /= np.linalg.norm(gradients, axis=2, keepdims=True)
    cosines = [np.einsum("td,td->t", gradients[:, a], gradients[:, b]) for a, b in combinations(range(4), 2)]
    return 180 - np.degrees(np.arccos(np.clip(cosines, -1, 1))).max(axis=0)


def linear_error(stiffness, points, boundary):
    """Returns the largest error of a linear temperature that the boundary has, relative to its range."""
    exact = points @ [1.0, 2.0, 3.0]
    inside = np.setdiff1d(np.arange(len(points)), boundary)
    if not len(inside):
        return 0.0
    load = -(stiffness[np.ix_(inside, boundary)] @ exact[boundary])
    found = splu(stiffness[np.ix_(inside, inside)].tocsc()).solve(load)
    return float(np.abs(found - exact[inside]).max() / np.ptp(exact))


def warm(stiffness, weights, points):
    """Returns the temperature after the last step, and the heat that came in, by implicit Euler steps."""
    extent = np.ptp(points, axis=0)
    along = points[:, extent.argmax()]
    held = np.flatnonzero(along > along.max() - WARM_END * extent.max())
    free = np.setdiff1d(np.arange(len(points)), held)
    dt = (REACH * extent.max()) ** 2 / STEPS
    system = (weights + dt * stiffness).tocsr()
    factors = splu(system[np.ix_(free, free)].tocsc())
    u, came_in = np.zeros(len(points)), 0.0
    for _ in range(STEPS):
        before = weights @ u
        u = np.zeros(len(points))
        u[held] = 1
        u[free] = factors.solve((before - system @ u)[free])
        # What the held vertices have to be given in this step.
        came_in += (system @ u - before)[held].sum()
    return u, came_in


def solve(mesh):
    """Returns the temperature, and the figures of the checks."""
    with warnings.catch_warnings():
        # Of flat tetrahedra, which are left out.
        warnings.simplefilter("ignore", UserWarning)
        made = mesh.to_skfem().remove_elements(mesh.flat_simplices)
    assert made.nvertices == len(mesh.points)
    basis = skfem.Basis(made, skfem.ElementTetP1())
    stiffness, weights = laplace.assemble(basis).tocsr(), mass.assemble(basis).tocsr()
    boundary = np.unique(mesh.hull.vertices)
    u, came_in = warm(stiffness, weights, mesh.points)
    return u, {
        "linear": linear_error(stiffness, mesh.points, boundary),
        "balance": abs(came_in / (weights @ u).sum() - 1),
        "coldest": float(u.min()),
        "hottest": float(u.max()),
    }


def whole_way(index, record):
    """Returns the mesh, its temperature, and the figures of a scan."""
    points = np.loadtxt(index.parent / record["points"])
    start = time.process_time()
    if record["n"] > THINNED_TO:
        points = thinned(points, THINNED * record["sampling_distance"] * np.sqrt(record["n"] / THINNED_TO))
    surface = netmesh.surface(points)
    surfaced = time.process_time()
    mesh = netmesh.mesh(surface, min_dihedral=DEGREES)
    meshed = time.process_time()
    u, figures = solve(mesh)
    solved = time.process_time()
    angles = least_angles(mesh)
    is_on_surface = np.isin(np.arange(len(mesh.points)), mesh.hull.vertices)[mesh.simplices].all(axis=1)
    return mesh, u, figures | {
        "points": len(points),
        "surface": surface,
        "is_right": sorted(surface.genera, reverse=True) == record["genera"],
        "volume": abs(mesh.volumes.sum() / surface.volume - 1),
        "below": int((angles < DEGREES).sum()),
        "least": float(angles.min()),
        "least_of_others": float(angles[~is_on_surface].min()),
        "seconds": [surfaced - start, meshed - surfaced, solved - meshed],
    }


def is_good(figures):
    return (
        figures["is_right"]
        and max(figures["volume"], figures["balance"]) < 1e-10
        and figures["linear"] < 1e-8
        and figures["least_of_others"] >= DEGREES * (1 - 1e-9)
    )


def row(name, mesh, figures):
    surface = figures["surface"]
    took = " + ".join(f"{seconds:.1f}" for seconds in figures["seconds"])
    return [
        name,
        f"{figures['points']:,}",
        f"{len(surface.faces):,}",
        ", ".join(map(str, surface.genera)) + ("" if figures["is_right"] else " (wrong)"),
        f"{len(surface.left_out)}",
        f"{len(mesh.simplices):,}",
        f"{figures['below']} ({figures['least']:.2g})",
        f"{figures['least_of_others']:.2f}",
        f"{figures['volume']:.0e}, {figures['linear']:.0e}, {figures['balance']:.0e}",
        f"{figures['coldest']:.4f} to {figures['hottest']:.4f}",
        took,
    ]


HEAD = [
    "scan",
    "points",
    "triangles",
    "genus",
    "left out",
    "tetrahedra",
    "below 10 degrees, all vertices on the surface (least)",
    "least of all others",
    "volume, linear, balance",
    "temperature",
    "seconds: surface + mesh + heat",
]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("index", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--scans", default=",".join(SCANS))
    parser.add_argument("--sets", default="10000_clean,100000_noise_10")
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    records = {record["points"]: record for record in json.loads(arguments.index.read_text())}
    print(f"| {' | '.join(HEAD)} |\n{'|---' * len(HEAD)}|")
    good, shown = True, {}
    for kind in arguments.sets.split(","):
        for scan in arguments.scans.split(","):
            mesh, u, figures = whole_way(arguments.index, records[f"{scan}_{kind}.xyz"])
            mesh.export(arguments.out / f"{scan}_{kind}.vtu", attributes={"temperature": u})
            print(f"| {' | '.join(row(f'{scan}_{kind}', mesh, figures))} |", flush=True)
            good &= is_good(figures)
            shown[scan] = mesh, u
    if arguments.picture:
        import heat_picture

        heat_picture.draw(shown, arguments.picture)
    sys.exit(not good)


if __name__ == "__main__":
    main()

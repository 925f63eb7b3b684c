"""The dihedral angles of three meshes of the same points."""

import netmesh
import numpy as np
from look import NETMESH, panels, save

POINTS = 10_000
MESHES = {
    "Delaunay triangulation": {"algorithm": "delaunay"},
    "radius-edge ratio at most 2": {
        "output": "well_spaced",
        "criterion": "radius_edge",
        "quality_bound": 2.0,
    },
    "the same, at least 15 degrees": {
        "output": "well_spaced",
        "criterion": "radius_edge",
        "quality_bound": 2.0,
        "min_dihedral": 15.0,
    },
}


def uniform():
    """Returns points that are uniform in the unit cube, by the generator splitmix64."""
    word = 1 + np.arange(1, 3 * POINTS + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    word = (word ^ (word >> 30)) * np.uint64(0xBF58476D1CE4E5B9)
    word = (word ^ (word >> 27)) * np.uint64(0x94D049BB133111EB)
    return ((word ^ (word >> 31)) >> 11).astype(float).reshape(-1, 3) / 2**53


def draw(out):
    """Draws a histogram for each mesh, of all its simplices, those at the hull too."""
    figure, axes = panels(len(MESHES))
    for ax, (caption, options) in zip(axes, MESHES.items(), strict=True):
        mesh = netmesh.mesh(uniform(), **options)
        counts, edges = mesh.quality_histogram("dihedral_angle", bins=60, hull=True)
        angles = dihedral_angles(mesh.points[mesh.simplices])
        ax.stairs(counts, edges, fill=True, color=NETMESH[0])
        ax.set_title(f"{caption}\n{angles.min():.2f} to {angles.max():.2f} degrees", fontsize=9)
        ax.set_yscale("log")
        ax.set_ylim(1, 1e5)
        ax.minorticks_off()
        ax.set_xticks(range(0, 181, 30))
        ax.set_xlim(0, 180)
        ax.set_xlabel("dihedral angle, degrees")
    save(figure, out)


def dihedral_angles(vertices):
    """Returns the six angles, in degrees, of tetrahedra given as an array (n, 4, 3)."""
    inward = []
    for corner in range(4):
        a, b, c = (vertices[:, other] for other in range(4) if other != corner)
        normal = np.cross(b - a, c - a)
        normal *= np.sign(np.sum(normal * (vertices[:, corner] - a), axis=1))[:, None]
        inward.append(normal / np.linalg.norm(normal, axis=1)[:, None])
    cosines = [-np.sum(inward[i] * inward[j], axis=1) for i in range(4) for j in range(i)]
    return np.degrees(np.arccos(np.clip(cosines, -1, 1)))

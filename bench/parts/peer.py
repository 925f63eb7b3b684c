"""Meshes a surface with PyPI's tetgen, and prints what became of it as JSON.

    peer.py FILE

Bound of the radius-edge ratio 2 (`-pq2`), equal points merged. Counted are cells beyond the bound, and
inner faces whose neighbours' vertices are in each other's circumspheres by more than roundings explain.
"""
import json
import resource
import sys
import time

import numpy as np
import tetgen
import trimesh

FACES = np.array([[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]])
BOUND = 2.0
# A vertex counts as inside a sphere if it is nearer to the centre by more than this part of the radius.
ROUNDING = 1e-9


def circumspheres(corners):
    """Returns centres and radii of tetrahedra, with NaN for flat ones."""
    edges = corners[:, 1:] - corners[:, :1]
    squares = (edges**2).sum(axis=2)
    with np.errstate(all="ignore"):
        numerator = sum(
            squares[:, k, None] * np.cross(edges[:, (k + 1) % 3], edges[:, (k + 2) % 3]) for k in range(3)
        )
        determinant = np.einsum("ij,ij->i", edges[:, 0], np.cross(edges[:, 1], edges[:, 2]))
        ways = numerator / (2 * determinant[:, None])
    return corners[:, 0] + ways, np.linalg.norm(ways, axis=1)


def dihedral_angles(corners):
    """Returns the six dihedral angles of each tetrahedron, in degrees."""
    turned = np.cross(
        corners[:, FACES[:, 1]] - corners[:, FACES[:, 0]], corners[:, FACES[:, 2]] - corners[:, FACES[:, 0]]
    )
    with np.errstate(all="ignore"):
        turned /= np.linalg.norm(turned, axis=2, keepdims=True)
    pairs = [(i, j) for i in range(4) for j in range(i)]
    cosines = np.stack([-(turned[:, i] * turned[:, j]).sum(axis=1) for i, j in pairs], axis=1)
    return np.degrees(np.arccos(np.clip(cosines, -1, 1)))


def inner_faces_that_are_not_delaunay(points, cells, centers, radii):
    faces = np.sort(cells[:, FACES].reshape(-1, 3), axis=1)
    order = np.lexsort(faces.T[::-1])
    same = (faces[order][1:] == faces[order][:-1]).all(axis=1)
    first, second = order[:-1][same], order[1:][same]
    apex = cells[second // 4, second % 4]
    own = first // 4
    distance = np.linalg.norm(points[apex] - centers[own], axis=1)
    return int((distance < (1 - ROUNDING) * radii[own]).sum())


def main(path):
    surface = trimesh.load(path, process=False, force="mesh")
    vertices, number = np.unique(np.asarray(surface.vertices), axis=0, return_inverse=True)
    mesher = tetgen.TetGen(vertices, number.reshape(-1)[surface.faces].astype(np.int32))
    before = time.process_time()
    mesher.tetrahedralize(plc=True, quality=True, minratio=BOUND, mindihedral=0, order=1, quiet=True)
    seconds = time.process_time() - before
    points, cells = np.array(mesher.node), np.array(mesher.elem)
    corners = points[cells]
    centers, radii = circumspheres(corners)
    pairs = [(i, j) for i in range(4) for j in range(i)]
    shortest = np.min([np.linalg.norm(corners[:, i] - corners[:, j], axis=1) for i, j in pairs], axis=0)
    record = {
        "points": len(vertices),
        "vertices": len(points),
        "seconds": seconds,
        "peak_mib": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "beyond_bound": int((~(radii <= 1.001 * BOUND * shortest)).sum()),
        "not_delaunay": inner_faces_that_are_not_delaunay(points, cells, centers, radii),
        "min_angle_degrees": float(dihedral_angles(corners).min()),
    }
    print(json.dumps(record))


main(sys.argv[1])

"""Tells how well a triangle mesh is the surface that its points were drawn on.

    measures.py MESH INDEX [POINTS]

MESH is an OFF, PLY, STL or OBJ file, INDEX the index.json of samples.py, POINTS the name of the points
there, which is that of MESH if left out. Prints JSON. Distances are in sampling distances.
"""
import json
import sys
from functools import lru_cache
from pathlib import Path

import numpy as np
import open3d
import trimesh
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from samples import draw, read_result, read_surface

# Samples that distances are taken from, beside vertices and middles of triangles.
SAMPLES = 200_000
# A vertex is a given point if they differ by less than this part of the sampling distance.
SAME = 1e-4


def components(count, pairs):
    """Returns the number of components of a graph and that of each node."""
    ones = np.ones(len(pairs), dtype=bool)
    graph = coo_matrix((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return connected_components(graph, directed=False)


def pairs_at_edges(faces):
    """Returns the triangles on an edge, each with its next one there, and the numbers of triangles.

    A pair is two indices of half-edges, of which 3 f + k leads from corner k of triangle f to the next.
    """
    tails, heads = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    edges = np.sort(np.stack([tails, heads], axis=1), axis=1)
    order = np.lexsort(edges.T)
    is_same = (edges[order][1:] == edges[order][:-1]).all(axis=1)
    pairs = np.stack([order[:-1][is_same], order[1:][is_same]], axis=1)
    _, number = np.unique(edges, axis=0, return_counts=True)
    return pairs, number, tails


def umbrellas(faces, pairs, tails):
    """Returns the number of fans of triangles and the fan of each corner."""
    following = lambda half: half // 3 * 3 + (half + 1) % 3  # noqa: E731
    first, second = pairs.T
    is_along = tails[first] == tails[second]
    tail_of_second = np.where(is_along, second, following(second))
    head_of_second = np.where(is_along, following(second), second)
    joined = np.vstack([
        np.stack([first, tail_of_second], axis=1),
        np.stack([following(first), head_of_second], axis=1),
    ])
    return components(3 * len(faces), joined)


def is_orientable(faces, pairs, tails, number):
    """Returns true if turning triangles makes both triangles of each edge run against each other."""
    if (number > 2).any():
        return False
    count = len(faces)
    first, second = pairs.T
    turned = np.where(tails[first] == tails[second], count, 0)
    joined = np.vstack([
        np.stack([first // 3, second // 3 + turned], axis=1),
        np.stack([first // 3 + count, second // 3 + count - turned], axis=1),
    ])
    _, label = components(2 * count, joined)
    return bool((label[:count] != label[count:]).all())


def shape(faces):
    """Returns what kind of a surface the triangles are; a genus is None where a part is not closed."""
    pairs, number, tails = pairs_at_edges(faces)
    fans, fan = umbrellas(faces, pairs, tails)
    parts, part = components(len(faces), pairs // 3)
    has_repeats = bool((faces == np.roll(faces, 1, axis=1)).any())
    record = {
        "triangles": len(faces),
        "vertices": len(np.unique(faces)),
        "boundary_edges": int((number == 1).sum()),
        "edges_of_many": int((number > 2).sum()),
        "watertight": bool((number == 2).all()) and not has_repeats,
        "split_vertices": fans - len(np.unique(faces)),
        "orientable": is_orientable(faces, pairs, tails, number),
        "components": parts,
    }
    record["manifold"] = record["watertight"] and record["split_vertices"] == 0
    # Vertices are counted by fans, so that parts that touch at a vertex do not change each other.
    part_of_fan = np.zeros(fans, dtype=int)
    part_of_fan[fan] = np.repeat(part, 3)
    euler = np.bincount(part_of_fan, minlength=parts) - np.bincount(part, minlength=parts) // 2
    is_closed = record["watertight"] and record["orientable"]
    record["genera"] = sorted(((2 - euler) // 2).tolist(), reverse=True) if is_closed else None
    return record


class Target:
    """A surface that distances are taken to, with samples that they are taken from."""

    def __init__(self, mesh, seed):
        drawn, _ = draw(mesh, SAMPLES, np.random.default_rng(seed))
        self.samples = np.vstack([drawn, mesh.vertices, mesh.triangles.mean(axis=1)])
        # The scene has single precision, which is used best about the origin and at size 1.
        self.center, self.scale = mesh.bounds.mean(axis=0), mesh.extents.max()
        self.scene = open3d.t.geometry.RaycastingScene()
        self.scene.add_triangles(self._single(mesh.vertices), open3d.core.Tensor(mesh.faces.astype(np.uint32)))

    def _single(self, points):
        return open3d.core.Tensor(((points - self.center) / self.scale).astype(np.float32))

    def distances(self, points):
        """Returns the distances of points, right to 1e-6 of the size, less so at needles (0.01 sampling distances)."""
        return self.scene.compute_distance(self._single(points)).numpy() * self.scale


@lru_cache(maxsize=2)
def original(path):
    """Returns the surface that points were drawn on, as a target."""
    return Target(read_surface(path), 1)


@lru_cache(maxsize=2)
def given_points(path):
    return np.loadtxt(path, ndmin=2)


def usage(vertices, record):
    """Returns the fraction of the points that are vertices, and the number of outliers that are."""
    points = given_points(record["points"])
    distance, _ = cKDTree(vertices).query(points)
    is_used = distance < SAME * record["sampling_distance"]
    return {
        "points_used": float(is_used[: record["n"]].mean()),
        "outliers_used": int(is_used[record["n"] :].sum()),
    }


def measure(vertices, faces, record):
    """Returns the measures of a mesh of the points of a record of samples.py."""
    vertices, faces = np.asarray(vertices, dtype=float), np.asarray(faces, dtype=int).reshape(-1, 3)
    if len(faces) == 0:
        return {"triangles": 0, "watertight": False, "manifold": False, "topology_right": False}
    used, number = np.unique(faces, return_inverse=True)
    vertices, faces = vertices[used], number.reshape(-1, 3)
    result = shape(faces)
    is_right = result["manifold"] and result["orientable"] and result["genera"] == record["genera"]
    result["topology_right"] = is_right
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    true_target = original(record["surface"])
    own_target = Target(mesh, 2)
    there = true_target.distances(own_target.samples) / record["sampling_distance"]
    back = own_target.distances(true_target.samples) / record["sampling_distance"]
    result |= {
        "largest_to_truth": float(there.max()),
        "mean_to_truth": float(there[:SAMPLES].mean()),
        "largest_from_truth": float(back.max()),
        "mean_from_truth": float(back[:SAMPLES].mean()),
    }
    return result | usage(vertices, record)


def find_record(index, name):
    """Returns the record of the points with that name, whose paths are then full."""
    index = Path(index)
    for record in json.loads(index.read_text()):
        if Path(record["points"]).stem == Path(name).stem:
            return record | {"points": str(index.parent / record["points"])}
    raise SystemExit(f"{index} has no points named {Path(name).stem}")


def main():
    if len(sys.argv) not in (3, 4):
        raise SystemExit(__doc__)
    mesh = read_result(sys.argv[1])
    record = find_record(sys.argv[2], sys.argv[-1] if len(sys.argv) == 4 else sys.argv[1])
    print(json.dumps(measure(mesh.vertices, mesh.faces, record), indent=1))


if __name__ == "__main__":
    main()

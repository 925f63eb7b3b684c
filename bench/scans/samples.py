"""Draws points on closed surfaces: the scans that reconstructions are judged by.

    samples.py FOLDER OUT [--sizes 10000,100000] [--list]

FOLDER holds the test surfaces. Of each surface in SURFACES there come its vertices and, for each size,
four sets that are drawn by area: clean, with Gaussian noise of 0.1 and of 0.3 sampling distances in each
coordinate, and with 1 % of outliers, which are uniform in 1.2 times the bounding box and come last.
OUT/index.json has one record a set. The sampling distance is the root of area over points. `--list`
prints the table of the surfaces only.
"""
import argparse
import json
from pathlib import Path

import numpy as np
import trimesh

# The second is true where the vertices alone sample the surface: of its edges 99 % are shorter than
# 2.5 sampling distances, and no thin part is sampled at its corners only.
SURFACES = {
    "cinolib/3holes.obj": True,
    "cinolib/bamboo_pen.obj": False,
    "cinolib/blub_triangulated.obj": True,
    "cinolib/cactus.off": True,
    "cinolib/cube_minus_sphere.obj": True,
    "cinolib/cubespikes.obj": True,
    "cinolib/humanoid.off": True,
    "manifold/hull-body.obj": False,
    "trimesh/plate_holes.STL": False,
    "trimesh/quadknot.obj": True,
    "trimesh/torus.STL": True,
    "vtkdata/horse.ply": True,
}
KINDS = {"clean": (0, 0), "noise_10": (0.1, 0), "noise_30": (0.3, 0), "outliers": (0, 0.01)}
OUTLIER_BOX = 1.2


def read_surface(path, merges=True):
    """Returns a triangle mesh without unused vertices; equal points are one vertex if `merges`."""
    mesh = trimesh.load(path, process=False, force="mesh")
    used, number = np.unique(mesh.faces, return_inverse=True)
    vertices, faces = np.asarray(mesh.vertices)[used], number.reshape(-1, 3)
    if merges:
        vertices, merged = np.unique(vertices, axis=0, return_inverse=True)
        faces = merged.reshape(-1)[faces]
    return trimesh.Trimesh(vertices, faces, process=False)


def read_result(path):
    """Returns the mesh of a tool, whose vertices are those of the file; STL has points only."""
    return read_surface(path, Path(path).suffix.lower() == ".stl")


def draw(mesh, count, random):
    """Returns points that are uniform on the surface, and the triangle of each."""
    bounds = np.cumsum(mesh.area_faces)
    triangle = np.searchsorted(bounds, random.random(count) * bounds[-1], side="right")
    triangle = np.minimum(triangle, len(bounds) - 1)
    weights = random.random((count, 2))
    weights[weights.sum(axis=1) > 1] = 1 - weights[weights.sum(axis=1) > 1]
    corners = mesh.triangles[triangle]
    edges = corners[:, 1:] - corners[:, :1]
    return corners[:, 0] + np.einsum("ij,ijk->ik", weights, edges), triangle


def outliers(mesh, count, random):
    low, high = mesh.bounds
    center, extent = (low + high) / 2, (high - low) * OUTLIER_BOX
    return center + (random.random((count, 3)) - 0.5) * extent


def topology(mesh):
    """Returns the genus of each component, largest first."""
    parts = trimesh.graph.connected_component_labels(mesh.face_adjacency, node_count=len(mesh.faces))
    genera = []
    for part in range(parts.max() + 1):
        faces = mesh.faces[parts == part]
        edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        euler = len(np.unique(faces)) - len(np.unique(edges, axis=0)) + len(faces)
        genera.append((2 - euler) // 2)
    return sorted((int(genus) for genus in genera), reverse=True)


def edge_ratio(mesh):
    """Returns the 99th percentile of the edges in sampling distances of the vertices."""
    distance = np.sqrt(mesh.area / len(mesh.vertices))
    return float(np.percentile(mesh.edges_unique_length, 99) / distance)


def point_sets(mesh, name, sizes):
    """Yields the points and the record of each set of a surface."""
    yield np.asarray(mesh.vertices), {"kind": "vertices", "n": len(mesh.vertices), "noise": 0, "outliers": 0}
    for count in sizes:
        for number, (kind, (noise, part)) in enumerate(KINDS.items()):
            random = np.random.default_rng([list(SURFACES).index(name), count, number])
            points, _ = draw(mesh, count, random)
            points += noise * np.sqrt(mesh.area / count) * random.standard_normal(points.shape)
            far = outliers(mesh, round(part * count), random)
            record = {"kind": kind, "n": count, "noise": noise, "outliers": len(far)}
            yield np.vstack([points, far]), record


def print_list(folder):
    print("| surface | vertices | triangles | components | genus | edges (99 %) / distance | vertices suffice |")
    print("|---|---|---|---|---|---|---|")
    for name, is_dense in SURFACES.items():
        mesh = read_surface(folder / name)
        genera = topology(mesh)
        told = ", ".join(str(genus) for genus in genera)
        print(
            f"| {name} | {len(mesh.vertices)} | {len(mesh.faces)} | {len(genera)} | {told} "
            f"| {edge_ratio(mesh):.1f} | {'yes' if is_dense else 'no'} |"
        )


def write_samples(folder, out, sizes):
    out.mkdir(parents=True, exist_ok=True)
    index = []
    for name, is_dense in SURFACES.items():
        mesh = read_surface(folder / name)
        genera = topology(mesh)
        for points, record in point_sets(mesh, name, sizes):
            is_vertices = record["kind"] == "vertices"
            size = "" if is_vertices else f"_{record['n']}"
            file = out / f"{Path(name).stem}{size}_{record['kind']}.xyz"
            file.write_text("".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points.tolist()))
            record |= {
                "points": file.name,
                "surface": str((folder / name).resolve()),
                "sampling_distance": float(np.sqrt(mesh.area / record["n"])),
                "components": len(genera),
                "genera": genera,
                "is_dense": is_dense or not is_vertices,
            }
            index.append(record)
    (out / "index.json").write_text(json.dumps(index, indent=1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("out", type=Path, nargs="?")
    parser.add_argument("--sizes", default="10000,100000")
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args()
    if arguments.list or not arguments.out:
        return print_list(arguments.folder)
    write_samples(arguments.folder, arguments.out, [int(size) for size in arguments.sizes.split(",")])


if __name__ == "__main__":
    main()

"""Makes a surface through points with PyPI's open3d or pymeshlab, and prints the seconds as JSON.

    peers.py TOOL POINTS.xyz OUT.off

TOOL is open3d-poisson, open3d-ball, pymeshlab-poisson or pymeshlab-ball. The points come without
normals; open3d estimates them and makes them agree, which pymeshlab's tools are given as well. Seconds
are those of the processor, with the normals and without files; OMP_NUM_THREADS=1 keeps others from waiting.
"""
import json
import sys
import time

import numpy as np
import open3d
import pymeshlab
import trimesh

NEIGHBORS = 20
# Radii of open3d's balls in mean distances to the nearest point.
RADII = np.array([1, 2, 4])
# Cells of Poisson's octree on the mean distance to the nearest point, at least.
CELLS = 2


def with_normals(points):
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(NEIGHBORS))
    cloud.orient_normals_consistent_tangent_plane(NEIGHBORS)
    return cloud


def spacing(cloud):
    return float(np.mean(cloud.compute_nearest_neighbor_distance()))


def depth(cloud):
    extent = (cloud.get_max_bound() - cloud.get_min_bound()).max()
    return int(np.clip(np.ceil(np.log2(CELLS * extent / spacing(cloud))), 6, 10))


def arrays(mesh):
    return np.asarray(mesh.vertices), np.asarray(mesh.triangles)


def open3d_poisson(points):
    cloud = with_normals(points)
    mesh, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=depth(cloud))
    return arrays(mesh)


def open3d_ball(points):
    cloud = with_normals(points)
    radii = open3d.utility.DoubleVector(RADII * spacing(cloud))
    return arrays(open3d.geometry.TriangleMesh.create_from_point_cloud_ball_pivoting(cloud, radii))


def by_pymeshlab(cloud, run):
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(np.asarray(cloud.points), v_normals_matrix=np.asarray(cloud.normals)))
    run(meshes)
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix(), mesh.face_matrix()


def pymeshlab_poisson(points):
    cloud = with_normals(points)
    options = {"depth": depth(cloud), "threads": 1}
    run = lambda meshes: meshes.generate_surface_reconstruction_screened_poisson(**options)  # noqa: E731
    return by_pymeshlab(cloud, run)


def pymeshlab_ball(points):
    run = lambda meshes: meshes.generate_surface_reconstruction_ball_pivoting()  # noqa: E731
    return by_pymeshlab(with_normals(points), run)


def main():
    tools = {tool.__name__: tool for tool in (open3d_poisson, open3d_ball, pymeshlab_poisson, pymeshlab_ball)}
    if len(sys.argv) != 4 or sys.argv[1].replace("-", "_") not in tools:
        raise SystemExit(__doc__)
    points = np.loadtxt(sys.argv[2])
    before = time.process_time()
    vertices, faces = tools[sys.argv[1].replace("-", "_")](points)
    seconds = time.process_time() - before
    trimesh.Trimesh(vertices, faces, process=False).export(sys.argv[3], digits=17)
    print(json.dumps({"seconds": seconds}))


main()

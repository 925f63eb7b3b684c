"""Meshes a numpy array through the shared library: mesh_array.py LIBRARY"""
import sys

# [binding]
import ctypes
import numpy as np


class Counts(ctypes.Structure):  # nm_counts
    _fields_ = [("struct_size", ctypes.c_uint32), ("dim", ctypes.c_uint32)] + [
        (name, ctypes.c_uint64)
        for name in ("inputs", "duplicates", "vertices", "simplices", "domains")
    ]


def netmesh(library, points):
    """Vertices (v x dim) and simplices (s x (dim + 1)) of the mesh of points (n x dim)."""
    points = np.ascontiguousarray(points, dtype=np.float64)
    size, dim = points.shape
    mesh = ctypes.c_void_p()

    def call(name, *arguments):
        if getattr(library, name)(*arguments) != 0:
            message = ctypes.create_string_buffer(512)
            library.nm_last_error(message, ctypes.c_size_t(len(message)))
            raise ValueError(message.value.decode())

    def array(getter, rows, columns, kind):
        out = np.empty((rows, columns), dtype=kind)
        call(getter, mesh, out.ctypes.data_as(ctypes.c_void_p), ctypes.c_uint64(out.size), None)
        return out

    call("nm_mesh_create", ctypes.c_uint32(dim), ctypes.c_size_t(size),
         points.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(0), ctypes.byref(mesh))
    try:
        call("nm_run", mesh, None)
        counts = Counts(ctypes.sizeof(Counts))
        call("nm_mesh_counts", mesh, ctypes.byref(counts))
        return (array("nm_mesh_get_points", counts.vertices, dim, np.float64),
                array("nm_mesh_get_simplices", counts.simplices, dim + 1, np.uint32))
    finally:
        library.nm_mesh_free(mesh)
# [end]


def expect(holds, what):
    if not holds:
        sys.exit(f"this does not hold: {what}")


def main():
    # [use]
    library = ctypes.CDLL(sys.argv[1])  # libnetmesh.so.1
    points = np.random.default_rng(1).normal(size=(500, 3))
    vertices, tetrahedra = netmesh(library, points)
    edges = vertices[tetrahedra[:, 1:]] - vertices[tetrahedra[:, :1]]
    volumes = np.linalg.det(edges) / 6
    # [end]
    expect((vertices[: len(points)] == points).all(), "the inputs are the first vertices")
    expect((volumes > 0).all(), "simplices are positively oriented")
    box = np.ptp(points, axis=0).prod()
    expect(volumes.sum() > box, "the mesh covers the box of the inputs")
    every_other = points[::2]
    expect((netmesh(library, every_other)[0][: len(every_other)] == every_other).all(),
           "arrays with strides are meshed")
    try:
        netmesh(library, [[0.0, np.nan], [1.0, 1.0]])
        expect(False, "what is not finite is refused")
    except ValueError as refusal:
        print("refused:", refusal)
    print(len(vertices), "vertices,", len(tetrahedra), "tetrahedra")


if __name__ == "__main__":
    main()

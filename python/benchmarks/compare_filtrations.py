"""Filtrations of meshes beside alpha filtrations: python compare_filtrations.py [--scale S] [DATA...].

For each set: how far the diagrams of the mesh are from those of the Delaunay triangulation, as the
logarithmic bottleneck distance over the proven bound, log(factor), and how many of the features that
last longer than factor**2 the mesh has; then faces and seconds of both. DATA are files of points. Last
the sets where the Delaunay triangulation explodes, by size alone. Needs gudhi.
"""

import argparse
import math
import time

import gudhi
import netmesh
import numpy as np


def on_circle(random, count):
    angle = 2 * np.pi * random.random(count)
    return np.c_[np.cos(angle), np.sin(angle)]


def on_sphere(random, count, dim):
    points = random.normal(size=(count, dim))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def torus(random, count, thin):
    (u, v) = 2 * np.pi * random.random((2, count))
    wide = 1 + thin * np.cos(v)
    return np.c_[wide * np.cos(u), wide * np.sin(u), thin * np.sin(v)]


def shapes(random, scale):
    """Name and points of each set."""
    n = lambda count: max(20, int(count * scale))
    circle = on_circle(random, n(400))
    yield "circle", circle
    yield "noisy circle", circle + 0.05 * random.normal(size=circle.shape)
    yield "annulus", circle * (1 + 0.5 * random.random((len(circle), 1)))
    t = 2 * np.pi * random.random(n(400))
    yield "figure eight", np.c_[np.sin(t), np.sin(t) * np.cos(t)]
    yield "two circles", np.r_[circle, 0.2 * on_circle(random, n(200)) + [2, 0]]
    yield "spiral", np.c_[t * np.cos(3 * t), t * np.sin(3 * t)]
    centers = random.random((8, 2))
    clusters = centers[random.integers(8, size=n(400))]
    yield "clusters 2D", clusters + 10.0 ** random.integers(-5, -1, (len(clusters), 1)) * (
        random.normal(size=clusters.shape)
    )
    yield "uniform 2D", random.random((n(400), 2))
    yield "sphere", on_sphere(random, n(400), 3)
    yield "noisy sphere", on_sphere(random, n(400), 3) + 0.02 * random.normal(size=(n(400), 3))
    yield "torus", torus(random, n(800), 0.4)
    yield "linked circles", np.r_[
        np.c_[circle, 0 * circle[:, 0]], np.c_[1 + circle[:, 0], 0 * t[: len(circle)], circle[:, 1]]
    ]
    yield "helix", np.c_[np.cos(4 * t), np.sin(4 * t), t / 3]
    yield "cube's edges", np.r_[
        *(np.insert(random.random((n(400) // 12, 1)), [0, 1], corner, axis=1)[:, order]
          for corner in ([0, 0], [0, 1], [1, 0], [1, 1])
          for order in ([0, 1, 2], [0, 2, 1], [1, 0, 2]))
    ]
    yield "clusters 3D", random.integers(3, size=(n(300), 3)) + 0.01 * random.normal(size=(n(300), 3))
    yield "uniform 3D", random.random((n(300), 3))
    (u, v) = 2 * np.pi * random.random((2, n(150)))
    yield "Clifford torus", np.c_[np.cos(u), np.sin(u), np.cos(v), np.sin(v)]
    yield "sphere 4D", on_sphere(random, n(100), 4)
    moments = random.random(n(100))
    yield "curve 4D", np.c_[moments, moments**2, moments**3, moments**4]
    yield "circle 4D", np.c_[on_circle(random, n(100)), np.zeros((n(100), 2))] + (
        0.01 * random.normal(size=(n(100), 4))
    )


def exploding(scale):
    """Sets whose Delaunay triangulation is of quadratic size, with its count of simplices."""
    t = np.linspace(0, 1, int(8000 * scale))
    zero = np.zeros(len(t))
    lines = np.r_[np.c_[t, zero, zero], np.c_[zero, t, zero + 1]]
    # Each segment of one line makes a tetrahedron with each of the other.
    yield "two skew lines", lines, (len(t) - 1) ** 2
    t = np.linspace(0, 1, int(3000 * scale))
    yield "curve 4D", np.c_[t, t**2, t**3, t**4], None


def timed(call):
    start = time.perf_counter()
    return call(), time.perf_counter() - start


def made(points, kind):
    options = {"algorithm": "delaunay"} if kind == "alpha" else {"output": "well_spaced"}
    return netmesh.mesh(points, **options).filtration(kind)


def diagrams(filtration):
    """The diagrams in logarithms of radii, without what lasts for ever or not at all."""
    tree = filtration.to_gudhi()
    tree.compute_persistence()
    for k in range(filtration.dim):
        pairs = tree.persistence_intervals_in_dimension(k).reshape(-1, 2)
        pairs = np.sqrt(pairs) if filtration.kind == "alpha" else pairs
        pairs = pairs[np.isfinite(pairs[:, 1]) & (pairs[:, 1] > pairs[:, 0])]
        # Inputs are born at 0, which has no logarithm: only deaths differ.
        yield np.log(np.where(pairs == 0, 1e-12, pairs))


def count(filtration):
    return sum(len(filtration.values(k)) for k in range(filtration.dim + 1))


def compare(name, points):
    points = np.unique(points, axis=0)
    alpha, alpha_seconds = timed(lambda: made(points, "alpha"))
    near, near_seconds = timed(lambda: made(points, "mesh"))
    bound = math.log(near.factor)
    worst, long, found = 0.0, 0, 0
    for ours, exact in zip(diagrams(near), diagrams(alpha)):
        worst = max(worst, gudhi.bottleneck_distance(ours, exact, 0))
        long += (exact[:, 1] - exact[:, 0] > 2 * bound).sum()
        for birth, death in exact[exact[:, 1] - exact[:, 0] > 2 * bound]:
            gap = np.abs(ours - [birth, death]).max(axis=1, initial=0)
            found += (gap <= bound * (1 + 1e-9)).any()
    print(
        f"{name:20} {points.shape[1]}D {len(points):6} points | factor {near.factor:.3f}, distance "
        f"{worst / bound:.2f} of its logarithm, {found} of {long} long features | faces "
        f"{count(near):8} mesh, {count(alpha):8} Delaunay, {count(near) / count(alpha):6.2f} | "
        f"{near_seconds:.3f} s, {alpha_seconds:.3f} s",
        flush=True,
    )
    assert worst <= bound * (1 + 1e-9) and found == long, name


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("data", nargs="*")
    arguments = parser.parse_args()
    random = np.random.default_rng(1)
    for name, points in shapes(random, arguments.scale):
        compare(name, points)
    for path in arguments.data:
        delimiter = "," if path.endswith(".csv") else None
        points = np.genfromtxt(path, delimiter=delimiter)
        points = points[np.isfinite(points).all(axis=1)]
        compare(path.rsplit("/", 1)[-1], points[:: max(1, len(points) // 1500)])
    for name, points, simplices in exploding(arguments.scale):
        mesh, seconds = timed(lambda: netmesh.mesh(points, output="well_spaced"))
        if simplices is None:
            simplices = len(netmesh.mesh(points, algorithm="delaunay").simplices)
        print(
            f"{name:20} {points.shape[1]}D {len(points):6} points | {len(mesh.simplices)} simplices in "
            f"{seconds:.2f} s, {simplices / len(mesh.simplices):.1f} times as many in Delaunay",
            flush=True,
        )


main()

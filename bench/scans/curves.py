"""Draws points on curves of the plane whose order is known.

    curves.py OUT [--coast FILE.geojson] [--gshhs FOLDER]

Smooth curves (circles, ellipses, a flower, an open spiral) are sampled such that no point of the curve is
farther from its nearest sample than a ratio of its local feature size: with steps as long as that lets them
be, and with random ones. Polygons with corners have even steps. Coasts are polygons whose vertices are the
points, or that are cut into even steps of half and of an eighth of their median edge; they come from a
GeoJSON polygon, and from the low resolution of the GSHHS files of matplotlib's basemap. OUT/index.json tells
the edges between the points of each set, which are shuffled.
"""
import argparse
import json
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

RATIOS = [0.1, 0.2, 0.25, 0.33, 0.4, 0.5, 0.7, 0.9]
CORNERS = [120, 90, 60, 30, 10]
# Points that stand for a smooth curve, and those whose medial balls are found.
DENSE, MEDIAL = 100_000, 4_000
# GSHHS's land by area: the islands after the continents, and as many points at least for all of them.
ISLANDS, LEAST_OF_COAST = range(6, 14), 20


def ellipse(length):
    return lambda t: np.stack([length * np.cos(t), np.sin(t)], axis=1), 2 * np.pi, True


def flower(t):
    return (1 + 0.3 * np.cos(5 * t))[:, None] * np.stack([np.cos(t), np.sin(t)], axis=1)


def spiral(t):
    return (0.5 + t / (2 * np.pi))[:, None] * np.stack([np.cos(t), np.sin(t)], axis=1)


SMOOTH = {
    "circle": ellipse(1),
    "ellipse_2": ellipse(2),
    "ellipse_10": ellipse(10),
    "flower": (flower, 2 * np.pi, True),
    "spiral": (spiral, 12 * np.pi, False),
}


def medial_centers(points, tangents):
    """Returns centres of the largest empty circles that touch the curve at points, on both sides."""
    centers = []
    normals = np.stack([-tangents[:, 1], tangents[:, 0]], axis=1)
    for point, normal in zip(points, normals):
        ways = points - point
        heights = ways @ normal
        with np.errstate(all="ignore"):
            radii = (ways**2).sum(axis=1) / (2 * heights)
        for side in (1, -1):
            own = side * radii
            own = own[own > 0]
            if len(own):
                centers.append(point + side * own.min() * normal)
    return np.array(centers)


def local_feature_sizes(curve, end, is_closed):
    """Returns a dense curve and its distance to the medial axis at each point."""
    sparse = np.linspace(0, end, MEDIAL, endpoint=not is_closed)
    step = end / DENSE
    tangents = curve(sparse + step) - curve(sparse - step)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    dense = curve(np.linspace(0, end, DENSE, endpoint=not is_closed))
    sizes, _ = cKDTree(medial_centers(curve(sparse), tangents)).query(dense)
    return dense, sizes


def is_covered(dense, sizes, ratio, first, last):
    """Returns true if every point between two samples is near one of them."""
    between = np.arange(first, last + 1) % len(dense)
    ends = dense[[first, last % len(dense)]]
    near = np.linalg.norm(dense[between, None] - ends[None], axis=2).min(axis=1)
    return bool((near <= ratio * sizes[between]).all())


def farthest(dense, sizes, ratio, first, stop):
    """Returns the last dense point that may be the next sample."""
    low, high = first + 1, first + 2
    while high < stop and is_covered(dense, sizes, ratio, first, high):
        low, high = high, first + 2 * (high - first)
    high = min(high, stop)
    while low < high:
        middle = (low + high + 1) // 2
        if is_covered(dense, sizes, ratio, first, middle):
            low = middle
        else:
            high = middle - 1
    return low


def sample(dense, sizes, ratio, is_closed, random):
    """Returns samples in order; steps are the longest ones without `random`."""
    stop = len(dense) if is_closed else len(dense) - 1
    chosen = [0]
    while chosen[-1] < stop:
        step = farthest(dense, sizes, ratio, chosen[-1], stop) - chosen[-1]
        if random:
            step = max(1, int(step * random.uniform(0.2, 1)))
        chosen.append(chosen[-1] + step)
    return dense[chosen[:-1] if is_closed else chosen]


def even_steps(polygon, step):
    """Returns a closed polygon whose edges are cut evenly into pieces that are no longer."""
    points = []
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0)):
        count = max(1, int(np.ceil(np.linalg.norm(end - start) / step)))
        points.append(start + (end - start) * (np.arange(count) / count)[:, None])
    return np.vstack(points)


def corner(degrees, is_sampled):
    """Returns points of an isosceles triangle with that angle; its corners are left out unless sampled."""
    half = np.radians(degrees) / 2
    polygon = np.array([[0, 0], [np.sin(half), -np.cos(half)], [-np.sin(half), -np.cos(half)]])
    if is_sampled:
        return even_steps(polygon, 0.05)
    points = even_steps(polygon, 0.05)
    return (points + np.roll(points, -1, axis=0)) / 2


def gshhs(folder):
    """Yields the rings of land, the largest first."""
    lines = [line.split() for line in (folder / "gshhsmeta_l.dat").read_text().splitlines()]
    data = (folder / "gshhs_l.dat").read_bytes()
    for line in sorted(lines, key=lambda line: -float(line[1])):
        if line[0] == "1":
            ring = np.frombuffer(data, "<f4", 2 * int(line[2]), int(line[5])).reshape(-1, 2)
            ring = np.float64(ring)
            yield ring[:-1] if (ring[0] == ring[-1]).all() else ring


def coasts(arguments):
    """Yields the name and rings of each coast."""
    if arguments.coast:
        feature = json.loads(arguments.coast.read_text())
        yield arguments.coast.stem, [np.array(ring)[:-1] for ring in feature["geometry"]["coordinates"]]
    if arguments.gshhs:
        rings = list(gshhs(arguments.gshhs))
        for number in ISLANDS:
            yield f"island_{number}", [rings[number]]
        yield "world", [ring for ring in rings if len(ring) >= LEAST_OF_COAST]


def cases(arguments):
    """Yields a name, parts (rings or lines of points in order), whether they close, and the ratio."""
    for name, (curve, end, is_closed) in SMOOTH.items():
        dense, sizes = local_feature_sizes(curve, end, is_closed)
        for ratio in RATIOS:
            yield f"{name}_{ratio}_long", [sample(dense, sizes, ratio, is_closed, None)], is_closed, ratio
            random = np.random.default_rng(round(1000 * ratio))
            yield f"{name}_{ratio}_random", [sample(dense, sizes, ratio, is_closed, random)], is_closed, ratio
    for degrees in CORNERS:
        yield f"corner_{degrees}_sampled", [corner(degrees, True)], True, None
        yield f"corner_{degrees}_cut", [corner(degrees, False)], True, None
    for name, rings in coasts(arguments):
        yield f"{name}_vertices", rings, True, None
        edges = np.concatenate([np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1) for ring in rings])
        for part in (2, 8):
            step = np.median(edges) / part
            yield f"{name}_step_{part}", [even_steps(ring, step) for ring in rings], True, None


def numbered(parts, is_closed, random):
    """Returns the points of all parts, shuffled and each once, and their edges."""
    points = np.vstack(parts)
    edges, start = [], 0
    for part in parts:
        own = start + np.arange(len(part))
        edges.append(np.stack([own, np.roll(own, -1)], axis=1)[: len(own) if is_closed else -1])
        start += len(part)
    points, number = np.unique(points, axis=0, return_inverse=True)
    place = random.permutation(len(points))
    shuffled = np.empty_like(points)
    shuffled[place] = points
    return shuffled, place[number.reshape(-1)[np.vstack(edges)]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--coast", type=Path)
    parser.add_argument("--gshhs", type=Path)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    index = []
    for name, parts, is_closed, ratio in cases(arguments):
        points, edges = numbered(parts, is_closed, np.random.default_rng(0))
        (arguments.out / f"{name}.xy").write_text("".join(f"{x!r} {y!r}\n" for x, y in points.tolist()))
        record = {"points": f"{name}.xy", "n": len(points), "ratio": ratio, "closed": is_closed}
        index.append(record | {"parts": len(parts), "edges": edges.tolist()})
    (arguments.out / "index.json").write_text(json.dumps(index))


if __name__ == "__main__":
    main()

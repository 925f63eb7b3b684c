"""Polygons of triangles: the rings that bound them."""

from __future__ import annotations

from typing import Iterator

import numpy as np

#: Rings of one piece: the outer one, counterclockwise, and those of holes, clockwise.
Rings = tuple[list, list]


def rings_of(points: np.ndarray, triangles: np.ndarray, neighbors: np.ndarray) -> list[Rings]:
    """Return the rings round each piece of triangles that are connected across edges.

    Triangles are counterclockwise, `neighbors` are -1 where none of the triangles is. Rings are lists
    of points, each once; they touch each other in single points at most.
    """
    pieces = _pieces(neighbors)
    found: list[list] = [[] for _ in range(max(pieces, default=-1) + 1)]
    for first, walk in _walks(triangles, neighbors):
        found[pieces[first // 3]].extend(_simple_rings(walk))
    for rings in found:
        # The interior of a piece is connected: one ring goes round all of it.
        rings.sort(key=lambda ring: -_area(points[ring]))
    return [(rings[0], rings[1:]) for rings in found]


def _pieces(neighbors: np.ndarray) -> list:
    """Return the number of the piece that each triangle is in."""
    piece_of = [-1] * len(neighbors)
    rows, count = neighbors.tolist(), 0
    for first in range(len(rows)):
        if piece_of[first] >= 0:
            continue
        left = [first]
        piece_of[first] = count
        while left:
            for neighbor in rows[left.pop()]:
                if neighbor >= 0 and piece_of[neighbor] < 0:
                    piece_of[neighbor] = count
                    left.append(neighbor)
        count += 1
    return piece_of


def _walks(triangles: np.ndarray, neighbors: np.ndarray) -> Iterator[tuple[int, list]]:
    """Yield closed walks along sides that have a triangle on their left alone: a side, and all vertices.

    Side 3 t + i is opposite vertex i of triangle t.
    """
    following = _following(triangles, neighbors)
    begins = np.roll(triangles, -1, axis=1).ravel()
    begin_of = dict(zip(following, begins[list(following)].tolist()))
    for first in begin_of:
        walk, side = [], first
        while side in following:
            walk.append(begin_of[side])
            side = following.pop(side)
        if walk:
            yield first, walk


def _following(triangles: np.ndarray, neighbors: np.ndarray) -> dict:
    """Return the side that follows each side without a neighbour, round the triangles at its end."""
    sides = np.flatnonzero((neighbors < 0).ravel())
    triangle, corner = sides // 3, (sides % 3 + 2) % 3
    pivot = triangles[triangle, corner]
    across = (corner + 2) % 3
    while True:
        # From the pivot the next side goes to the corner after it.
        beyond = neighbors[triangle, across]
        moves = beyond >= 0
        if not moves.any():
            return dict(zip(sides.tolist(), (3 * triangle + across).tolist()))
        triangle = np.where(moves, beyond, triangle)
        corner = (triangles[triangle] == pivot[:, None]).argmax(axis=1)
        across = (corner + 2) % 3


def _simple_rings(walk: list) -> Iterator[list]:
    """Split a closed walk where it comes back to a vertex; yield rings that have each vertex once."""
    place: dict = {}
    path: list = []
    for vertex in walk:
        if vertex in place:
            ring = path[place[vertex] :]
            del path[place[vertex] :]
            for other in ring:
                del place[other]
            yield ring
        place[vertex] = len(path)
        path.append(vertex)
    yield path


def _area(ring: np.ndarray) -> float:
    """Return twice the area that a ring goes round."""
    x, y = (ring - ring[0]).T
    return abs(float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum()))

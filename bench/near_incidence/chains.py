"""Distances of chains from their segments, by exact fractions."""

import heapq
import math
from fractions import Fraction


# Units that no rounding explains.
ELSEWHERE = 10**6


class Segment:
    """A segment between two points of doubles. Offsets from it are in units: those in the last place of the
    larger coordinate of its ends, axis by axis."""

    def __init__(self, a, b):
        self.units = [Fraction(math.ulp(max(abs(p), abs(q)))) for p, q in zip(a, b)]
        self.start = self.scaled(a)
        self.along = [q - p for p, q in zip(self.start, self.scaled(b))]

    def scaled(self, point):
        """Returns a point in units."""
        return [Fraction(x) / unit for x, unit in zip(point, self.units)]

    def offset(self, point):
        """Returns how many units a rectangle about a point must reach along each axis to meet the segment,
        exactly."""
        (dx, dy), (ex, ey) = ([x - a for x, a in zip(self.scaled(point), self.start)], self.along)
        # The reach is a convex function of the place on the segment, linear between these.
        breaks = [(dx, ex), (dy, ey), (dx - dy, ex - ey), (dx + dy, ex + ey)]
        places = [0, 1] + [min(max(d / e, 0), 1) for d, e in breaks if e]
        return min(max(abs(dx - place * ex), abs(dy - place * ey)) for place in places)


def orientation(a, b, c):
    """Returns the exact sign of a triangle's area."""
    (ax, ay), (bx, by), (cx, cy) = ([Fraction(x) for x in point] for point in (a, b, c))
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (area > 0) - (area < 0)


def really_cross(first, second, near):
    """Returns true if two segments cross and no end of one is within so many units of the other."""
    (a, b), (c, d) = first, second
    if orientation(a, b, c) * orientation(a, b, d) >= 0 or orientation(c, d, a) * orientation(c, d, b) >= 0:
        return False
    pairs = [(Segment(a, b), (c, d)), (Segment(c, d), (a, b))]
    return all(one.offset(end) > near for one, ends in pairs for end in ends)


def straightest(segment, start, goal, edges, points):
    """Returns the offset of the farthest vertex on the best path between two vertices; None where no path
    stays near the segment."""
    offsets = {start: Fraction(0)}
    queue = [(Fraction(0), start)]
    done = set()
    while queue:
        most, vertex = heapq.heappop(queue)
        if vertex == goal:
            return most
        if vertex in done:
            continue
        done.add(vertex)
        for other in edges.get(vertex, ()):
            if other not in offsets:
                offsets[other] = segment.offset(points[other])
            # Another way is farther off than any rounding.
            if other not in done and offsets[other] < ELSEWHERE:
                heapq.heappush(queue, (max(most, offsets[other]), other))
    return None


def farthest(points, segments, ends, pieces, parents, is_cut):
    """Returns the offset of the chain vertex that is farthest from its segment, and the number of segments
    without a chain. `segments` are coordinates, `ends` the vertices of their ends; a domain that is
    cut out (`is_cut`) lacks the chains outside of it."""
    edges, owned = {}, {}
    for (a, b), parent in zip(pieces, parents):
        edges.setdefault(a, []).append(b)
        edges.setdefault(b, []).append(a)
        owned.setdefault(parent, []).append((a, b))
    most, broken = Fraction(0), 0
    for number, (segment, (start, goal)) in enumerate(zip(segments, ends)):
        if segment[0] == segment[1]:
            continue
        segment = Segment(*segment)
        own = owned.get(number, [])
        for vertex in {vertex for piece in own for vertex in piece}:
            most = max(most, segment.offset(points[vertex]))
        leads_through = bool(own) and own[0][0] == start and own[-1][1] == goal
        leads_through &= all(one[1] == next_[0] for one, next_ in zip(own, own[1:]))
        if not leads_through:
            worst = straightest(segment, start, goal, edges, points)
            if worst is not None:
                most = max(most, worst)
            elif not is_cut:
                broken += 1
    return float(most), broken

"""How far chains are from their segments, by exact fractions."""

import heapq
import math
from fractions import Fraction


class Segment:
    """A segment between two points of doubles."""

    def __init__(self, a, b):
        self.a, self.b = ([Fraction(coordinate) for coordinate in end] for end in (a, b))
        self.along = [b - a for a, b in zip(self.a, self.b)]
        self.square = sum(step * step for step in self.along)
        self.ulp = Fraction(math.ulp(max(abs(coordinate) for coordinate in (*a, *b))))

    def place(self, point):
        """Returns the scalar product that tells where beside the segment a point is: 0 at one end, 1 at
        the other."""
        steps = (Fraction(x) - a for x, a in zip(point, self.a))
        return sum(step * d for step, d in zip(steps, self.along)) / self.square

    def square_distance(self, point):
        """Returns the exact square of a point's distance, in squares of the unit in the last place of the
        segment's largest coordinate."""
        place = min(max(self.place(point), 0), 1)
        gaps = (Fraction(x) - a - place * d for x, a, d in zip(point, self.a, self.along))
        return sum(gap * gap for gap in gaps) / self.ulp**2


def orientation(a, b, c):
    """Returns the exact sign of a triangle's area."""
    (ax, ay), (bx, by), (cx, cy) = ([Fraction(x) for x in point] for point in (a, b, c))
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (area > 0) - (area < 0)


def really_cross(first, second, bound):
    """Returns true if two segments cross and no end of one is within so many units of the other."""
    (a, b), (c, d) = first, second
    if orientation(a, b, c) * orientation(a, b, d) >= 0 or orientation(c, d, a) * orientation(c, d, b) >= 0:
        return False
    pairs = [(Segment(a, b), (c, d)), (Segment(c, d), (a, b))]
    return all(one.square_distance(end) > bound**2 for one, ends in pairs for end in ends)


def straightest(segment, start, goal, edges, points):
    """Returns the square of the distance of the farthest vertex on the best path between two vertices, and
    None where there is no path that stays near the segment."""
    if start == goal:
        return Fraction(0)
    distances = {start: Fraction(0)}
    queue = [(Fraction(0), start)]
    done = set()
    while queue:
        farthest, vertex = heapq.heappop(queue)
        if vertex == goal:
            return farthest
        if vertex in done:
            continue
        done.add(vertex)
        for other in edges.get(vertex, ()):
            if other not in done:
                if other not in distances:
                    distances[other] = segment.square_distance(points[other])
                # What is a millionth of a unit of the coordinates away is another way.
                if distances[other] < Fraction(10) ** 12 and (not math.isinf(float(distances[other]))):
                    heapq.heappush(queue, (max(farthest, distances[other]), other))
    return None


def farthest(points, segments, ends, pieces, parents, is_cut):
    """Returns the distance of the chain vertex that is farthest from its segment, in units, and the number of
    segments without a chain. `segments` are coordinates, `ends` the vertices of their ends; a domain that is
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
            most = max(most, segment.square_distance(points[vertex]))
        leads_through = bool(own) and own[0][0] == start and own[-1][1] == goal
        leads_through &= all(one[1] == next_[0] for one, next_ in zip(own, own[1:]))
        if not leads_through:
            worst = straightest(segment, start, goal, edges, points)
            if worst is not None:
                most = max(most, worst)
            elif not is_cut:
                broken += 1
    return math.sqrt(most), broken

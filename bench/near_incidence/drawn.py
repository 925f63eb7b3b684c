"""Inputs with points and ends some units in the last place beside slanted segments, drawn by a seed. A row is
a kind of them: a function of a random.Random that returns points and segments, pairs of their numbers."""

import math


def short(random, digits=1, reach=10):
    """Returns a point of decimals with few digits."""
    return tuple(round(random.uniform(0, reach), digits) for _ in range(2))


def slanted(random, digits=1, reach=10):
    """Returns the ends of a segment of short decimals along no axis."""
    while True:
        a, b = short(random, digits, reach), short(random, digits, reach)
        if a[0] != b[0] and a[1] != b[1]:
            return a, b


def between(random, a, b, share):
    """Returns the point at `share` of the way from a to b as one of several programs computes it."""
    way = random.randrange(3)
    if way == 0:
        return tuple(p + (q - p) * share for p, q in zip(a, b))
    if way == 1:
        return tuple(p * (1 - share) + q * share for p, q in zip(a, b))
    return tuple(q - (q - p) * (1 - share) for p, q in zip(a, b))


def written(random, a, b, share):
    """Returns the same point as a file of 12 digits has it: hundreds of units in the last place beside the
    segment, a gap that stays."""
    return tuple(round(x, 12) for x in between(random, a, b, share))


def nudged(random, point, most=3):
    """Returns the point, each coordinate some units in the last place beside."""
    def moved(x):
        for _ in range(random.randrange(most + 1)):
            x = math.nextafter(x, random.choice((-math.inf, math.inf)))
        return x

    return tuple(moved(x) for x in point)


class Drawing:
    """Points, each once, and segments between them, given by coordinates."""

    def __init__(self):
        self.numbers, self.segments = {}, []

    def point(self, place):
        """Returns the number of a point, which is new or known."""
        return self.numbers.setdefault(tuple(float(x) + 0.0 for x in place), len(self.numbers))

    def segment(self, a, b):
        """Adds a segment, unless it has no length."""
        ends = self.point(a), self.point(b)
        if ends[0] != ends[1]:
            self.segments.append(ends)

    def ring(self, places):
        """Adds a closed curve."""
        for a, b in zip(places, [*places[1:], places[0]]):
            self.segment(a, b)

    def done(self):
        """Returns points and segments."""
        return list(self.numbers), self.segments


def point_beside(random):
    """Three points of short decimals, of which one lies beside the segment of the others; at times it is the
    end of another segment."""
    drawing = Drawing()
    a, b = slanted(random, random.randrange(3))
    drawing.segment(a, b)
    share = random.randrange(1, 10) / 10
    place = between(random, a, b, share)
    if random.random() < 0.5:
        place = nudged(random, place)
    drawing.point(place)
    if random.random() < 0.2:
        drawing.segment(short(random), place)
    return drawing.done()


def triangle(random):
    """A triangle of one decimal with a vertex at tenths of a slanted side, at times with the line from there to
    the opposite corner."""
    drawing = Drawing()
    a, b = slanted(random)
    c = short(random)
    drawing.ring([a, b, c])
    place = between(random, a, b, random.randrange(1, 10) / 10)
    drawing.point(place)
    if random.random() < 0.5:
        drawing.segment(place, c)
    return drawing.done()


def beside(a, b, share, height):
    """Returns a point beside the segment from a to b, in lengths of it, with one decimal."""
    along = [q - p for p, q in zip(a, b)]
    across = -along[1], along[0]
    return tuple(round(p + share * d + height * n, 1) for p, d, n in zip(a, along, across))


def parcels(random):
    """Two parcels on either side of a slanted line, which share a part of it."""
    drawing = Drawing()
    a, b = slanted(random)
    first, last = sorted(random.sample(range(11), 2))
    p, q = (between(random, a, b, share / 10) for share in (first, last))
    drawing.ring([a, b, beside(a, b, 0.9, 0.4), beside(a, b, 0.1, 0.3)])
    drawing.ring([p, q, beside(a, b, 0.8, -0.5), beside(a, b, 0.2, -0.4)])
    return drawing.done()


def clipped(random, lines):
    """Lines that shapely clips to a slanted quadrilateral."""
    import shapely

    while True:
        corners = sorted((short(random) for _ in range(4)), key=lambda p: math.atan2(p[1] - 5, p[0] - 5))
        area = shapely.Polygon(corners)
        if area.is_valid and area.area > 1:
            break
    drawing = Drawing()
    drawing.ring(corners)
    for _ in range(lines):
        line = shapely.LineString(slanted(random)).intersection(area)
        for part in getattr(line, "geoms", [line]):
            if part.geom_type == "LineString" and not part.is_empty:
                for pair in zip(part.coords, part.coords[1:]):
                    drawing.segment(*pair)
    return drawing.done()


def eight_segments(random):
    """Eight segments between places of a grid of tenths, as decimals or as multiples of 0.1."""
    drawing = Drawing()
    grid = (lambda k: k * 0.1) if random.random() < 0.5 else (lambda k: k / 10)
    for _ in range(8):
        drawing.segment(*(tuple(grid(random.randrange(11)) for _ in range(2)) for _ in range(2)))
    return drawing.done()


def junctions(random):
    """Several segments that end on slanted ones, on either side."""
    drawing = Drawing()
    for _ in range(random.randrange(1, 3)):
        a, b = slanted(random)
        drawing.segment(a, b)
        for _ in range(random.randrange(2, 7)):
            share = random.choice((random.random(), random.randrange(1, 20) / 20))
            place = between(random, a, b, share)
            height = random.choice((-1, 1)) * random.uniform(0.1, 0.5)
            drawing.segment(place, beside(a, b, share + random.uniform(-0.2, 0.2), height))
    return drawing.done()


def overlaps(random, place=between):
    """Segments on one slanted line, whose ends are computed, and which overlap but for rounding."""
    drawing = Drawing()
    a, b = slanted(random)
    drawing.segment(a, b)
    for _ in range(random.randrange(1, 5)):
        shares = sorted(random.choice((random.random(), random.randrange(-5, 16) / 10)) for _ in range(2))
        drawing.segment(*(place(random, a, b, share) for share in shares))
    return drawing.done()


def star(random):
    """Three to eight lines through nearly one point."""
    drawing = Drawing()
    center = short(random)
    for _ in range(random.randrange(3, 9)):
        turn = random.uniform(0, math.tau)
        lengths = random.uniform(1, 5), -random.uniform(1, 5)
        ends = [(center[0] + r * math.cos(turn), center[1] + r * math.sin(turn)) for r in lengths]
        drawing.segment(*ends)
    return drawing.done()


def grid(random):
    """Lines 0.1 apart, upright or turned, with their crossings as points or without."""
    drawing = Drawing()
    columns, rows = random.randrange(2, 7), random.randrange(2, 7)
    turn = random.choice((0, 0, math.pi / 4, random.uniform(0, math.tau)))
    sine, cosine = math.sin(turn), math.cos(turn)
    first = short(random)
    step = random.choice((0.1, 0.1, 0.3))

    def node(i, j):
        x, y = i * step, j * step
        return first[0] + x * cosine - y * sine, first[1] + x * sine + y * cosine

    for i in range(columns + 1):
        drawing.segment(node(i, 0), node(i, rows))
    for j in range(rows + 1):
        drawing.segment(node(0, j), node(columns, j))
    if random.random() < 0.6:
        for i in range(columns + 1):
            for j in range(rows + 1):
                drawing.point(node(i, j))
    if random.random() < 0.3:
        drawing.segment(node(0, 0), node(columns, rows))
    return drawing.done()


ROWS = {
    "point beside": point_beside,
    "triangle": triangle,
    "parcels": parcels,
    "one line clipped": lambda random: clipped(random, 1),
    "three lines clipped": lambda random: clipped(random, 3),
    "eight segments": eight_segments,
    "T-junctions": junctions,
    "overlaps": overlaps,
    "stars": star,
    "grids": grid,
    "overlaps of 12 digits": lambda random: overlaps(random, written),
}

"""Inputs that shapely makes of the shared airports and of the coasts of npm's world-atlas: circles around
points and what they have in common, parcels, clipped and simplified coasts. Each of its polygons is given with
its neighbours', so that one border is there as two programs would store it."""

import functools
import itertools
import json
import pathlib
import shutil
import subprocess
import tarfile

from drawn import Drawing

ATLAS = "world-atlas@2.0.2"
# Most segments that an input may have, so that all can be drawn in minutes.
MOST_SEGMENTS = 400


def fetched_atlas(place):
    """Returns the path of the atlas' package, which npm fetches into `place` unless it is there."""
    if not list(place.glob("world-atlas-*.tgz")):
        if shutil.which("npm") is None:
            raise OSError("npm is not installed")
        place.mkdir(parents=True, exist_ok=True)
        subprocess.run(["npm", "pack", "--silent", ATLAS], cwd=place, check=True, capture_output=True,
                       timeout=120)
    return next(place.glob("world-atlas-*.tgz"))


def rings_of(topology):
    """Returns the rings of a quantised topology's land, in degrees: lists of rings by polygon."""
    (scale_x, scale_y), (x0, y0) = (topology["transform"][key] for key in ("scale", "translate"))
    arcs = []
    for arc in topology["arcs"]:
        steps = zip(*(itertools.accumulate(steps) for steps in zip(*arc)))
        arcs.append([(x * scale_x + x0, y * scale_y + y0) for x, y in steps])

    def ring(numbers):
        # ~i is arc i, reversed; each arc begins where the last one ends.
        parts = [arcs[i] if i >= 0 else arcs[~i][::-1] for i in numbers]
        return parts[0] + [place for part in parts[1:] for place in part[1:]]

    for shape in topology["objects"]["land"]["geometries"]:
        polygons = shape["arcs"] if shape["type"] == "MultiPolygon" else [shape["arcs"]]
        yield from ([ring(numbers) for numbers in polygon] for polygon in polygons)


@functools.cache
def coasts(place):
    """Returns the valid polygons of the land, those of more than a few vertices."""
    import shapely

    with tarfile.open(fetched_atlas(pathlib.Path(place))) as package:
        maps = {pathlib.Path(member.name).name: member for member in package}
        topology = json.load(package.extractfile(maps["land-50m.json"]))
    polygons = (shapely.Polygon(shell, holes) for shell, *holes in rings_of(topology))
    return [polygon for polygon in polygons if polygon.is_valid and len(polygon.exterior.coords) > 20]


@functools.cache
def airports(path):
    """Returns the places of a file of points."""
    with open(path, encoding="utf-8") as file:
        return sorted({tuple(float(word) for word in line.split()[:2]) for line in file if line.strip()})


def draw(shapes):
    """Returns points and segments of the rings and lines of shapes."""
    drawing = Drawing()
    for shape in shapes:
        for part in getattr(shape, "geoms", [shape]):
            curves = [part.exterior, *part.interiors] if part.geom_type == "Polygon" else [part]
            for curve in curves:
                if curve.geom_type in ("LineString", "LinearRing"):
                    for pair in zip(curve.coords, curve.coords[1:]):
                        drawing.segment(*pair)
    return drawing.done()


def near_airports(random, path, count):
    """Returns the airports next to a random one."""
    places = airports(path)
    x, y = random.choice(places)
    return sorted(places, key=lambda place: (place[0] - x) ** 2 + (place[1] - y) ** 2)[:count]


def discs(random, path):
    """Circles around airports, cut at each other, and their union."""
    import shapely

    radius = random.uniform(0.05, 0.6)
    places = near_airports(random, path, random.randrange(2, 7))
    circles = [shapely.Point(place).buffer(radius, quad_segs=random.randrange(2, 6)) for place in places]
    others = [shapely.union_all(circles[:i]) for i in range(len(circles))]
    parts = [circle.difference(other) for circle, other in zip(circles, others)]
    commons = [circle.intersection(other) for circle, other in zip(circles, others)]
    return draw([*parts, *(commons if random.random() < 0.5 else []), shapely.union_all(circles)])


def cells(random, path):
    """Voronoi cells of airports, each cut out of the circles around all of them, and their union."""
    import shapely

    places = shapely.MultiPoint(near_airports(random, path, random.randrange(3, 16)))
    around = places.buffer(random.uniform(0.1, 1), quad_segs=3)
    parts = [cell.intersection(around) for cell in shapely.voronoi_polygons(places).geoms]
    return draw([*parts, around if random.random() < 0.7 else shapely.union_all(parts)])


def window_on(random, polygon, sides=None):
    """Returns a triangle or quadrilateral of short decimals that has some of a polygon's boundary in it."""
    import shapely

    x, y = random.choice(polygon.exterior.coords)
    reach = random.uniform(0.5, 6)
    corners = [(round(x + random.uniform(-reach, reach), 1), round(y + random.uniform(-reach, reach), 1))
               for _ in range(sides or random.randrange(3, 5))]
    return shapely.MultiPoint(corners).convex_hull


def clipped_coast(random, place):
    """A coast in a window, cut by another window: what is in it and what is not."""
    import shapely

    polygon = random.choice(coasts(place))
    outer = shapely.box(*window_on(random, polygon).bounds)
    window = window_on(random, polygon)
    if outer.area == 0 or window.area == 0:
        return [], []
    coast = polygon.intersection(outer)
    return draw([coast.intersection(window), coast.difference(window), window])


def simplified_coast(random, place):
    """A simplified coast and a strip along it, clipped to a window."""
    polygon = random.choice(coasts(place))
    window = window_on(random, polygon)
    if window.area == 0:
        return [], []
    frame = window.buffer(window.length / 8, join_style="mitre")
    coast = polygon.intersection(frame).simplify(random.choice((0.01, 0.05, 0.2)))
    strip = coast.buffer(random.uniform(0.01, 0.2), quad_segs=2).difference(coast)
    return draw([coast.intersection(window), strip.intersection(window), window])


def joined_coasts(random, place):
    """The union of a coast and a window on it, with the parts that it is made of."""
    polygon = random.choice(coasts(place))
    window = window_on(random, polygon)
    if window.area == 0:
        return [], []
    frame = window.buffer(window.length / 8, join_style="mitre")
    coast = polygon.intersection(frame)
    return draw([coast.union(window), coast.intersection(window), frame])


def bounded(make, random, source):
    """Draws until an input has segments, and not too many."""
    while True:
        points, segments = make(random, source)
        if 3 <= len(segments) <= MOST_SEGMENTS:
            return points, segments


def rows(shared, atlas):
    """Returns the rows that there is data for, and says which are left out."""
    import shapely

    made = {}
    path = str(pathlib.Path(shared) / "data" / "airports_us_lonlat.xy")
    if pathlib.Path(path).exists():
        made |= {"shapely's circles": (discs, path), "shapely's cells": (cells, path)}
    else:
        print(f"without airports: no {path}")
    try:
        coasts(str(atlas))
        makers = {"clipped": clipped_coast, "simplified": simplified_coast, "joined": joined_coasts}
        made |= {f"coasts, {name}": (make, str(atlas)) for name, make in makers.items()}
    except (OSError, StopIteration, subprocess.SubprocessError) as error:
        print(f"without coasts: {error}")
    return {name: functools.partial(bounded, make, source=source) for name, (make, source) in made.items()}

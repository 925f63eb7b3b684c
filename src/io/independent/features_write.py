# Writes features at random as GeoJSON and as well-known text, and prints what their points, segments and
# markers are: a line a file, the name first.
import json
import pathlib
import random
import struct
import sys

directory = pathlib.Path(sys.argv[1])
seed = random.Random(24)
KINDS = ["Point", "MultiPoint", "LineString", "MultiLineString", "Polygon", "MultiPolygon"]


def number():
    while True:
        x = seed.choice([
            lambda: float(seed.randrange(-3, 4)),
            lambda: seed.uniform(-180, 180),
            lambda: struct.unpack("<d", seed.randbytes(8))[0],
            lambda: seed.choice([-0.0, 5e-324, 1.7976931348623157e308, 0.1, 1e23, 9007199254740993.0]),
        ])()
        if x - x == 0:
            return x


def positions(least):
    while True:
        found = [[number(), number()] for _ in range(seed.randrange(least, 7))]
        if len({tuple(p) for p in found}) >= min(least, 3):
            for at in seed.sample(range(1, len(found)), seed.randrange(2) * (len(found) > 1)):
                found.insert(at, list(found[at]))
            return found


def ring():
    found = positions(3)
    return found + [found[0]]


def several(one):
    return [one() for _ in range(seed.randrange(4))]


def geometry(depth=0):
    kind = seed.choice(KINDS + ["GeometryCollection"] * (depth < 3))
    make = {
        "Point": lambda: [number(), number()],
        "MultiPoint": lambda: several(lambda: [number(), number()]),
        "LineString": lambda: positions(2),
        "MultiLineString": lambda: several(lambda: positions(2)),
        "Polygon": lambda: several(ring),
        "MultiPolygon": lambda: several(lambda: several(ring)),
        "GeometryCollection": lambda: several(lambda: geometry(depth + 1)),
    }[kind]
    return {"type": kind, ("geometries" if kind == "GeometryCollection" else "coordinates"): make()}


def shuffled(value):
    if isinstance(value, dict):
        items = [(key, shuffled(item)) for key, item in value.items()]
        seed.shuffle(items)
        return dict(items)
    return [shuffled(item) for item in value] if isinstance(value, list) else value


def noise(depth=0):
    leaf = [None, True, 1.5e-7, "type", "é😀\\\"]}\n\t\x01", -0, 10**40]
    if depth == 3 or seed.random() < 0.5:
        return seed.choice(leaf)
    if seed.random() < 0.5:
        return [noise(depth + 1) for _ in range(seed.randrange(3))]
    return {seed.choice(["type", "coordinates", "features", "é"]): noise(depth + 1) for _ in range(2)}


def spelled(x):
    return seed.choice([repr(x), f"{x:.17e}", f"{x:+.25e}", f"{x:.17G}"])


def separated(kind, value):
    """The text between the parentheses of a geometry, the parentheses included."""
    if not value:
        return seed.choice(["EMPTY", "empty"])
    comma = seed.choice([",", ", ", " ,\n"])

    def listed(items, text):
        return "(" + comma.join(map(text, items)) + ")"

    def position(p):
        return spelled(p[0]) + seed.choice([" ", "\t", "\n  "]) + spelled(p[1])

    def line(p):
        return listed(p, position) if p else "EMPTY"

    def polygon(p):
        return listed(p, line) if p else "EMPTY"

    return {
        "Point": lambda: listed([value], position),
        "MultiPoint": lambda: listed(value, seed.choice([position, lambda p: listed([p], position)])),
        "LineString": lambda: line(value),
        "MultiLineString": lambda: listed(value, line),
        "Polygon": lambda: polygon(value),
        "MultiPolygon": lambda: listed(value, polygon),
        "GeometryCollection": lambda: listed(value, wkt),
    }[kind]()


def wkt(shape):
    kind = shape["type"]
    value = shape.get("coordinates", shape.get("geometries"))
    name = seed.choice([kind, kind.upper(), kind.lower()])
    text = separated(kind, value)
    return name + (" " if text[0] != "(" else seed.choice(["", " "])) + text


def lines(shape):
    """Polylines, each as positions and whether it is closed; a point is one of one position."""
    kind = shape["type"]
    value = shape.get("coordinates", shape.get("geometries"))
    if kind == "GeometryCollection":
        return [line for member in value for line in lines(member)]
    level = KINDS.index(kind)
    if kind in ("Point", "MultiPoint"):
        return [([p], False) for p in ([value] if kind == "Point" else value)]
    flat = [value] if level == 2 else value
    flat = [r for polygon in flat for r in polygon] if kind == "MultiPolygon" else flat
    return [(line, kind.endswith("Polygon")) for line in flat]


def outline(shapes):
    points, segments, markers = [], [], []
    for marker, shape in enumerate(shapes, 1):
        for line, closed in lines(shape) if shape else []:
            first = len(points)
            points += line[:-1] if closed else line
            ids = [first + at for at in range(len(line))]
            if closed:
                ids[-1] = first
            for at in range(len(line) - 1):
                if line[at] != line[at + 1]:
                    segments.append([ids[at], ids[at + 1]])
                    markers.append(marker)
    bits = [struct.unpack("<Q", struct.pack("<d", x))[0] for p in points for x in p]
    return f"{bits};{segments};{markers}"


for number_of_file in range(200):
    shapes = [geometry() for _ in range(seed.randrange(1, 5))] + [{"type": "Point", "coordinates": [1.0, 2.0]}]
    seed.shuffle(shapes)
    name = f"{number_of_file}.wkt"
    end = seed.choice(["\n", ";\n", " "])
    text = end.join(seed.choice(["", "", "SRID=4326;"]) + wkt(shape) for shape in shapes)
    (directory / name).write_text(text)
    print(f"{name};{outline(shapes)}")
    if seed.random() < 0.3:
        shapes.insert(seed.randrange(len(shapes)), None)
    features = [{"type": "Feature", "geometry": shape, "properties": noise(), "id": noise()} for shape in shapes]
    whole = {"type": "FeatureCollection", "features": features, "bbox": noise(), "crs": noise()}
    if len(shapes) == 1:
        whole = seed.choice([whole, features[0], shapes[0]])
    form = {"indent": seed.choice([None, 1]), "ensure_ascii": seed.random() < 0.5}
    name = f"{number_of_file}.geojson"
    (directory / name).write_text(json.dumps(shuffled(whole), **form), encoding=seed.choice(["utf-8", "utf-8-sig"]))
    print(f"{name};{outline(shapes)}")

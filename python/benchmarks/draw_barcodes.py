"""Draws the barcodes of docs/topology.md: python draw_barcodes.py PROTEIN.xyz OUT.svg.

For a noisy circle, a torus and a protein (the atoms of a file of points) the longest bars of each
dimension, from the alpha filtration (dark) and from that of a well-spaced mesh (light). Same input,
same bytes. Needs gudhi.
"""

import sys

import netmesh
import numpy as np

WIDTH, LEFT, RIGHT, LINE, GAP = 720, 60, 20, 7, 16
COLORS = [("#1b4f72", "#85c1e9"), ("#7b241c", "#e6a49c"), ("#145a32", "#8fd0a8")]
#: How many bars of each dimension.
LONGEST = [12, 10, 8]


def noisy_circle(random):
    angle = 2 * np.pi * random.random(300)
    return np.c_[np.cos(angle), np.sin(angle)] + 0.1 * random.normal(size=(300, 2))


def torus(random):
    u, v = 2 * np.pi * random.random((2, 2000))
    wide = 2 + np.cos(v)
    return np.c_[wide * np.cos(u), wide * np.sin(u), np.sin(v)]


def bars(points, kind):
    """For each dimension the longest bars, in radii, the longest first."""
    options = {"algorithm": "delaunay"} if kind == "alpha" else {"output": "well_spaced"}
    filtration = netmesh.mesh(points, **options).filtration(kind)
    tree = filtration.to_gudhi()
    tree.compute_persistence()
    for k in range(filtration.dim):
        pairs = tree.persistence_intervals_in_dimension(k).reshape(-1, 2)
        pairs = np.sqrt(pairs) if kind == "alpha" else pairs
        length = pairs[:, 1] - pairs[:, 0]
        yield pairs[np.argsort(-length, kind="stable")[: LONGEST[k]]]


class Drawing:
    """Lines of an SVG, from the top down."""

    def __init__(self):
        self.parts, self.y = [], 12

    def text(self, x, y, text, anchor="start", size=12):
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}">{text}</text>'
        )

    def bar(self, y, begin, end, color):
        # A bar of no length shows as a dot.
        self.parts.append(
            f'<rect x="{begin:.1f}" y="{y:.1f}" width="{max(end - begin, 1):.1f}" height="{LINE - 2}" '
            f'fill="{color}"/>'
        )

    def panel(self, title, points):
        found = {kind: list(bars(points, kind)) for kind in ("alpha", "mesh")}
        finite = [pairs[np.isfinite(pairs)] for kind in found for pairs in found[kind]]
        # A little beyond the last death, to where bars that never end are drawn.
        last = 1.08 * max(values.max(initial=0) for values in finite)
        scale = (WIDTH - LEFT - RIGHT) / last
        self.text(LEFT, self.y + 4, f"{title}: {len(points)} points")
        self.y += GAP
        for k, (dark, light) in enumerate(COLORS[: points.shape[1]]):
            self.text(LEFT - 8, self.y + 10, f"H{k}", "end")
            for kind, color in (("alpha", dark), ("mesh", light)):
                for birth, death in found[kind][k]:
                    end = min(death, last)
                    self.bar(self.y, LEFT + scale * birth, LEFT + scale * end, color)
                    self.y += LINE
            self.y += GAP / 2
        self.parts.append(
            f'<path d="M{LEFT} {self.y:.1f}H{WIDTH - RIGHT}" stroke="#888" fill="none"/>'
        )
        for part in range(5):
            radius = last * part / 4
            self.text(LEFT + scale * radius, self.y + 14, f"{radius:.3g}", "middle", 10)
        self.text(WIDTH - RIGHT, self.y + 28, "radius", "end", 10)
        self.y += 3 * GAP

    def svg(self):
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.y:.0f}" '
            f'width="{WIDTH}" font-family="sans-serif">'
            '<rect width="100%" height="100%" fill="white"/>'
        )
        return "\n".join([head, *self.parts, "</svg>"]) + "\n"


def main():
    protein, out = sys.argv[1:]
    random = np.random.default_rng(1)
    drawing = Drawing()
    drawing.panel("Noisy circle", noisy_circle(random))
    drawing.panel("Torus", torus(random))
    drawing.panel("Protein 4HHB", np.unique(np.loadtxt(protein), axis=0))
    with open(out, "w", encoding="utf-8") as file:
        file.write(drawing.svg())


main()

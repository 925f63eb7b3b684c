"""The barcodes of docs/topology.md: the longest bars of three inputs, from two filtrations.

The alpha filtration is dark, that of a well-spaced mesh light.
"""

import netmesh
import numpy as np
from look import save
from matplotlib import pyplot as plt

COLORS = [("#1b4f72", "#85c1e9"), ("#7b241c", "#e6a49c"), ("#145a32", "#8fd0a8")]
# The number of bars of each dimension.
LONGEST = [12, 10, 8]
KINDS = {"alpha": {"algorithm": "delaunay"}, "mesh": {"output": "well_spaced"}}


def noisy_circle(random):
    angle = 2 * np.pi * random.random(300)
    return np.c_[np.cos(angle), np.sin(angle)] + 0.1 * random.normal(size=(300, 2))


def torus(random):
    u, v = 2 * np.pi * random.random((2, 2000))
    wide = 2 + np.cos(v)
    return np.c_[wide * np.cos(u), wide * np.sin(u), np.sin(v)]


def bars(points, kind):
    """Returns for each dimension the longest bars, in radii, the longest first."""
    filtration = netmesh.mesh(points, **KINDS[kind]).filtration(kind)
    tree = filtration.to_gudhi()
    tree.compute_persistence()
    found = []
    for k in range(filtration.dim):
        pairs = tree.persistence_intervals_in_dimension(k).reshape(-1, 2)
        pairs = np.sqrt(pairs) if kind == "alpha" else pairs
        length = pairs[:, 1] - pairs[:, 0]
        found.append(pairs[np.argsort(-length, kind="stable")[: LONGEST[k]]])
    return found


def draw_panel(ax, title, points):
    """Draws the bars from the top down; those that never end go a little beyond the last death."""
    found = {kind: bars(points, kind) for kind in KINDS}
    finite = [pairs[np.isfinite(pairs)] for kind in KINDS for pairs in found[kind]]
    last = 1.08 * max(values.max(initial=0) for values in finite)
    row, ticks = 0, []
    for k, colors in enumerate(COLORS[: points.shape[1]]):
        first = row
        for kind, color in zip(KINDS, colors, strict=True):
            births, deaths = found[kind][k].T
            lengths = np.minimum(deaths, last) - births
            rows = row + np.arange(len(births))
            # A bar of no length shows as a dot.
            ax.barh(rows, np.maximum(lengths, last / 640), 0.7, left=births, color=color)
            row += len(births)
        ticks.append((first + row - 1) / 2)
        row += 1
    ax.set_yticks(ticks, [f"H{k}" for k in range(len(ticks))])
    ax.set_ylim(row - 1, -1)
    ax.set_xlim(0, last)
    ax.grid(False)
    ax.set_title(f"{title}: {len(points)} points", loc="left")
    ax.set_xlabel("radius")
    return row


def draw(protein, out):
    """Draws a noisy circle, a torus and a protein, the atoms of a file of points."""
    random = np.random.default_rng(1)
    inputs = {
        "Noisy circle": noisy_circle(random),
        "Torus": torus(random),
        "Protein 4HHB": np.unique(np.loadtxt(protein), axis=0),
    }
    figure, axes = plt.subplots(3, 1, figsize=(7, 11), layout="constrained")
    for ax, (title, points) in zip(axes, inputs.items(), strict=True):
        draw_panel(ax, title, points)
    save(figure, out)

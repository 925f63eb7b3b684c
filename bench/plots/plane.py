"""Meshes in the plane: edges, vertices by kind, and the domains with their cages."""

import math

import netmesh
import numpy as np
from look import legend, panels, save
from matplotlib.lines import Line2D
from matplotlib.patches import Circle

# The radii of the three figures of the sample.
SCALES = (1.0, 1e-4, 1e-8)
# Half of a panel's width relative to the radius of its domain; the cage stands at 0.8.
MARGIN = 0.92
# The same for the two panels of the picture of a cage: from afar, then close.
CLOSE_UPS = (25.0, 1.05)
# Colours are told apart by the colour-blind as well.
KINDS = {
    netmesh.VertexKind.CAGE: ("cage vertex", "#00846b", 2.6),
    netmesh.VertexKind.STEINER: ("Steiner vertex", "#e08214", 2.1),
    netmesh.VertexKind.INPUT: ("input", "#1a4f8b", 3.0),
}
DOMAIN = {"edgecolor": "#7fb8ad", "facecolor": "#eef6f4", "linestyle": "--", "linewidth": 0.8}
PIXELS = 300


def sample():
    """Returns a spiral, in its middle a ring with waves, in the ring's middle a sunflower's seeds."""
    along = np.linspace(0, 1, 40)
    turns = [2 * math.pi * (arm / 3 + 0.45 * along) for arm in range(3)]
    parts = [polar(SCALES[0] * (0.2 + 0.8 * along**1.4), turn) for turn in turns]
    turn = 2 * math.pi * np.arange(48) / 48
    parts.append(polar(SCALES[1] * (0.8 + 0.2 * np.sin(5 * turn)), turn))
    seeds = np.arange(24)
    golden = math.pi * (3 - math.sqrt(5))
    parts.append(polar(SCALES[2] * np.sqrt((seeds + 0.5) / 24), seeds * golden))
    return np.concatenate(parts)


def polar(radius, turn):
    return np.c_[radius * np.cos(turn), radius * np.sin(turn)]


def draw_sample(name, out):
    """Draws each domain round the origin, or the second of them from afar and close."""
    mesh = netmesh.mesh(sample())
    centers = mesh.points[mesh.domains["center"]]
    radii = mesh.domains["radius"]
    # A parent stands before its children.
    round_origin = np.flatnonzero(np.hypot(*centers.T) < radii)
    if name == "cage":
        center, radius = centers[round_origin[1]], radii[round_origin[1]]
        far, close = (part * radius for part in CLOSE_UPS)
        windows = [(center, far, "a gap"), (center, close, "the cage in its middle, and the domain")]
    else:
        enlarged = radii[round_origin[0]] / radii[round_origin]
        captions = [f"the marked spot, {thousands(times)} times enlarged" for times in enlarged]
        captions[0] = "the root domain"
        windows = [
            (centers[domain], MARGIN * radii[domain], caption)
            for domain, caption in zip(round_origin, captions, strict=True)
        ]
    draw(mesh, windows, out, marked=1 if name == "cage" else len(windows) - 1)


def thousands(number):
    """Returns the number to two digits: 5712 as 5 700."""
    unit = 10 ** max(math.floor(math.log10(number)) - 1, 0)
    return f"{round(number / unit) * unit:,}".replace(",", " ")


def draw_file(file, out, numbers):
    """Draws the mesh of a file's points, a panel for each square window of `numbers`."""
    mesh = netmesh.mesh(np.loadtxt(file))
    windows = [
        (np.array(numbers[at : at + 2]), numbers[at + 2], "the marked spot" if at else "")
        for at in range(0, len(numbers), 3)
    ]
    draw(mesh, windows, out, marked=len(windows) - 1)


def draw(mesh, windows, out, marked):
    """Draws a panel a window; the first `marked` panels show the next one's centre by a ring."""
    figure, axes = panels(len(windows), height=3.6)
    for at, (ax, (center, half_width, caption)) in enumerate(zip(axes, windows, strict=True)):
        draw_window(ax, mesh, center, half_width)
        ax.set_xlabel(caption)
        if at < marked:
            next_center = (windows[at + 1][0] - center) / half_width
            ax.plot(*next_center, "o", color="#c2185b", fillstyle="none", markersize=10)
    handles = {
        name: Line2D([], [], color=color, marker="o", markersize=size + 1, linestyle="none")
        for name, color, size in reversed(KINDS.values())
    }
    legend(figure, handles | {"domain": Line2D([], [], color="#7fb8ad", linestyle="--")}, 4)
    save(figure, out)


def draw_window(ax, mesh, center, half_width):
    """Draws what is in the window, scaled to [-1, 1] squared."""
    points = (mesh.points - center) / half_width
    for domain in mesh.domains:
        radius = domain["radius"] / half_width
        if 4 / PIXELS < radius < 4:
            ax.add_patch(Circle(points[domain["center"]], radius, **DOMAIN))
    ends = points[mesh.edges]
    is_near = (ends.min(axis=1) < 1).all(axis=1) & (ends.max(axis=1) > -1).all(axis=1)
    ends = clipped(ends[is_near])
    is_seen = np.hypot(*(ends[:, 1] - ends[:, 0]).T) > 1.4 / PIXELS
    draw_segments(ax, ends[is_seen], color="#a8a8a8", linewidth=0.5)
    for kind, (_, color, size) in KINDS.items():
        inside = (np.abs(points) <= 1).all(axis=1) & (mesh.kinds == kind)
        # One vertex of many on one spot is enough.
        spots = np.unique(np.round(points[inside] * PIXELS) / PIXELS, axis=0)
        # Dots are round ends of segments without length: a few bytes each.
        draw_segments(ax, np.stack([spots, spots], axis=1), color=color, linewidth=size)
    ax.set(xlim=(-1, 1), ylim=(-1, 1), xticks=[], yticks=[], aspect="equal")
    ax.grid(False)


def draw_segments(ax, ends, **look):
    """Draws segments (n, 2, 2) as one path."""
    gaps = np.full((len(ends), 1, 2), np.nan)
    ax.plot(*np.concatenate([ends, gaps], axis=1).reshape(-1, 2).T, solid_capstyle="round", **look)


def clipped(ends):
    """Returns the parts of segments (n, 2, 2) in the square [-1, 1] squared (Liang and Barsky)."""
    start, step = ends[:, 0], ends[:, 1] - ends[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        enter, leave = np.sort([(-1 - start) / step, (1 - start) / step], axis=0)
    first = np.maximum(np.nan_to_num(enter, nan=-np.inf).max(axis=1), 0)
    last = np.minimum(np.nan_to_num(leave, nan=np.inf).min(axis=1), 1)
    kept = first < last
    at = np.stack([first, last], axis=1)[kept]
    return start[kept, None] + at[:, :, None] * step[kept, None]

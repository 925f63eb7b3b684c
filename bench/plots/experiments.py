"""The curves of docs/reports/experiments.md, drawn from its tables."""

import csv

from look import COLORS, MARKERS, NETMESH, legend, panels, save, scale
from matplotlib.lines import Line2D

# Reasons for a missing figure: the marker above the axis, the words, and how notes begin that say so.
MISSING = {
    "x": ("crashed or failed", ("crashed", "failed")),
    "_": (
        "took too long or grew too large, or was not tried after that",
        ("timeout", "too large", "not tried"),
    ),
    "$\\circ$": ("lost inputs or missed its bound", ("inputs merged", "bound missed")),
}
INPUTS = ["uniform", "gaussian", "clusters", "sphere"]


class Panel:
    """One panel: curves of (x, y) by name, and the notes where a curve has no figure."""

    def __init__(self, caption, labels, scales, names=None):
        self.caption, self.labels, self.scales, self.names = caption, labels, scales, names
        self.curves, self.notes = {}, {}

    def add(self, name, x, cell, note=None):
        """Adds a cell of a table at x: a number, or the note that stands there or in `note`."""
        try:
            figure = float(cell)
        except ValueError:
            self.notes.setdefault(name, []).append((float(x), cell if note is None else note))
        else:
            self.curves.setdefault(name, []).append((float(x), figure))


def rows_of(folder, name):
    with open(folder / f"{name}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def draw(path, parts):
    """Draws panels side by side with one legend."""
    figure, axes = panels(len(parts))
    names = list(dict.fromkeys(name for part in parts for name in part.curves))
    handles, reasons = {}, {}
    for ax, part in zip(axes, parts, strict=True):
        ax.set_title(part.caption)
        ax.set_xlabel(part.labels[0])
        ax.set_ylabel(part.labels[1])
        with_notes = 0
        for name, points in part.curves.items():
            color, at = look_of(name, names)
            line = {"linestyle": "none"} if part.names else {"linestyle": ("-", "--")[at % 2]}
            (handles[name],) = ax.plot(
                *zip(*points, strict=True), color=color, marker=MARKERS[at % len(MARKERS)], **line
            )
            marked = [(x, mark) for x, note in part.notes.get(name, []) for mark in marks(note)]
            for x, mark in marked:
                place = {"transform": ax.get_xaxis_transform(), "linestyle": "none"}
                ax.plot([x], [0.03 + 0.05 * with_notes], marker=mark, color=color, **place)
                reasons[mark] = None
            with_notes += bool(marked)
        for axis, kind in zip((ax.xaxis, ax.yaxis), part.scales, strict=True):
            scale(axis, kind)
        if with_notes:
            make_room_below(ax)
        if part.names:
            ax.set_xticks(range(1, len(part.names) + 1), part.names)
            ax.set_xlim(0.4, len(part.names) + 0.6)
    for mark in MISSING:
        if mark in reasons:
            handles[MISSING[mark][0]] = Line2D([], [], linestyle="none", marker=mark, color="#333333")
    legend(figure, handles, 2 if max(map(len, handles)) > 30 else 4)
    save(figure, path)


def make_room_below(ax):
    """Moves the lower end of the axis down by a seventh of it, where marks stand."""
    low = ax.transData.inverted().transform(ax.transAxes.transform((0, -0.15)))[1]
    ax.set_ylim(bottom=low)


def look_of(name, names):
    """Returns the colour of a curve, and the number that picks its marker and its dashes."""
    at = names.index(name)
    return COLORS.get(name, NETMESH[at % len(NETMESH)]), at


def marks(note):
    return [mark for mark, (_, begins) in MISSING.items() if note.startswith(begins)]


def spread(folder, out):
    """Draws size and touches against the spread, for clusters, pairs and chains."""
    rows = rows_of(folder, "spread")
    axes = {
        "clusters": ("log2 spread", "log2 of the spread", "log"),
        "pairs": ("log2 exponent", "log2 of 1 / the pairs' distance", "log"),
        "chain": ("log2 exponent", "log2 of the pacing", "linear"),
    }
    for kind, (column, label, x_scale) in axes.items():
        for name, y in (("size", "m/n"), ("touches", "touches/n")):
            parts = []
            for dim in "234":
                y_scale = "linear" if kind == "chain" else "log"
                part = Panel(f"{dim}D", (label, y.replace("/", " / ")), (x_scale, y_scale))
                for row in rows:
                    if (row["input"], row["dim"]) == (kind, dim):
                        part.add(row["method"], row[column], row[y], row["m/n"])
                parts.append(part)
            draw(out / f"spread_{kind}_{name}.svg", parts)


def growth(folder, out):
    """Draws point location, time and degrees against the number of inputs."""
    rows = rows_of(folder, "growth")
    columns = {
        "growth_touches": ("touches/(n log2 n)", "touches / (n log2 n)"),
        "growth_time": ("ns/(n log2 n + m)", "ns / (n log2 n + m)"),
        "growth_degree": ("max degree", "largest degree"),
    }
    for name, (column, label) in columns.items():
        parts = [Panel(f"{dim}D", ("n", label), ("log", "log")) for dim in "234"]
        for row in rows:
            curve = f"{row['input']}, {row['ordering']}"
            parts[int(row["dim"]) - 2].add(curve, row["n"], row[column])
        draw(out / f"{name}.svg", parts)


def finishing(folder, out):
    """Draws the simplices made per vertex while the finished mesh grows."""
    labels = ("vertices of the finished mesh", "simplices made / vertex")
    rows = rows_of(folder, "finishing")
    parts = []
    for dim in dict.fromkeys(row["dim"] for row in rows):
        part = Panel(f"{dim}D", labels, ("log", "log"))
        for row in rows:
            if row["dim"] == dim:
                m, name = row["m finished"], row["input"]
                part.add(f"{name}, both phases, per vertex", m, row["made/vertex"])
                part.add(f"{name}, FINISHMESH, per vertex added", m, row["made/vertex added"])
        parts.append(part)
    draw(out / "finishing.svg", parts)


def skew_lines(folder, out):
    """Draws tetrahedra and seconds for points on two skew lines."""
    parts = [
        Panel("size", ("n", "tetrahedra"), ("log", "log")),
        Panel("time", ("n", "seconds"), ("log", "log")),
    ]
    for row in rows_of(folder, "skew_lines"):
        for part, column in zip(parts, ("tetrahedra", "seconds"), strict=True):
            part.add(row["method"], row["n"], row[column], row["tetrahedra"])
    draw(out / "skew_lines.svg", parts)


def sizes(folder, out):
    """Draws the sizes of finished meshes at the largest number of inputs, input by input."""
    rows = rows_of(folder, "sizes")
    largest = max(int(row["n"]) for row in rows)
    parts = []
    for dim, bound in (("2", "1.414"), ("3", "2.0"), ("3", "1.414")):
        part = Panel(f"{dim}D, radius-edge {bound}", ("", "m / n"), ("linear", "linear"), INPUTS)
        for row in rows:
            if (row["dim"], row["bound"], int(row["n"])) == (dim, bound, largest):
                at = INPUTS.index(row["input"]) + 1
                part.add(row["mesher"], at, row["m/n"], row["note"])
        parts.append(part)
    draw(out / "sizes.svg", parts)


def draw_all(folder, out):
    """Draws the pictures of all tables that are in `folder`."""
    for experiment in (spread, growth, finishing, skew_lines, sizes):
        if (folder / f"{experiment.__name__}.csv").exists():
            experiment(folder, out)

"""The looks that all pictures share: fonts, colours, axes, and how a picture is written.

The same data give the same bytes.
"""

import io
import math
import re
from pathlib import Path

import matplotlib
from matplotlib import ticker
from PIL import Image

matplotlib.use("svg")
matplotlib.rcParams.update(
    {
        "svg.fonttype": "none",  # Text stays text.
        "svg.hashsalt": "netmesh",
        "font.family": "sans-serif",
        "font.sans-serif": ["DejaVu Sans"],
        "font.size": 9,
        "axes.edgecolor": "#888888",
        "axes.grid": True,
        "grid.color": "#dddddd",
        "grid.linewidth": 0.6,
        "axes.axisbelow": True,
        "path.simplify": False,
        # The grid tells where ticks are.
        "xtick.bottom": False,
        "ytick.left": False,
        "ytick.minor.left": False,
        "lines.linewidth": 1.6,
        "lines.markersize": 4,
        "legend.frameon": False,
    }
)

from matplotlib import pyplot as plt  # noqa: E402

# Told apart by the colour-blind as well [Okabe and Ito, 2008].
NETMESH = ["#0072b2", "#56b4e9", "#003f66", "#7aa6c2"]
COLORS = {
    "NETMESH": NETMESH[0],
    "netmesh": NETMESH[0],
    "plain Delaunay, netmesh": NETMESH[1],
    "SVR": "#d55e00",
    "CGAL Mesh_2": "#009e73",
    "plain Delaunay, CGAL": "#009e73",
    "CGAL Delaunay": "#7f8c8d",
    "Triangle": "#cc79a7",
    "TetGen": "#8a6d00",
    "SciPy": "#d55e00",
}
MARKERS = "os^Dvp"


def panels(count, columns=None, height=3.0):
    """Returns a figure and the axes of its `count` panels, three in a row unless `columns` says."""
    columns = columns or min(count, 3)
    rows = -(-count // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(3.2 * columns, height * rows), squeeze=False, layout="constrained"
    )
    return figure, list(axes.flat)


def scale(axis, kind):
    """Makes `axis` logarithmic or linear, with numbers such as 20, 5k and 1M."""
    if kind == "log":
        axis._set_axes_scale("log")
        low, high = axis.get_view_interval()
        # At least a factor of three, so that noise does not look like a trend.
        room = math.sqrt(max(3 / (high / low), 1))
        low, high = low / room, high * room
        axis.set_view_interval(low, high, ignore=True)
        few = high / low < 200
        axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if few else (1,)))
        axis.set_minor_locator(ticker.NullLocator())
    else:
        low, high = axis.get_view_interval()
        axis.set_view_interval(min(low, 0), high, ignore=True)
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: short(value)))


def short(value):
    """Returns 1,000 as 1k and a million as 1M."""
    for unit, letter in ((1e6, "M"), (1e3, "k")):
        if unit <= abs(value) < 1000 * unit:
            return f"{value / unit:.4g}{letter}"
    return f"{value:.4g}"


def legend(figure, handles, columns):
    """Puts one legend for all panels, a dict from name to handle, below them."""
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=columns)


def save(figure, path):
    """Writes the figure as SVG, without what no viewer shows, to a hundredth of a point; as PNG where
    that is the path's extension: of thousands of triangles it is smaller."""
    if Path(path).suffix == ".png":
        file = io.BytesIO()
        figure.savefig(file, format="png", dpi=120)
        plt.close(figure)
        Image.open(file).convert("RGB").quantize(96).save(path, optimize=True)
        return
    file = io.StringIO()
    figure.savefig(file)
    plt.close(figure)
    text = re.sub(r"<metadata>.*?</metadata>", "", file.getvalue(), flags=re.DOTALL)
    # In tags alone: what a reader reads keeps its digits.
    text = re.sub(r"<[^>]*>", lambda tag: re.sub(r"(\d\.\d\d)\d+", r"\1", tag[0]), text)
    text = re.sub(r" ?\n([LMC]) ", r"\1", text)
    Path(path).write_text(re.sub(r"\n\s*", "\n", text), encoding="utf-8")

"""The time that meshes take against the number of points."""

import csv

from look import COLORS, MARKERS, legend, panels, save, scale

TITLES = {
    ("2", "uniform"): "2D, uniform, 20.7 degrees",
    ("2", "sphere"): "2D, circle, 20.7 degrees",
    ("3", "uniform"): "3D, uniform, radius-edge 2",
    ("3", "sphere"): "3D, sphere, radius-edge 2",
}
MESHERS = ["netmesh", "TetGen", "Triangle", "CGAL Mesh_2", "CGAL Delaunay"]


def draw(times, out):
    """Draws microseconds a point, a panel for each dimension and distribution."""
    with open(times, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    figure, axes = panels(len(TITLES), columns=2)
    handles = {}
    for ax, (key, title) in zip(axes, TITLES.items(), strict=True):
        for mesher, marker in zip(MESHERS, MARKERS, strict=False):
            curve = sorted(
                (int(row["points"]), 1e6 * float(row["seconds"]) / int(row["points"]))
                for row in rows
                if (row["dim"], row["distribution"], row["mesher"]) == (*key, mesher)
            )
            if curve:
                x, y = zip(*curve, strict=True)
                (handles[mesher],) = ax.plot(x, y, color=COLORS[mesher], marker=marker)
        ax.set_title(title)
        ax.set_xlabel("points")
        ax.set_ylabel("microseconds a point, one thread")
        scale(ax.xaxis, "log")
        scale(ax.yaxis, "log")
    legend(figure, {mesher: handles[mesher] for mesher in MESHERS if mesher in handles}, 5)
    save(figure, out)

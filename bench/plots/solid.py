"""Meshes in space with facets, cut open: cells by their labels, and the triangles of facets by their markers."""

from pathlib import Path

import numpy as np
from look import panels, save
from matplotlib.collections import PolyCollection

# Where the eye is: degrees round the vertical axis, then above the horizon.
AZIMUTH, ELEVATION = np.radians([-56, 24])
LIGHT = np.array([0.35, -0.55, 0.75])
# Told apart by the colour-blind as well [Okabe and Ito, 2008].
CELLS = ["#f0c987", "#9fd3c7", "#d8a7c6", "#b7c9e8"]
FACETS = ["#7a9cc6", "#5b7fae", "#8fb0d6", "#6a8fbf"]
FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))


def table(path, columns=None):
    """Returns the rows of one of TetGen's files, without the ids that they begin with."""
    rows = [line.split()[1:] for line in Path(path).read_text().splitlines()[1:] if line.strip()]
    return np.array([row[:columns] for row in rows], dtype=float)


def draw(out, panels_of):
    """Draws a panel for each (path of a .node file, normal of a plane, offset, caption): the cells
    whose middles are below the plane."""
    figure, axes = panels(len(panels_of), height=3.1)
    for ax, (path, normal, offset, caption) in zip(axes, panels_of, strict=True):
        draw_cut(ax, Path(path), np.array(normal), offset)
        ax.set_xlabel(caption)
    save(figure, out)


def draw_cut(ax, path, normal, offset):
    points = table(path, 3)
    cells = table(path.with_suffix(".ele")).astype(int)
    labels = cells[:, 4] if cells.shape[1] > 4 else np.zeros(len(cells), dtype=int)
    cells = cells[:, :4]
    is_kept = points[cells].mean(axis=1) @ normal < offset
    rows = table(path.with_suffix(".face")).astype(int).tolist()
    markers = {tuple(sorted(row[:3])): row[3] for row in rows}
    faces = seen_faces(cells[is_kept], labels[is_kept])
    corners = np.array([points[list(face)] for face, _ in faces])
    turned = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    turned /= np.maximum(np.linalg.norm(turned, axis=1, keepdims=True), 1e-300)
    right, up, toward = axes_of_eye()
    is_seen = turned @ toward > 1e-9
    depth = (corners @ toward).mean(axis=1)
    shade = 0.62 + 0.38 * np.clip(turned @ (LIGHT / np.linalg.norm(LIGHT)), 0, 1)
    order = [at for at in np.argsort(depth) if is_seen[at]]
    flat = np.stack([corners @ right, corners @ up], axis=2)
    colors = []
    for at in order:
        face, label = faces[at]
        marker = markers.get(tuple(sorted(face)))
        is_cell = marker is None
        base = CELLS[label % len(CELLS)] if is_cell else FACETS[marker % len(FACETS)]
        rgb = np.array([int(base[k : k + 2], 16) for k in (1, 3, 5)]) / 255
        colors.append(tuple(np.clip(rgb * shade[at], 0, 1)))
    ax.add_collection(
        PolyCollection(flat[order], facecolors=colors, edgecolors="#333333", linewidths=0.35)
    )
    low, high = flat.min(axis=(0, 1)), flat.max(axis=(0, 1))
    room = 0.03 * (high - low).max()
    ax.set(xlim=(low[0] - room, high[0] + room), ylim=(low[1] - room, high[1] + room))
    ax.set(xticks=[], yticks=[], aspect="equal")
    ax.grid(False)
    for spine in ax.spines.values():
        spine.set_visible(False)


def seen_faces(cells, labels):
    """Returns the faces of cells that no other of them has, seen from outside, with the label."""
    sides = {}
    for cell, label in zip(cells.tolist(), labels.tolist(), strict=True):
        for face in FACES:
            face = tuple(cell[at] for at in face)
            key = tuple(sorted(face))
            sides[key] = None if key in sides else (face, label)
    return [side for side in sides.values() if side is not None]


def axes_of_eye():
    """Returns the directions right, up and toward the eye."""
    toward = np.array(
        [
            np.cos(ELEVATION) * np.cos(AZIMUTH),
            np.cos(ELEVATION) * np.sin(AZIMUTH),
            np.sin(ELEVATION),
        ]
    )
    right = np.cross([0, 0, 1], toward)
    right /= np.linalg.norm(right)
    return right, np.cross(toward, right), toward

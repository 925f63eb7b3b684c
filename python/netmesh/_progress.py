"""Progress of a run, told to the caller."""

from __future__ import annotations

from typing import Any, Callable, Optional

from ._errors import ArgumentTypeError
from ._netmesh import Progress


def reporter(progress: Any) -> Optional[Callable[[Progress], Any]]:
    """Return a function of a `Progress`: the caller's, or one that moves the caller's bar."""
    if progress is None or callable(progress):
        return progress
    if not all(hasattr(progress, name) for name in ("update", "n", "total")):
        kind = type(progress).__name__
        raise ArgumentTypeError(f"progress is of type {kind}; it must be a function or a bar as tqdm's")
    if progress.total is None:
        progress.total = 1

    def move(report: Progress) -> None:
        if report.fraction >= 0:
            progress.update(report.fraction * progress.total - progress.n)

    return move

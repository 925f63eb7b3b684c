"""Words that no option has are found by a checker of types, before anything runs."""

import os
import pathlib
import re

import pytest

import netmesh

RIGHT = """
import netmesh

m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], output="well_spaced", extent="hull")
inside = m.part("hull").volumes
at = m.interpolate(m.points[:, 0], [[0.2, 0.2]], interpolation="sibson", outside="nearest")
counts, edges = m.quality_histogram("smallest_angle")
where = m.nearest([[0.2, 0.2]], among="inputs")[0]
alpha = m.filtration("mesh")
domain: netmesh.Domain = netmesh.domain([(0, 0), (1, 0), (0, 1)])
"""

#: Lines with one wrong word each.
WRONG = [
    'netmesh.mesh([[0, 0], [1, 0], [0, 1]], output="wellspaced")',
    'netmesh.mesh([[0, 0], [1, 0], [0, 1]], crossings="cut")',
    'm.part("convex")',
    'm.interpolate([0.0], [[0, 0]], outside="zero")',
    'm.quality_histogram("angle")',
    'm.nearest([[0, 0]], among="points")',
    'm.filtration("rips")',
    'm.placements("circle")',
]


def errors_of(script, folder):
    api = pytest.importorskip("mypy.api")
    path = folder / "script.py"
    path.write_text(script)
    package = str(pathlib.Path(netmesh.__file__).parents[1])
    before = os.environ.get("MYPYPATH")
    os.environ["MYPYPATH"] = package
    try:
        # What mypy reads it finds beside itself, or where that path leads.
        out, complaints, _ = api.run(["--strict", "--follow-imports=silent", "--cache-dir", str(folder), str(path)])
    finally:
        os.environ.pop("MYPYPATH") if before is None else os.environ.update(MYPYPATH=before)
    assert not complaints, complaints
    return re.findall(r"script\.py:(\d+): error: (.*)", out)


def test_right_words_have_no_error_and_each_wrong_one_has_one(tmp_path):
    assert errors_of(RIGHT, tmp_path) == []
    lines = ["import netmesh", "m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])", *WRONG]
    found = errors_of("\n".join(lines) + "\n", tmp_path)
    assert [int(line) for line, _ in found] == list(range(3, 3 + len(WRONG))), found
    assert all("Literal" in message for _, message in found), found

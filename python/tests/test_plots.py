"""The pictures of the experiments are drawn from the tables that are shipped."""

import re
import subprocess
import sys
import xml.dom.minidom

import pytest
from checkout import needed


def test_every_picture_of_the_experiments_is_drawn_from_its_table(tmp_path):
    program, reports = needed("bench", "plots", "draw.py"), needed("docs", "reports")
    pytest.importorskip("matplotlib")
    command = [sys.executable, program, "experiments", reports, tmp_path]
    subprocess.run(command, check=True)
    shown = re.findall(r"!\[.*?\]\(\./(.*?)\)", (reports / "experiments.md").read_text(encoding="utf-8"))
    assert len(shown) == 12
    assert sorted(shown) == sorted(path.name for path in tmp_path.glob("*.svg"))
    for path in tmp_path.glob("*.svg"):
        picture = xml.dom.minidom.parse(str(path))
        curves = [group for group in picture.getElementsByTagName("g") if "line2d" in group.getAttribute("id")]
        assert len(curves) > 5, path
    sizes = (tmp_path / "sizes.svg").read_text(encoding="utf-8")
    for words in ("3D, radius-edge 1.414", ">TetGen<", ">sphere<", "took too long"):
        assert words in sizes, words

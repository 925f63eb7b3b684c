"""Files of the repository that tests need beside the package; without them, as with a copy of the tests, they skip."""

import pathlib

import pytest

ROOT = pathlib.Path(__file__).parents[2]


def needed(*parts):
    """Returns the path of a file or folder of the repository, or skips the test."""
    path = ROOT.joinpath(*parts)
    if not path.exists():
        pytest.skip(f"{'/'.join(parts)} of the repository is not there")
    return path

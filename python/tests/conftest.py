"""Fixtures that all tests share."""

import fnmatch
import os
import sys

# The machine has cores for one thing at a time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import pytest

# Tests of the repository look at what is in its folders.
sys.dont_write_bytecode = True


@pytest.fixture
def random():
    return np.random.default_rng(1)


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: runs if NETMESH_SLOW is set")


def pytest_collection_modifyitems(items):
    """A module may list tests that must fail, by name (a pattern), with the reason."""
    for item in items:
        if item.get_closest_marker("slow") and not os.environ.get("NETMESH_SLOW"):
            item.add_marker(pytest.mark.skip(reason="takes long; NETMESH_SLOW=1 runs it"))
        differences = getattr(item.module, "DIFFERENCES", {}) if hasattr(item, "module") else {}
        for pattern, reason in differences.items():
            if fnmatch.fnmatchcase(item.nodeid.split("::", 1)[1].replace("::", "."), pattern):
                item.add_marker(pytest.mark.xfail(reason=reason, strict=True))

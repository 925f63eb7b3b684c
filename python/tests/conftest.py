"""What all tests share."""

import os

# The machine has cores for one thing at a time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import pytest


@pytest.fixture
def random():
    return np.random.default_rng(1)

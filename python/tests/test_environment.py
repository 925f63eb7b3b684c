"""Meshes are the same in every floating-point environment that Python may be in, and it stays.

A shared object that sets flush-to-zero when it is loaded does so for the whole process: each
environment is tried in a process of its own.
"""

import platform
import shutil
import subprocess
import sys

import pytest

MACHINE = {"x86_64": "x86-64", "AMD64": "x86-64", "aarch64": "aarch64"}.get(platform.machine())

pytestmark = pytest.mark.skipif(
    MACHINE is None or not sys.platform.startswith("linux"),
    reason="fesetround's numbers are known for Linux on x86-64 and aarch64",
)

# Code that compilers before GCC 13 linked into every shared object that was made with -Ofast.
FAST = """
#if defined(__x86_64__)
#include <xmmintrin.h>
__attribute__((constructor)) static void set_fast(void) { _mm_setcsr(_mm_getcsr() | 0x8040u); }
#else
#include <stdint.h>
__attribute__((constructor)) static void set_fast(void)
{
    uint64_t control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    __asm__ volatile("msr fpcr, %0" : : "r"(control | 1u << 24));
}
#endif
"""

ROUNDINGS = {
    "x86-64": {"upwards": 0x800, "downwards": 0x400, "to zero": 0xC00},
    "aarch64": {"upwards": 0x400000, "downwards": 0x800000, "to zero": 0xC00000},
}

# Division by zero, invalid operations and overflow; Python itself is inexact all the time.
TRAPS = {"x86-64": 0x0D, "aarch64": 0x07}

PROGRAM = """
import ctypes, ctypes.util, hashlib, sys
import numpy as np
import netmesh

libm = ctypes.CDLL(ctypes.util.find_library("m"))
kind, value = sys.argv[1:3]
unit = 5e-324
grid = np.stack(np.meshgrid(np.arange(12), np.arange(12)), axis=-1).reshape(-1, 2)
steps = (np.arange(80).reshape(-1, 2) * [7919, 104729] % 99991).astype(np.int64)
subnormal = np.vstack([[1e-310, 0], [0, 3e-309], steps.view(np.float64)])
triples = [(16, 63), (63, 16), (25, 60), (60, 25), (33, 56), (56, 33), (39, 52), (52, 39)]
circle = np.array([(x * a, y * b) for x, y in triples for a in (-1, 1) for b in (-1, 1)], float)
cube = np.stack(np.meshgrid(*[np.arange(4)] * 3), axis=-1).reshape(-1, 3) * 0.1
inputs = [(grid * 0.1, 0.08), (subnormal, 1.0), (circle, 30.0), (cube, 0.2)]
queries = [points * 0.75 for points, _ in inputs]

if kind == "load":
    ctypes.CDLL(value)
elif kind == "round":
    assert libm.fesetround(int(value)) == 0

one, little = np.float64(1), np.float64(2**-60)

def state():
    flushes = sys.float_info.min / 2 == 0
    return bool(one + little > one), bool(-one - little < -one), bool(one - little < one), flushes

def trapping(call):
    if kind == "trap":
        libm.feenableexcept(int(value))
    try:
        return call()
    finally:
        if kind == "trap":
            libm.fedisableexcept(int(value))

def look(answer):
    def asked(*_):
        seen.append(state() == before)
        return answer
    return asked

before = state()
assert any(before) == (kind in ("load", "round")), before
digest, seen = hashlib.sha256(), []

def add(*arrays):
    for array in arrays:
        digest.update(np.ascontiguousarray(array).tobytes())

for (points, size), x in zip(inputs, queries):
    for options in ({}, {"output": "well_spaced", "size": look(size)}, {"algorithm": "delaunay"}):
        m = trapping(lambda: netmesh.mesh(points, threads=2, progress=look(True), **options))
        add(m.points, m.simplices, trapping(lambda: m.volumes), trapping(lambda: m.circumcenters))
        add(trapping(lambda: m.locate(x, threads=2)), *trapping(lambda: m.nearest(x)))
        add(trapping(lambda: m.interpolate(m.points, x)))
        report = trapping(lambda: m.validate())
        assert report.level == 3 and report.violations == 0, report
        quality = trapping(lambda: m.quality())
        digest.update(repr((report.checked, quality)).encode())
    filtration = trapping(lambda: m.filtration())
    add(filtration.values(1), filtration.values(2))
    assert state() == before
assert all(seen) and len(seen) > 20, seen
print(digest.hexdigest())
"""


def made_in(*environment):
    command = [sys.executable, "-c", PROGRAM, *environment]
    made = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert made.returncode == 0, (environment, made.returncode, made.stderr)
    return made.stdout


@pytest.fixture(scope="module")
def usual():
    return made_in("none", "")


@pytest.mark.parametrize("rounding", ["upwards", "downwards", "to zero"])
def test_meshes_do_not_depend_on_the_rounding(usual, rounding):
    assert made_in("round", str(ROUNDINGS[MACHINE][rounding])) == usual


def test_meshes_do_not_depend_on_a_shared_object_that_flushes_to_zero(usual, tmp_path):
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler makes the shared object")
    source, library = tmp_path / "fast.c", tmp_path / "fast.so"
    source.write_text(FAST)
    subprocess.run([compiler, "-shared", "-fPIC", "-o", library, source], check=True)
    assert made_in("load", str(library)) == usual


def test_traps_do_not_end_a_call(usual):
    assert made_in("trap", str(TRAPS[MACHINE])) == usual

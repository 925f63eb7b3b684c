"""Progress, signals, other threads, memory."""

import signal
import subprocess
import sys
import threading
import time

import netmesh
import numpy as np
import pytest
from checkout import needed


def test_progress_is_told(random):
    reports = []
    m = netmesh.mesh(random.random((5000, 2)), progress=reports.append)
    phases = [report.phase for report in reports]
    order = ["prepare", "insert", "finish", "export"]
    assert set(phases) <= set(order) and "insert" in phases
    assert [order.index(phase) for phase in phases] == sorted(map(order.index, phases))
    fractions = [report.fraction for report in reports]
    assert fractions == sorted(fractions) and 0 <= fractions[0] < fractions[-1] <= 1
    assert 0 < max(report.vertices for report in reports) <= len(m.points)
    assert max(report.inputs_inserted for report in reports) <= 5000
    assert repr(reports[-1]).startswith("Progress(phase='")
    with pytest.raises(AttributeError):
        reports[0].fraction = 2


def test_false_stops_a_run(random):
    points = random.random((5000, 2))
    for answer in (False, 0, np.False_):
        with pytest.raises(netmesh.CancelledError, match="the progress function cancelled the run"):
            netmesh.mesh(points, progress=lambda report: answer)
    for answer in (True, None, 1, "go on"):
        netmesh.mesh(points[:100], progress=lambda report: answer)


def test_an_exception_stops_a_run_and_comes_out(random):
    error = KeyError("mine")
    calls = []

    def fail(report):
        calls.append(report)
        raise error

    with pytest.raises(KeyError) as raised:
        netmesh.mesh(random.random((5000, 2)), progress=fail)
    assert raised.value is error and len(calls) == 1


def test_a_bar_of_tqdm_moves_to_its_end(random):
    tqdm = pytest.importorskip("tqdm")
    for total in (None, 1, 100):
        with tqdm.tqdm(total=total, disable=False, file=open("/dev/null", "w")) as bar:
            netmesh.mesh(random.random((3000, 2)), progress=bar)
            assert bar.n == (total or 1)
    with pytest.raises(TypeError, match="^progress is of type int"):
        netmesh.mesh(random.random((10, 2)), progress=3)


INTERRUPTED = """
import signal
import numpy as np, netmesh

# A shell has what it runs in the background ignore it.
signal.signal(signal.SIGINT, signal.default_int_handler)

points = np.random.default_rng(1).random((8_000_000, 3))
m = netmesh.mesh(points[:3000])
before = m.points.copy()
said = []

def report(progress):
    if progress.phase == "insert" and not said:
        said.append(print("running", flush=True))

for call in [
    lambda: netmesh.mesh(points[:2_000_000], progress=report),
    lambda: netmesh.mesh(points[:2_000_000]),
    lambda: m.locate(points),
    lambda: m.nearest(points),
    lambda: m.interpolate(m.points, points),
]:
    if said:
        print("running", flush=True)
    try:
        call()
        print("not interrupted", flush=True)
    except KeyboardInterrupt:
        print("interrupted", bool((m.points == before).all()), flush=True)
"""


def test_ctrl_c_from_another_process_stops_a_call():
    child = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED], stdout=subprocess.PIPE, text=True
    )
    try:
        for _ in range(5):
            assert child.stdout.readline() == "running\n"
            # It is in the call by now, which takes many seconds.
            time.sleep(0.3)
            child.send_signal(signal.SIGINT)
            start = time.monotonic()
            assert child.stdout.readline() == "interrupted True\n"
            assert time.monotonic() - start < 3
        assert child.wait(10) == 0
    finally:
        child.kill()
        child.stdout.close()
        child.wait()


class Alarm(Exception):
    pass


def fail(number, frame):
    raise Alarm


def sphere(random, n):
    points = random.normal(size=(n, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def long_queries(random):
    """Calls that take many seconds, of many points that take little each, and of few that take much."""
    plain = {"algorithm": "delaunay"}
    m, wide = netmesh.mesh(random.random((20_000, 3)), **plain), netmesh.mesh(random.random((40, 6)), **plain)
    ball = netmesh.mesh(sphere(random, 5000), **plain)
    x, values = random.random((3_000_000, 3)), random.random(20_000)
    for how in ("linear", "laplace", "sibson"):
        yield how, lambda: m.interpolate(values, x, interpolation=how)
        yield f"{how}, two threads", lambda: m.interpolate(values, x, interpolation=how, threads=2)
    middles = wide.points[wide.simplices].mean(axis=1).repeat(20, axis=0)
    yield "six dimensions", lambda: wide.interpolate(np.zeros(40), middles, interpolation="sibson")
    yield "locate", lambda: m.locate(x)
    yield "nearest", lambda: m.nearest(x)
    # All inputs are equally near.
    yield "nearest of a sphere", lambda: ball.nearest(np.zeros((300_000, 3)), among="inputs")
    # One point may take long, too.
    far = netmesh.NearestNDInterpolator(sphere(random, 3_000_000), np.zeros(3_000_000))
    yield "nearest of a large sphere", lambda: far([[0, 0, 0]])
    f = netmesh.LinearNDInterpolator(m.points, values)
    yield "LinearNDInterpolator", lambda: f(x)
    yield "find_simplex", lambda: f.tri.find_simplex(x)
    mesh = netmesh.mesh(random.random((100_000, 2)))
    yield "extend_values", lambda: mesh.extend_values(np.zeros((100_000, 30)))


def seconds_until_alarm(call, delay):
    """Returns how long after the alarm the call goes on, or None if it ends before it."""
    signal.setitimer(signal.ITIMER_REAL, delay)
    start = time.monotonic()
    try:
        call()
    except Alarm:
        return max(0, time.monotonic() - start - delay)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    return None


@pytest.fixture
def alarm():
    before = signal.signal(signal.SIGALRM, fail)
    yield
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


def test_a_signal_ends_every_query_within_a_third_of_a_second(random, alarm):
    for name, call in long_queries(random):
        # The first call makes the index, and a fast machine answers some within this time.
        delay, needed = 0.3, []
        # The best of some: others may have the processor now and then.
        while min(needed, default=1) >= 0.3 and len(needed) < 4:
            seconds = seconds_until_alarm(call, delay)
            if seconds is None:
                delay /= 3
                assert delay > 0.01, name
            else:
                needed.append(seconds)
        assert min(needed) < 0.3, (name, needed)


def test_a_signal_ends_the_wait_for_what_the_library_cannot_stop(random, alarm):
    points, x = random.random((400_000, 2)), random.random((1000, 2))

    def mesh():
        return netmesh.mesh(points, algorithm="delaunay")

    whole = mesh()
    for call in [
        lambda m: m.locate(x),
        lambda m: m.quality(),
        lambda m: m.validate(1),
        lambda m: m.circumcenters,
    ]:
        start = time.monotonic()
        call(whole)
        whole_seconds = time.monotonic() - start
        # A wait that goes on takes as long as the call; one that ends has a thread to begin.
        # The best of some: others may have the processor now and then.
        for _ in range(5):
            m = mesh()
            seconds = seconds_until_alarm(lambda: call(m), whole_seconds / 10)
            if seconds is not None and seconds < 0.6 * whole_seconds:
                break
        else:
            pytest.fail(f"{seconds} of {whole_seconds} seconds")
    # The work that another thread had begun is there.
    m = mesh()
    seconds_until_alarm(lambda: m.locate(x), 0.001)
    assert (m.locate(x) == whole.locate(x)).all()


def test_other_threads_of_python_go_on(random):
    points = random.random((40000, 3))
    m = netmesh.mesh(points[:100])
    x = random.random((1_000_000, 3))
    for call in (lambda: netmesh.mesh(points), lambda: m.locate(x), lambda: m.nearest(x)):
        worker = threading.Thread(target=call)
        start = last = time.monotonic()
        longest = 0
        worker.start()
        while worker.is_alive():
            now = time.monotonic()
            longest, last = max(longest, now - last), now
        assert longest < (last - start) / 2


def test_many_threads_ask_at_once(random):
    """The first to ask makes the index; all get the same answers."""
    points, x = random.random((5000, 3)), random.random((20000, 3))
    m, values = netmesh.mesh(points), []
    expected = netmesh.mesh(points).locate(x)

    def ask():
        values.append((m.locate(x) == expected).all() and (m.nearest(m.points)[1] == 0).all())

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert values == [True] * 8


def test_ten_thousand_meshes_leave_no_memory_behind():
    script = needed("python", "benchmarks", "leak.py")
    told = subprocess.run([sys.executable, script], check=True, stdout=subprocess.PIPE, text=True)
    sizes = [int(line.split()[2]) for line in told.stdout.splitlines()]
    # A mesh of these takes 10 kB: one in a hundred would show.
    assert len(sizes) == 10 and sizes[-1] - sizes[0] < 1 << 20


def assert_same(one, two):
    for name in ("points", "simplices", "neighbors", "kinds", "domains", "vertex_domains"):
        assert (getattr(one, name) == getattr(two, name)).all()


def test_equal_runs_make_equal_meshes(random):
    points = random.random((2000, 3))
    assert_same(netmesh.mesh(points), netmesh.mesh(points, threads=2, progress=lambda report: None))


@pytest.mark.slow
def test_a_large_mesh_does_not_depend_on_threads(random):
    points = random.random((550_000, 2))
    assert_same(netmesh.mesh(points), netmesh.mesh(points, threads=2))

"""No process outlives its use, and none that is not ours is touched."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from autograder.errors import SandboxError
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Outputs, Sandbox
from tests.sandbox.conftest import LIMITS, batch, inputs

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks at /proc")
SPIN = Source("module", ["def f(x, graph):\n    while True: pass\n"], "student")


def children(pid: int, *, dead: bool = False) -> list[int]:
    """List the children of a process; on request also those that have ended and are not yet reaped."""
    found = []
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                fields = (folder / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            if int(fields[1]) == pid and (dead or fields[0] != "Z"):
                found.append(int(folder.name))
    return found


def descriptors() -> int:
    """Count the open descriptors of this process."""
    return len(list(Path("/proc/self/fd").iterdir()))


def gone(pid: int, seconds: float = 5.0) -> bool:
    """Wait until a process has ended."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            return True
        if state == "Z":
            return True
        time.sleep(0.01)
    return False


def test_children_are_reaped() -> None:
    """After sessions that ended in every way, the fork server has no child and no zombie."""
    with Sandbox(inputs(), LIMITS) as sandbox:
        texts = ["def f(x, graph): return x\n", "import os\nos._exit(0)\n", "def f(x, graph):\n    while True: pass\n"]
        for text in texts:
            with sandbox.open(Source("module", [text], "student")) as session:
                session.load()
                session.call(batch())
        end = time.monotonic() + 2
        while children(sandbox.server.pid, dead=True) and time.monotonic() < end:
            time.sleep(0.01)
        assert children(sandbox.server.pid, dead=True) == []


def test_closing_ends_everything() -> None:
    """The fork server and a child that still runs end with the sandbox; no descriptor stays open."""
    before = descriptors()
    sandbox = Sandbox(inputs(), LIMITS)
    session = sandbox.open(SPIN)
    session.load()
    deadline = time.monotonic() + 5.0
    while len(found := children(sandbox.server.pid)) > 1 and time.monotonic() < deadline:
        time.sleep(0.01)  # the canary of the start was killed, and is reaped a moment later
    (child,) = found
    sandbox.close()
    assert gone(child)
    assert gone(sandbox.server.pid)
    session.close()
    assert descriptors() == before


def test_a_lost_fork_server_is_the_graders_fault() -> None:
    """Its children die with it, and the error says that it has gone."""
    with Sandbox(inputs(), LIMITS) as sandbox:
        session = sandbox.open(SPIN)
        session.load()
        (child,) = children(sandbox.server.pid)
        os.kill(sandbox.server.pid, signal.SIGKILL)
        assert gone(child)
        with pytest.raises(SandboxError, match="fork server"):
            session.call(batch())
        session.close()


GRADER = """
import sys
sys.path.insert(0, sys.argv[1])
from autograder.sandbox.host import Sandbox
from tests.sandbox.conftest import LIMITS, batch, inputs
from tests.sandbox.test_processes import SPIN, children
sandbox = Sandbox(inputs(), LIMITS)
session = sandbox.open(SPIN)
session.load()
print(sandbox.server.pid, children(sandbox.server.pid)[0], flush=True)
sys.stdin.read()
"""


def test_everything_dies_with_the_grader() -> None:
    """A grader that is killed without a chance to tidy up leaves neither fork server nor child."""
    grader = subprocess.Popen(
        [sys.executable, "-c", GRADER, str(ROOT)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    with grader:
        assert grader.stdout is not None
        server, child = map(int, grader.stdout.readline().split())
        grader.kill()
    assert gone(server)
    assert gone(child)


def test_a_hostile_submission_leaves_the_next_one_clean(sandbox: Sandbox) -> None:
    """What one submission changes in its process, another never sees."""
    hostile = """
import sys, numpy as np, posegraph, random
builtins = sys.modules["builtins"]
np.allclose = lambda *a: True
builtins.isinstance = lambda *a: True
builtins.leaked = 1
posegraph.PoseGraph = None
np.seterr(all="raise")
sys.setrecursionlimit(50)
np.core.leaked = 1
random.seed(1)
"""
    clean = """
import sys, numpy as np, posegraph
def f(x, graph):
    leaked = hasattr(sys.modules["builtins"], "leaked") or hasattr(np.core, "leaked")
    strict = np.geterr()["divide"] == "raise"
    return [leaked, strict, np.allclose(0, 1), posegraph.PoseGraph is None, sys.getrecursionlimit() < 100]
"""
    with sandbox.open(Source("module", [hostile], "hostile")) as session:
        session.load()
        with sandbox.open(Source("module", [clean], "clean")) as other:
            outputs = other.call(batch())
    assert isinstance(outputs, Outputs)
    assert outputs.data.tolist() == [0, 0, 0, 0, 0]


def test_a_child_has_four_descriptors() -> None:
    """However many the grader has open, a child inherits its input, its output and its channel, and no more."""
    opened = [os.open("/dev/null", os.O_RDONLY) for _ in range(100)]
    for descriptor in opened:
        os.set_inheritable(descriptor, True)
    try:
        with Sandbox(inputs(), LIMITS) as sandbox, sandbox.open(SPIN) as session:
            session.load()
            (child,) = children(sandbox.server.pid)
            try:
                found = sorted(int(path.name) for path in Path(f"/proc/{child}/fd").iterdir())
            except PermissionError:
                pytest.skip("an ordinary user may not look into a child that cannot be inspected")
            assert found == [0, 1, 2, 3]
    finally:
        for descriptor in opened:
            os.close(descriptor)

"""The level of confinement is found at the start, said in fixed words, and never lowered in silence."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from autograder.errors import SandboxError
from autograder.sandbox.frames import Ready
from autograder.sandbox.host import Confinement, Sandbox
from autograder.sandbox.server import confinement_of
from tests.sandbox.conftest import LIMITS, inputs

linux = pytest.mark.skipif(sys.platform != "linux", reason="the locks are Linux's own")

WORDS = {
    "a new kernel": (Ready("", "", 7, ""), "full: seccomp + Landlock ABI 7 (files, TCP, signals)"),
    "Linux 6.7": (Ready("", "", 4, ""), "full: seccomp + Landlock ABI 4 (files, TCP)"),
    "Linux 5.13": (Ready("", "", 1, ""), "full: seccomp + Landlock ABI 1 (files)"),
    "an old kernel": (
        Ready("", "the kernel does not have it", 0, ""),
        "seccomp: Landlock unavailable (the kernel does not have it)",
    ),
    "another system": (
        Ready("not available on darwin", "not available on darwin", 0, ""),
        "none: NOT CONFINED: time-outs only. Grade only code you trust. (seccomp: not available on darwin)",
    ),
}


@pytest.mark.parametrize(("ready", "words"), WORDS.values(), ids=WORDS.keys())
def test_every_level_has_its_words(ready: Ready, words: str) -> None:
    """Landlock alone is no confinement; seccomp alone is one, and says what is missing."""
    assert confinement_of(ready).wording == words


@linux
def test_this_machine_has_a_lock(sandbox: Sandbox) -> None:
    """On the machines that these tests are for, the filter is there."""
    assert sandbox.confinement.level in {"full", "seccomp"}
    assert isinstance(sandbox.confinement, Confinement)


@linux
def test_without_landlock_the_level_says_so() -> None:
    """The level drops to `seccomp`, with the reason, and every attempt of the canary still fails."""
    with Sandbox(inputs(), LIMITS, without=["landlock"]) as sandbox:
        assert sandbox.confinement.wording == "seccomp: Landlock unavailable (switched off)"
        assert sandbox.probe() == []


SAYS_YES_AND_MEANS_NO = """
import ctypes, os, struct, sys

# what some containers do: a process may ask whether it has a filter, and may not set one
prctl, seccomp = {"x86_64": (157, 317), "aarch64": (167, 277)}[os.uname().machine]
load, equal, end = 0x20, 0x15, 0x06
code = [
    (load, 0, 0, 0),  # the number of the call
    (equal, 4, 0, seccomp),
    (equal, 0, 2, prctl),
    (load, 0, 0, 16),  # its first argument
    (equal, 1, 0, 22),  # PR_SET_SECCOMP
    (end, 0, 0, 0x7FFF0000),
    (end, 0, 0, 0x00050001),  # EPERM
]
program = ctypes.create_string_buffer(b"".join(struct.pack("<HBBI", *each) for each in code))
header = ctypes.create_string_buffer(struct.pack("<HxxxxxxQ", len(code), ctypes.addressof(program)))
libc = ctypes.CDLL(None, use_errno=True)
assert libc.prctl(38, 1, 0, 0, 0) == 0
assert libc.prctl(22, 2, header, 0, 0) == 0
assert libc.prctl(21, 0, 0, 0, 0) == 2  # asking is allowed

from autograder.errors import SandboxError
from autograder.sandbox.host import Sandbox
from tests.sandbox.conftest import LIMITS, inputs

try:
    Sandbox(inputs(), LIMITS)
except SandboxError as error:
    print(error)
with Sandbox(inputs(), LIMITS, allow_unconfined=True) as sandbox:
    print(sandbox.confinement.wording)
"""


@linux
def test_what_can_be_locked_is_found_out_by_locking() -> None:
    """Where a filter may be asked for and not set, nothing is graded; who trusts the code can still go on."""
    root = Path(__file__).parents[2]
    done = subprocess.run(
        [sys.executable, "-c", SAYS_YES_AND_MEANS_NO], cwd=root, capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stderr
    refused, allowed = done.stdout.splitlines()
    assert "--allow-unconfined" in refused
    assert allowed.startswith("none: NOT CONFINED")
    assert "tried, and refused by the kernel" in allowed


@linux
def test_no_lock_is_refused() -> None:
    """Without the filter nothing is graded, unless that was asked for."""
    with pytest.raises(SandboxError, match="--allow-unconfined"):
        Sandbox(inputs(), LIMITS, without=["seccomp"])
    with Sandbox(inputs(), LIMITS, without=["seccomp"], allow_unconfined=True) as sandbox:
        assert sandbox.confinement.level == "none"


@linux
def test_the_canary_notices_an_open_door() -> None:
    """Every attempt of the canary succeeds where no lock is on."""
    with Sandbox(inputs(), LIMITS, without=["seccomp", "landlock", "rlimits"], allow_unconfined=True) as sandbox:
        assert len(sandbox.probe()) == 11


@linux
def test_a_lock_that_does_not_hold_ends_the_grading(monkeypatch: pytest.MonkeyPatch) -> None:
    """A claim that the canary disproves is an error that names what got through."""
    monkeypatch.setattr(Sandbox, "probe", lambda _: ["fork", "open a file"])
    with pytest.raises(SandboxError, match="could fork, open a file"):
        Sandbox(inputs(), LIMITS)


def test_a_fork_server_that_does_not_start_is_an_error() -> None:
    """Inputs that cannot be built are the grader's fault, and the error says what was wrong."""
    with pytest.raises(SandboxError, match="did not start: ValueError: n_poses must be at least 2"):
        Sandbox(inputs_with_a_bad_graph(), LIMITS)


def inputs_with_a_bad_graph() -> bytes:
    """Encode a graph of one pose."""
    from autograder.sandbox.frames import GraphData, Inputs, encode_inputs  # noqa: PLC0415  # for this alone

    return encode_inputs(Inputs([GraphData(1, b"", b"", b"", b"", b"", b"")], []))


def test_the_room_imports_without_the_locks() -> None:
    """On a system without fork, fcntl and resource the grader's side still imports, to say what to do."""
    block = "import sys\nfor name in ('fcntl', 'resource', 'pwd', 'grp'): sys.modules[name] = None\n"
    code = block + "import autograder.sandbox.host\nprint('fine')"
    root = Path(__file__).resolve().parents[2]
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=root, timeout=60, check=True
    )
    assert done.stdout == "fine\n"

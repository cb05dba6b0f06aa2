"""Nothing that a submission tries beyond computing succeeds, as root and as an ordinary user."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from ctypes.util import find_library
from pathlib import Path

import pytest

from autograder.sandbox import seccomp
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Failure, Outputs, Sandbox
from tests.sandbox.conftest import LIMITS, batch, inputs
from tests.sandbox.escapes import ESCAPES, EVERY_CALL

ROOT = Path(__file__).resolve().parents[2]
NOBODY = 65534
linux = pytest.mark.skipif(sys.platform != "linux", reason="the locks are Linux's own")
pytestmark = linux


def escaped(sandbox: Sandbox) -> str:
    """Run every escape; name those that got through."""
    text = f"PARENT = {sandbox.server.pid}\n{ESCAPES}"
    with sandbox.open(Source("module", [text], "hostile")) as session:
        loaded = session.load()
        assert loaded.notes == (), loaded.notes
        outputs = session.call(batch())
    assert isinstance(outputs, Outputs), outputs
    return outputs.reasons.get(0, "")


def test_no_escape_succeeds(sandbox: Sandbox) -> None:
    """Files, processes, signals, sockets, descriptors and code are out of reach."""
    assert escaped(sandbox) == ""
    assert not Path("/tmp/escaped").exists()


def test_every_other_system_call_is_refused(sandbox: Sandbox) -> None:
    """All numbers that are not on the list fail with EPERM in a real child."""
    numbers = sorted(seccomp.ARCHITECTURES[os.uname().machine].numbers.values())
    text = f"ALLOWED = {numbers}\n{EVERY_CALL}"
    with sandbox.open(Source("module", [text], "hostile")) as session:
        outputs = session.call(batch(most=600))
    assert isinstance(outputs, Outputs), outputs
    assert outputs.data.tolist() == []


@pytest.mark.skipif(os.uname().machine != "x86_64", reason="x32 exists beside x86_64 only")
def test_the_other_calling_convention_kills(sandbox: Sandbox) -> None:
    """A call by x32 numbers ends the child."""
    text = "import sys\ndef f(x, graph):\n    sys.modules['ctypes'].CDLL(None).syscall(0x40000027)\n    return x\n"
    with sandbox.open(Source("module", [text], "hostile")) as session:
        failure = session.call(batch())
    assert isinstance(failure, Failure)
    assert (failure.reason, failure.message) == ("died", "it crashed the Python interpreter (SIGSYS)")


def test_landlock_alone_and_limits_alone_leave_holes() -> None:
    """Without the filter a majority of the escapes succeed: the test above would notice its loss."""
    with Sandbox(inputs(), LIMITS, allow_unconfined=True, without=["seccomp", "landlock", "rlimits"]) as open_sandbox:
        assert open_sandbox.confinement.level == "none"
        names = ESCAPES_THAT_HARM_NOBODY
        text = f"PARENT = {open_sandbox.server.pid}\n{ESCAPES}"
        for name in set(_names(text)) - names:  # not tried where nothing would stop them
            text = text.replace(f"@attempt\ndef {name}(", f"def {name}(")
        with open_sandbox.open(Source("module", [text], "hostile")) as session:
            outputs = session.call(batch())
        assert isinstance(outputs, Outputs), outputs
        through = set(outputs.reasons.get(0, "").replace("ValueError:", "").split())
        assert len(through) > len(names) / 2, sorted(names - through)


ESCAPES_THAT_HARM_NOBODY = {
    "open_to_read", "list_a_folder", "stat_a_file", "change_the_folder", "open_a_socket", "open_a_local_socket",
    "copy_a_descriptor", "make_a_pipe", "make_a_file_in_memory", "ask_for_the_machine", "map_executable_memory",
    "make_memory_executable", "signal_the_parent",
}  # fmt: skip  # a list of names


def _names(text: str) -> list[str]:
    return [line.split("(")[0].removeprefix("def ") for line in text.splitlines() if line.startswith("def ")]


# What a container's usual profile refuses, as a filter around the grader itself.
IN_A_CONTAINER = """
import errno, json, os, sys
import pyseccomp
profile = pyseccomp.SyscallFilter(pyseccomp.ALLOW)
for name in ("unshare", "setns", "mount", "umount2", "pivot_root", "ptrace", "bpf", "perf_event_open", "keyctl",
             "add_key", "request_key", "userfaultfd", "io_uring_setup", "kexec_load", "process_vm_readv", "syslog"):
    profile.add_rule(pyseccomp.ERRNO(errno.EPERM), name)
profile.add_rule(pyseccomp.ERRNO(errno.ENOSYS), "clone3")
profile.load()
"""
AND_THEN = """
sys.path.insert(0, sys.argv[1])
from autograder.sandbox.host import Sandbox
from tests.sandbox.conftest import LIMITS, inputs
from tests.sandbox.test_escapes import escaped
with Sandbox(inputs(), LIMITS) as sandbox:
    print(json.dumps([os.getuid(), sandbox.confinement.level, escaped(sandbox)]))
"""
# An ordinary user, but for the right to read the interpreter and the checkout, wherever they lie.
AS_NOBODY = """
import ctypes, json, os, sys
libc, reading = ctypes.CDLL(None), 1 << 2
libc.prctl(8, 1, 0, 0, 0)
os.setgroups([]), os.setgid(65534), os.setuid(65534)
assert libc.capset((ctypes.c_uint32 * 2)(0x20080522, 0), (ctypes.c_uint32 * 6)(reading, reading, reading)) == 0
assert libc.prctl(47, 2, 2, 0, 0) == 0
"""


@pytest.mark.skipif(
    os.getuid() != 0, reason="only root can become somebody else; as an ordinary user all tests show it"
)
def test_an_ordinary_user_has_the_same_lock(sandbox: Sandbox) -> None:
    """The lock needs no privilege: as nobody, the level is the same and no escape succeeds."""
    assert reported(AS_NOBODY + AND_THEN) == [NOBODY, sandbox.confinement.level, ""]


@pytest.mark.skipif(find_library("seccomp") is None, reason="libseccomp, which makes the profile, is not installed")
def test_a_containers_profile_leaves_the_lock_whole(sandbox: Sandbox) -> None:
    """Where namespaces are refused, as in a container, the level is the same and no escape succeeds."""
    assert reported(IN_A_CONTAINER + AND_THEN) == [os.getuid(), sandbox.confinement.level, ""]


def reported(script: str) -> object:
    """Run a script beside the checkout and read what it prints as JSON."""
    command = [sys.executable, "-B", "-c", script, str(ROOT)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)

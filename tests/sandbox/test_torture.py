"""numpy and the standard library work under the lock, and what the lock refuses can be named."""

from __future__ import annotations

import sys

import pytest

from autograder.errors import SandboxError
from autograder.sandbox import selftest
from autograder.sandbox.frames import Batch, Source
from autograder.sandbox.host import Limits, Outputs, Sandbox
from autograder.sandbox.refusals import TORTURE, line_to_review, trace
from autograder.sandbox.selftest import check_limits
from tests.sandbox.conftest import inputs

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the locks are Linux's own")


def test_the_torture_set_passes_under_the_lock() -> None:
    """Every part of the set gives the right value in a locked child."""
    with (
        Sandbox(inputs(), Limits(cpu_seconds=5)) as sandbox,
        sandbox.open(Source("module", [TORTURE.read_text("utf-8")], "torture")) as session,
    ):
        loaded = session.load()
        assert loaded.notes == ()
        names = sorted(name for name in loaded.functions if name.startswith("part_"))
        assert len(names) == 24
        for name in names:
            outputs = session.call(Batch(name, 1, 1, [[]]))
            assert isinstance(outputs, Outputs), (name, outputs)
            assert outputs.data.tolist() == [1.0], (name, outputs.reasons)


def traced(text: str) -> dict[str, dict[str, int]]:
    """Trace a text, or skip where the kernel cannot."""
    try:
        return {part.name: part.refused for part in trace(Source("module", [text], "traced"))}
    except SandboxError as error:
        pytest.skip(f"this machine cannot trace: {error}")


def test_a_refused_call_is_named() -> None:
    """The trace says which call a part was refused, and how often; the part itself sees an error as ever."""
    text = """
import os
def part_files():
    for _ in range(3):
        try:
            os.open("/etc/passwd", 0)
        except PermissionError:
            pass
    return 1.0
def part_processes():
    os.fork()
def part_none():
    return 1.0
"""
    refused = traced(text)
    assert refused["files"] == {"openat": 3}
    assert set(refused["processes"]) & {"clone", "clone3"}
    assert refused["none"] == refused["loading"] == {}


def test_the_line_to_review_is_the_policy() -> None:
    """The place that is named is where the allowed calls are listed."""
    assert line_to_review().startswith("autograder/sandbox/seccomp.py, line ")


def test_every_limit_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    """The self-test of the limits ends each in time and says which one it was."""
    monkeypatch.setattr(selftest, "_SLACK", 30.0)  # the machine may do much else beside
    with Sandbox(inputs(), Limits(cpu_seconds=0.2, memory_mib=64, output_bytes=1 << 20)) as sandbox:
        checks = {check.name: check for check in check_limits(sandbox)}
    assert [name for name, check in checks.items() if not check.held] == [], checks
    assert "0.2 s of computing" in checks["computing time"].message
    assert "printed more than 1 MiB" in checks["output"].message

"""Two submissions of one fork server have nothing in common that both could write to."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from autograder.sandbox.frames import Inputs, Source, encode_inputs
from autograder.sandbox.host import Sandbox


def below(pid: int) -> list[int]:
    """Name the processes that a process has started, and those that they have."""
    children = [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    return [*children, *(other for child in children for other in below(child))]


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="only Linux lists the memory of a process")
def test_a_child_shares_no_memory_and_no_stream_with_another() -> None:
    """No mapping is shared and writable; beside an empty input, the descriptors are its own pipe and socket."""
    source = Source("module", ["x = 1"], "x")
    before = set(below(os.getpid()))
    with Sandbox(encode_inputs(Inputs([], []))) as sandbox, sandbox.open(source) as one, sandbox.open(source) as two:
        one.load()
        two.load()
        server, *children = [pid for pid in below(os.getpid()) if pid not in before]
        assert len(children) == 2
        try:
            maps = [Path(f"/proc/{pid}/maps").read_text().splitlines() for pid in (server, *children)]
        except PermissionError:
            pytest.skip("the children are undumpable: only root may look")
        assert all(maps)
        assert [line for lines in maps for line in lines if line.split()[1] in ("rw-s", "-w-s", "rwxs")] == []
        held = [{str(link.readlink()) for link in Path(f"/proc/{pid}/fd").iterdir()} for pid in children]
        assert held[0] & held[1] == {"/dev/null"}
        assert [len(each) for each in held] == [3, 3]

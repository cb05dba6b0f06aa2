"""Runs the torture set in a traced child and names every system call that the lock refused.

A new version of Python, numpy or the C library may need a call that the policy does not know.
Then a part of the set fails or slows down, and this says which call it was and which line decides.
"""

from __future__ import annotations

import os
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from autograder.errors import SandboxError
from autograder.sandbox import seccomp
from autograder.sandbox.frames import Batch, Inputs, Source, encode_inputs
from autograder.sandbox.outputs import Expected, Failure
from autograder.sandbox.server import Limits, Server
from autograder.sandbox.session import Session

TORTURE = Path(__file__).with_name("torture.py")

# Calls that a refusal may name, beyond those of the policy: x86_64, aarch64. Others are given by number.
_NAMES: dict[str, tuple[int, int]] = {
    "openat": (257, 56), "close": (3, 57), "lseek": (8, 62), "readv": (19, 65), "writev": (20, 66),
    "newfstatat": (262, 79), "fstat": (5, 80), "statx": (332, 291), "readlinkat": (267, 78), "faccessat": (269, 48),
    "getdents64": (217, 61), "getcwd": (79, 17), "ioctl": (16, 29), "fcntl": (72, 25), "dup": (32, 23),
    "dup3": (292, 24), "pipe2": (293, 59), "socket": (41, 198), "clone": (56, 220), "clone3": (435, 435),
    "execve": (59, 221), "wait4": (61, 260), "kill": (62, 129), "tgkill": (234, 131), "gettid": (186, 178),
    "getppid": (110, 173), "getuid": (102, 174), "geteuid": (107, 175), "uname": (63, 160), "sysinfo": (99, 179),
    "getrusage": (98, 165), "times": (100, 153), "prlimit64": (302, 261), "prctl": (157, 167),
    "rt_sigaction": (13, 134), "rt_sigprocmask": (14, 135), "sigaltstack": (131, 132), "sched_setaffinity": (203, 122),
    "set_robust_list": (273, 99), "set_tid_address": (218, 96), "rseq": (334, 293), "membarrier": (324, 283),
    "getcpu": (309, 168), "mincore": (27, 232), "msync": (26, 227), "mlock": (149, 228), "get_mempolicy": (239, 236),
    "memfd_create": (319, 279), "poll": (7, -1), "ppoll": (271, 73), "select": (23, -1), "epoll_create1": (291, 20),
    "open": (2, -1), "stat": (4, -1), "access": (21, -1), "time": (201, -1), "arch_prctl": (158, -1),
    "pkey_mprotect": (329, 288), "futex_waitv": (449, 449), "process_madvise": (440, 440),
}  # fmt: skip  # a table


@dataclass(frozen=True)
class Part:
    """One part of the torture set: whether it worked, and which calls it was refused, with how often."""

    name: str
    passed: bool
    refused: dict[str, int]


def trace(source: Source | None = None, limits: Limits = Limits()) -> list[Part]:  # noqa: B008  # frozen
    """Run every function `part_...` of the torture set, or of another source, and note what was refused.

    Raises
    ------
    SandboxError
        Where this machine has no filter, or a kernel older than 5.6, which cannot tell.
    """
    source = source or Source("module", [TORTURE.read_text(encoding="utf-8")], TORTURE.stem)
    server = Server()
    server.set_up(encode_inputs(Inputs([], [])), limits, trace=True)
    try:
        if server.ready.seccomp:
            raise SandboxError(f"There is no filter to trace on this machine: {server.ready.seccomp}.")
        session = Session(server, limits, list[Expected](), source)
        loaded = session.load()
        parts = [Part("loading", not loaded.notes, _named(server.refused()))]
        for name in sorted(name for name in loaded.functions if name.startswith("part_")):
            outputs = session.call(Batch(name, 1, 1, [[]]))
            passed = not isinstance(outputs, Failure) and outputs.data.tolist() == [1.0]
            parts.append(Part(name.removeprefix("part_").replace("_", " "), passed, _named(server.refused())))
        session.close()
        return parts
    finally:
        server.close()


def line_to_review() -> str:
    """Say where the list of allowed calls begins."""
    path = Path(seccomp.__file__)
    lines = path.read_text(encoding="utf-8").splitlines()
    number = next(number for number, line in enumerate(lines, 1) if line.startswith("POLICY"))
    return f"autograder/sandbox/{path.name}, line {number}"


def _named(numbers: list[int]) -> dict[str, int]:
    machine = os.uname().machine
    place = list(seccomp.ARCHITECTURES).index(machine)
    names = {both[place]: name for name, both in _NAMES.items()}
    names |= {number: name for name, number in seccomp.ARCHITECTURES[machine].numbers.items()}
    return dict(Counter(names.get(number, f"call {number}") for number in numbers))

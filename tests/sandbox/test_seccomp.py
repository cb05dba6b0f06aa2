"""The system call filter says what libseccomp says for the same policy, call by call."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from autograder.sandbox import seccomp
from autograder.sandbox.seccomp import ARCHITECTURES, POLICY, Architecture, Equal, Instruction

try:
    import pyseccomp
except (ImportError, OSError, RuntimeError):
    pyseccomp = None
needs_libseccomp = pytest.mark.skipif(pyseccomp is None, reason="libseccomp is not installed")

# What a submission may do, once more, by hand: a call that slips into the policy fails this test.
ALLOWED = {
    "read", "write", "brk", "mmap", "munmap", "mremap", "madvise", "mprotect", "futex", "sched_yield",
    "sched_getaffinity", "getrandom", "clock_gettime", "clock_getres", "gettimeofday", "clock_nanosleep", "nanosleep",
    "restart_syscall", "getpid", "rt_sigreturn", "exit", "exit_group",
}  # fmt: skip  # a list of names
EVERY = pytest.mark.parametrize("machine", ARCHITECTURES)


def interpret(code: list[Instruction], number: int, audit: int, arguments: tuple[int, ...]) -> int:
    """Run a BPF program on one call, as the kernel does."""
    data = struct.pack("=IIQ6Q", number & 0xFFFFFFFF, audit, 0, *arguments)
    accumulator, at = 0, 0
    while True:
        operation, if_true, if_false, operand = code[at]
        at += 1
        if operation == 0x20:
            (accumulator,) = struct.unpack_from("=I", data, operand)
        elif operation == 0x54:
            accumulator &= operand
        elif operation == 0x05:
            at += operand
        elif operation in {0x15, 0x25, 0x35, 0x45}:
            holds = {
                0x15: accumulator == operand,
                0x25: accumulator > operand,
                0x35: accumulator >= operand,
                0x45: bool(accumulator & operand),
            }[operation]
            at += if_true if holds else if_false
        elif operation == 0x06:
            return operand
        else:
            raise AssertionError(f"an instruction that the interpreter does not know: {operation:#x}")


def calls(architecture: Architecture) -> Iterator[tuple[int, tuple[int, ...]]]:
    """List calls worth asking about: every number, and odd arguments for those with a rule."""
    # not -1, which a debugger makes of a call that it cancels, and which libseccomp lets fail instead of killing
    for number in [*range(600), *range(0x40000000, 0x40000000 + 600), 2**31, 2**32 - 2]:
        yield number, (0,) * 6
        yield number, (2**64 - 1,) * 6
    odd = (0, 1, 2, 3, 4, 5, 7, 0x20, 0x22, 0x24, 2**31, 2**32, 2**32 + 3, 2**63, 2**64 - 1)
    for name, rule in POLICY.items():
        places = [condition.argument for condition in rule]
        for values in product(odd, repeat=len(places)):
            arguments = [9] * 6
            for place, value in zip(places, values, strict=True):
                arguments[place] = value
            yield architecture.numbers[name], tuple(arguments)


def test_the_policy_is_the_one_that_was_agreed() -> None:
    """One system call too many fails here."""
    assert set(POLICY) == ALLOWED
    assert POLICY["read"] == (Equal(0, (0, 3)),)
    assert POLICY["write"] == (Equal(0, (1, 2, 3)),)


@EVERY
def test_every_call_of_the_policy_has_a_number(machine: str) -> None:
    """The tables hold the policy's calls and no other."""
    assert set(ARCHITECTURES[machine].numbers) == set(POLICY)


@EVERY
def test_executable_memory_is_refused(machine: str) -> None:
    """Memory is anonymous and never executable, whatever else is asked for."""
    architecture = ARCHITECTURES[machine]
    code = seccomp.program(architecture)
    answers = {
        (protection, flags): interpret(
            code, architecture.numbers["mmap"], architecture.audit, (0, 4096, protection, flags, 0, 0)
        )
        for protection in range(8)
        for flags in (0x02, 0x22, 0x01, 0x21)
    }
    for (protection, flags), answer in answers.items():
        fine = not protection & 4 and flags & 0x20
        assert answer == (seccomp.RET_ALLOW if fine else seccomp.RET_REFUSE), (protection, flags)


@EVERY
def test_a_call_of_another_architecture_kills(machine: str) -> None:
    """The i386 and x32 conventions do not get around the numbers."""
    architecture = ARCHITECTURES[machine]
    code = seccomp.program(architecture)
    for audit in (0x40000003, 0xC000003E, 0xC00000B7, 0x40000028, 0):
        if audit != architecture.audit:
            assert interpret(code, 0, audit, (0,) * 6) == seccomp.RET_KILL_PROCESS
    if architecture.x32:
        assert interpret(code, 0x40000000, architecture.audit, (0,) * 6) == seccomp.RET_KILL_PROCESS


@EVERY
def test_every_jump_stays_inside(machine: str) -> None:
    """The program fits the kernel's bounds and every path ends in a decision."""
    code = seccomp.program(ARCHITECTURES[machine])
    assert len(code) < 4096
    assert len(seccomp.encode(code)) == 8 * len(code)
    for place, (operation, if_true, if_false, _) in enumerate(code):
        if operation in {0x15, 0x35}:
            assert 0 <= if_true < 256
            assert 0 <= if_false < 256
            assert place + 1 + max(if_true, if_false) < len(code)
    assert code[-1][0] == 0x06


def by_libseccomp(machine: str, folder: Path) -> list[Instruction]:
    """Have libseccomp make a filter of the same policy, and read it back."""
    native = pyseccomp.Arch.X86_64 if machine == "x86_64" else pyseccomp.Arch.AARCH64
    theirs = pyseccomp.SyscallFilter(pyseccomp.ERRNO(1))
    theirs.remove_arch(pyseccomp.Arch.NATIVE)
    theirs.add_arch(native)
    theirs.set_attr(pyseccomp.Attr.ACT_BADARCH, pyseccomp.KILL_PROCESS)
    for name, rule in POLICY.items():
        choices: list[list[Any]] = [[]]
        for condition in rule:
            if isinstance(condition, Equal):
                options = [pyseccomp.Arg(condition.argument, pyseccomp.EQ, value) for value in condition.values]
            else:
                options = [pyseccomp.Arg(condition.argument, pyseccomp.MASKED_EQ, condition.mask, condition.value)]
            choices = [[*choice, option] for choice in choices for option in options]
        for choice in choices:
            theirs.add_rule(pyseccomp.ALLOW, name, *choice)
    with (folder / "filter.bpf").open("w+b") as file:
        theirs.export_bpf(file)
        file.seek(0)
        return list(struct.iter_unpack("=HBBI", file.read()))


@needs_libseccomp
@EVERY
def test_libseccomp_decides_alike(machine: str, tmp_path: Path) -> None:
    """For thousands of calls, of this architecture and others, both filters decide the same."""
    architecture = ARCHITECTURES[machine]
    ours, theirs = seccomp.program(architecture), by_libseccomp(machine, tmp_path)
    decide: Callable[[list[Instruction], int, int, tuple[int, ...]], int] = interpret
    compared = 0
    for number, arguments in calls(architecture):
        for audit in (architecture.audit, 0x40000003):
            mine, other = decide(ours, number, audit, arguments), decide(theirs, number, audit, arguments)
            assert mine == other, f"call {number:#x} of {audit:#x} with {arguments}: {mine:#x}, libseccomp {other:#x}"
            compared += 1
    assert compared > 5000


@needs_libseccomp
@EVERY
def test_libseccomp_knows_the_numbers(machine: str) -> None:
    """Both tables have the numbers that libseccomp has."""
    native = pyseccomp.Arch.X86_64 if machine == "x86_64" else pyseccomp.Arch.AARCH64
    theirs = {name: pyseccomp.resolve_syscall(native, name) for name in POLICY}
    assert theirs == ARCHITECTURES[machine].numbers

"""The system calls that a submission may make, and the BPF program that refuses all others.

The policy is an allow-list. What is not on it fails with EPERM, a call of another architecture
kills the process. Memory may be mapped, but only anonymously and never executable; reading is
allowed from descriptors 0 and 3, writing to 1, 2 and 3.
"""

from __future__ import annotations

import errno
import struct
from dataclasses import dataclass

PROT_EXEC = 4
MAP_ANONYMOUS = 0x20
X32_BIT = 0x40000000

RET_KILL_PROCESS = 0x80000000
RET_ALLOW = 0x7FFF0000
RET_USER_NOTIF = 0x7FC00000
RET_REFUSE = 0x00050000 | errno.EPERM  # SECCOMP_RET_ERRNO


@dataclass(frozen=True)
class Equal:
    """Allowed where the argument is one of these numbers."""

    argument: int
    values: tuple[int, ...]


@dataclass(frozen=True)
class Masked:
    """Allowed where the bits of `mask` in the argument are `value`."""

    argument: int
    mask: int
    value: int


Rule = tuple[Equal | Masked, ...]  # all must hold; an empty rule always does

# Why each is needed is said once here; SANDBOX tests run numpy under exactly this list.
POLICY: dict[str, Rule] = {
    # the channel (3), the output (1, 2), an empty standard input (0)
    "read": (Equal(0, (0, 3)),),
    "write": (Equal(0, (1, 2, 3)),),
    # memory: malloc of the C library, numpy's arrays and their huge pages
    "brk": (),
    "mmap": (Masked(2, PROT_EXEC, 0), Masked(3, MAP_ANONYMOUS, MAP_ANONYMOUS)),
    "munmap": (),
    "mremap": (),
    "madvise": (),
    "mprotect": (Masked(2, PROT_EXEC, 0),),
    # locks inside the interpreter and BLAS
    "futex": (),
    "sched_yield": (),
    "sched_getaffinity": (),
    # seeds of random generators
    "getrandom": (),
    # clocks and sleeping
    "clock_gettime": (),
    "clock_getres": (),
    "gettimeofday": (),
    "clock_nanosleep": (),
    "nanosleep": (),
    "restart_syscall": (),
    # harmless questions and the way out
    "getpid": (),
    "rt_sigreturn": (),
    "exit": (),
    "exit_group": (),
}


@dataclass(frozen=True)
class Architecture:
    """What differs between processors: the number that names it, and the numbers of the calls."""

    audit: int
    numbers: dict[str, int]
    x32: bool = False


X86_64 = Architecture(
    audit=0xC000003E,
    x32=True,
    numbers={
        "read": 0,
        "write": 1,
        "mmap": 9,
        "mprotect": 10,
        "munmap": 11,
        "brk": 12,
        "rt_sigreturn": 15,
        "sched_yield": 24,
        "mremap": 25,
        "madvise": 28,
        "nanosleep": 35,
        "getpid": 39,
        "exit": 60,
        "gettimeofday": 96,
        "futex": 202,
        "sched_getaffinity": 204,
        "restart_syscall": 219,
        "clock_gettime": 228,
        "clock_getres": 229,
        "clock_nanosleep": 230,
        "exit_group": 231,
        "getrandom": 318,
    },
)
AARCH64 = Architecture(
    audit=0xC00000B7,
    numbers={
        "read": 63,
        "write": 64,
        "exit": 93,
        "exit_group": 94,
        "futex": 98,
        "nanosleep": 101,
        "clock_gettime": 113,
        "clock_getres": 114,
        "clock_nanosleep": 115,
        "sched_getaffinity": 123,
        "sched_yield": 124,
        "restart_syscall": 128,
        "rt_sigreturn": 139,
        "gettimeofday": 169,
        "getpid": 172,
        "brk": 214,
        "munmap": 215,
        "mremap": 216,
        "mmap": 222,
        "mprotect": 226,
        "madvise": 233,
        "getrandom": 278,
    },
)
ARCHITECTURES = {"x86_64": X86_64, "aarch64": AARCH64}  # by the name that os.uname().machine gives

Instruction = tuple[int, int, int, int]  # code, jump if true, jump if false, operand
_LOAD, _AND, _JEQ, _JGE, _RET = 0x20, 0x54, 0x15, 0x35, 0x06
_LOW, _HIGH = 0, 4  # the halves of a little-endian argument


def program(architecture: Architecture, otherwise: int = RET_REFUSE) -> list[Instruction]:
    """Assemble the filter; `otherwise` is what happens to a call that the policy does not allow.

    Frequent calls come first. Each has a block of its own that ends in a decision, so that every
    jump stays within the 255 instructions that BPF can reach.
    """
    code: list[Instruction] = [
        (_LOAD, 0, 0, 4),
        (_JEQ, 1, 0, architecture.audit),
        (_RET, 0, 0, RET_KILL_PROCESS),
        (_LOAD, 0, 0, 0),
    ]
    if architecture.x32:  # the same architecture number with another calling convention
        code += [(_JGE, 0, 1, X32_BIT), (_RET, 0, 0, RET_KILL_PROCESS)]
    for name, rule in POLICY.items():
        block = _block(rule, otherwise)
        code += [(_JEQ, 0, len(block), architecture.numbers[name]), *block]
    return [*code, (_RET, 0, 0, otherwise)]


def _block(rule: Rule, otherwise: int) -> list[Instruction]:
    block: list[Instruction] = [(_RET, 0, 0, RET_ALLOW)]
    for condition in reversed(rule):
        test = _equal(condition) if isinstance(condition, Equal) else _masked(condition)
        block = [*test, (_RET, 0, 0, otherwise), *block]  # a test that holds jumps over the refusal
    return block


def _equal(condition: Equal) -> list[Instruction]:
    offset = 16 + 8 * condition.argument
    count = len(condition.values)
    # the upper half must be 0; then any of the values jumps over the refusal
    test: list[Instruction] = [(_LOAD, 0, 0, offset + _HIGH), (_JEQ, 0, count + 1, 0), (_LOAD, 0, 0, offset + _LOW)]
    return [*test, *((_JEQ, count - place, 0, value) for place, value in enumerate(condition.values))]


def _masked(condition: Masked) -> list[Instruction]:
    return [
        (_LOAD, 0, 0, 16 + 8 * condition.argument + _LOW),
        (_AND, 0, 0, condition.mask),
        (_JEQ, 1, 0, condition.value),
    ]


def encode(code: list[Instruction]) -> bytes:
    """Lay the instructions out as the kernel's array of struct sock_filter."""
    return b"".join(struct.pack("=HBBI", *instruction) for instruction in code)

"""Draws submissions whose functions return anything at all, and knows what each of them may have returned.

A function has one or two values, and a rule that chooses between them: always the first, by a counter, by the
number of poses, or by what differs from process to process. Shapes and words are stated here, by hand, so that
what a page claims can be held against them.
"""

from __future__ import annotations

import inspect
import math
import random
from collections.abc import Callable
from dataclasses import dataclass, field
from textwrap import indent

from reference_solution import slam1d

Shape = tuple[int, ...]
PARTS = {"normal_equations": ("H", "b"), "sparsity_pattern": ("J_mask", "H_mask")}
ARGUMENTS = {
    "residual": "x, graph",
    "jacobian": "x, graph",
    "information_matrix": "graph",
    "normal_equations": "J, omega, f",
    "gauss_newton_step": "x, graph",
    "sparsity_pattern": "graph",
    "range_residual": "x, ranging",
    "range_jacobian": "x, ranging",
}
ANSWERS = ("iterates", "conclusion", "written_2", "written_3")
REPORTED = (4, 5)  # the shape of the iterates of the worked example
SIZE = {
    "graph": "graph.n_poses",
    "x, graph": "graph.n_poses",
    "x, ranging": "len(x)",
    "J, omega, f": "J.shape[1]",
}


@dataclass(frozen=True)
class Value:
    """One value that a function may return, and what is true of it.

    `code` makes it from `right`, the right array of one part. Exactly one of the claims holds: `shape` of the
    wanted shape, with `odd` where it holds nan or inf; `words` that describe what is no array of numbers; `raised`,
    the type of an exception. `right` says whether it is right: yes, no, or None where that depends on the numbers.
    """

    code: str
    shape: Callable[[Shape], Shape] | None = None
    odd: str = ""
    words: str = ""
    raised: str = ""
    right: bool | None = False


def _fixed(*shape: int) -> Callable[[Shape], Shape]:
    return lambda _: shape


def _same(wanted: Shape) -> Shape:
    return wanted


def _numbers(code: str, shape: Callable[[Shape], Shape], *, right: bool | None = False, odd: str = "") -> Value:
    return Value(code, shape=shape, right=right, odd=odd)


RIGHT = _numbers("right", _same, right=True)
FORMS = [
    RIGHT,
    _numbers("right.reshape(-1, 1)", lambda wanted: (math.prod(wanted), 1), right=None),
    _numbers("right.reshape(1, -1)", lambda wanted: (1, math.prod(wanted)), right=None),
    _numbers("right.tolist()", _same, right=True),
    _numbers("tuple(right.tolist())", _same, right=True),
    _numbers("np.matrix(right)", lambda wanted: wanted if len(wanted) == 2 else (1, *wanted), right=True),
    _numbers("right.astype(np.longdouble)", _same, right=True),
    _numbers("right.astype('>f8')", _same, right=True),
    _numbers("right.astype(object)", _same, right=True),
    _numbers("np.asfortranarray(right)", _same, right=True),
    _numbers("right[::-1][::-1]", _same, right=True),
    _numbers("right.view(_Array)", _same, right=True),
    _numbers("_spoil(locals(), right)", _same, right=True),
    _numbers("right.astype(np.float16)", _same, right=None),
    _numbers("right.astype(np.uint8)", _same, right=None),
    _numbers("right.astype(np.float32)", _same, right=None),
    _numbers("np.round(right).astype(int)", _same, right=None),
    _numbers("right.astype(bool)", _same, right=None),
]
WRONG = [
    _numbers("-right", _same, right=None),
    _numbers("right + 1e-5", _same),
    _numbers("right + 0.5", _same),
    _numbers("right.T", lambda wanted: wanted[::-1], right=None),
    _numbers("np.zeros_like(right)", _same, right=None),
    _numbers("np.full(right.shape, 1e308)", _same),
    _numbers("np.full(right.shape, -1e200)", _same),
    _numbers("0.5", _fixed()),
    _numbers("7", _fixed()),
    _numbers("True", _fixed()),
    _numbers("np.float32(2)", _fixed()),
    _numbers("np.array(1.5)", _fixed()),
    _numbers("np.sum(right)", _fixed()),
    _numbers("right.ravel()[-1]", _fixed()),
    _numbers("__import__('fractions').Fraction(1, 3)", _fixed()),
    _numbers("__import__('decimal').Decimal('NaN')", _fixed()),
    _numbers("float('nan')", _fixed()),
    _numbers("10**30", _fixed()),
    _numbers("np.bool_(False)", _fixed()),
    _numbers("np.zeros((1, 1))", _fixed(1, 1), right=None),
    _numbers("np.array([2**63], dtype=np.uint64)", _fixed(1), right=None),
    _numbers("_nested(8)", _fixed(1, 1, 1, 1, 1, 1, 1, 1)),
    _numbers("[]", _fixed(0)),
    _numbers("()", _fixed(0)),
    _numbers("[[]]", _fixed(1, 0)),
    _numbers("np.zeros((0, 5))", _fixed(0, 5)),
    _numbers("np.zeros((0, 0))", _fixed(0, 0)),
    _numbers("np.zeros((2, 2, 2))", _fixed(2, 2, 2)),
    _numbers("np.zeros((1,) * 8)", _fixed(1, 1, 1, 1, 1, 1, 1, 1)),
    _numbers("np.zeros((1000, 1000))", _fixed(1000, 1000)),
    _numbers("np.zeros((0, 10**6))", _fixed(0, 10**6)),
    _numbers("right[:-1]", lambda wanted: (wanted[0] - 1, *wanted[1:])),
    _numbers("np.append(right, 0.0)", lambda wanted: (math.prod(wanted) + 1,)),
    _numbers("right[None]", lambda wanted: (1, *wanted), right=None),
    _numbers("[right, right]", lambda wanted: (2, *wanted)),
]
ODD = [
    _numbers("np.full(right.shape, np.nan)", _same, odd="nan"),
    _numbers("np.full(right.shape, np.inf)", _same, odd="inf"),
    _numbers("np.full(right.shape, -np.inf)", _same, odd="inf"),
    _numbers("np.full(right.shape, np.longdouble('1e400'))", _same, odd="inf"),
    _numbers("np.where(np.arange(right.size).reshape(right.shape) == 0, np.nan, right)", _same, odd="nan"),
    _numbers("np.where(np.arange(right.size).reshape(right.shape) == 1, np.inf, right)", _same, odd="inf"),
]
WORDS = [
    Value(code, words=words)
    for code, words in {
        "None": "None",
        "...": "an ellipsis",
        "'abc'": "a str",
        "b'abc'": "bytes",
        "1j": "a complex number",
        "right * 1j": "an array of complex128",
        "[[1, 2], [3]]": "a list of 2 that holds rows of unequal length",
        "(1, [2, 3])": "a tuple of 2 that holds rows of unequal length",
        "(each for each in right)": "a generator",
        "iter([1, 2])": "a list_iterator",
        "map(float, right.ravel())": "a map",
        "{}": "a dict",
        "{0: right}": "a dict",
        "{1, 2}": "a set",
        "range(3)": "a range",
        "object()": "an object",
        "print": "a builtin_function_or_method",
        "int": "a type",
        "np": "a module",
        "np.ma.array(right)": "a masked array",
        "np.zeros(3, dtype=[('a', float)])": "an array of records",
        "np.array(['2020-01-01'], dtype='datetime64[D]')": "an array of dates",
        "np.array([1], dtype='timedelta64[s]')": "an array of time differences",
        "np.datetime64('2020-01-01')": "a datetime64",
        "np.array(['a', 'b'])": "an array of str",
        "np.array([None, 1], dtype=object)": "an array of objects such as None",
        "np.array(None)": "an array of objects such as None",
        "[None]": "a list of 1 that holds objects such as None",
        "['a']": "a list of 1 that holds str",
        "[10**400]": "a list of 1 that holds integers too large for a float",
        "10**400": "an int integers too large for a float",
        "np.zeros((1,) * 9)": "an array of 9 dimensions",
        "_nested(9)": "an array of 9 dimensions",
        "_nested(200)": "a list of 1 that is nested too deeply",
        "_circle()": "a list of 1 that is nested too deeply",
        "_coroutine()": "a coroutine",
        "_generator()": "a generator",
        "memoryview(b'x')": "a memoryview",
        "np.ma.masked": "a masked array",
        "np.datetime64('NaT')": "a datetime64",
        "np.void(b'x')": "a void",
        "np.dtype(float)": "a Float64DType",
        "np.complex64(1)": "a complex64",
        "NotImplemented": "a NotImplementedType",
        "frozenset()": "a frozenset",
        "bytearray(3)": "a bytearray",
        "type('residual', (), {})()": "an object of your class residual",
        "globals()": "a dict",
        "__import__('collections').deque([1])": "a deque",
        "_Odd()": "an object of your class _Odd",
    }.items()
]
RAISES = [
    Value(f"_raise({error})", raised=name)
    for name, error in {
        "ValueError": "ValueError('no')",
        "ZeroDivisionError": "ZeroDivisionError('division by zero')",
        "KeyError": "KeyError(3)",
        "IndexError": "IndexError()",
        "AssertionError": "AssertionError()",
        "MemoryError": "MemoryError()",
        "SystemExit": "SystemExit(0)",
        "KeyboardInterrupt": "KeyboardInterrupt()",
        "GeneratorExit": "GeneratorExit()",
        "StopIteration": "StopIteration()",
        "NotImplementedError": "NotImplementedError()",
        "Silent": "Silent()",
        "OSError": "OSError('\\u202e<script>alert(1)</script>' * 300)",
        "TypeError": "TypeError('a\\nb\\x00c')",
        "LinAlgError": "np.linalg.LinAlgError('Singular matrix')",
        "UnicodeDecodeError": "UnicodeDecodeError('utf-8', b'x', 0, 1, 'no')",
        "ExceptionGroup": "ExceptionGroup('several', [ValueError(1)])",
    }.items()
] + [Value("_forever(0)", raised="RecursionError"), Value("_scipy()", raised="forbidden")]
PARTED = [  # instead of two values
    Value(code, words=f"{words}, expected 2 values")
    for code, words in {
        "None": "None",
        "0.5": "a float",
        "[]": "a list of 0",
        "()": "a tuple of 0",
        "right[:1]": "a tuple of 1",
        "(*right, 1)": "a tuple of 3",
        "right[0]": "an array of shape",
        "np.array(1.0)": "an array of shape ()",
        "{}": "a dict",
        "'ab'": "a str",
        "iter(right)": "a tuple_iterator",
    }.items()
]
KINDS = [FORMS, WRONG, ODD, WORDS, RAISES]
RULES = {
    "always": "0",
    "by a counter": "_count('{name}') % {period}",
    "the first time": "_count('{name}') > {period}",
    "by size": "{size} % {period}",
    "by process": "(id(object()) >> 8) % {period}",
    "where nothing is left": "_small(right)",
    "by another process": "__import__('os').getpid() % {period}",
    "by time": "__import__('time').perf_counter_ns() % {period}",
}
PRELUDE = """
import numpy as np

_right = {{}}
exec({reference!r}, _right)
_counts = {{}}


class _Odd:
    def __array__(self, *_, **__):
        raise RuntimeError("no")

    __len__ = __iter__ = __float__ = __getitem__ = __array__


class Silent(Exception):
    def __str__(self):
        raise ValueError("not even this")


class _Array(np.ndarray):
    pass


def _raise(error):
    raise error


def _nested(depth):
    value = 1.0
    for _ in range(depth):
        value = [value]
    return value


def _circle():
    value = []
    value.append(value)
    return value


async def _coroutine():
    return 1


def _generator():
    yield 1


def _spoil(names, right):
    for value in list(names.values()):
        if isinstance(value, np.ndarray) and value is not right and value.flags.writeable and value.dtype == float:
            value.fill(7)
    return right


def _forever(depth):
    return _forever(depth + 1)


def _scipy():
    import scipy

    return scipy.sparse


def _small(right):
    first = right[0] if isinstance(right, tuple) else right
    return float(np.max(np.abs(np.asarray(first, float)), initial=0.0)) < 1e-6


def _count(name):
    _counts[name] = _counts.get(name, -1) + 1
    return _counts[name]
"""
COMPOSED = """
def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)
"""


@dataclass(frozen=True)
class Behaviour:
    """What one function does: which values, of which part (-1: all together), chosen by which rule."""

    function: str
    values: tuple[Value, ...]
    part: int
    rule: str
    period: int

    def may(self, size: int | None) -> tuple[Value, ...]:
        """Return the values that it may have returned on a case with so many poses; None where that is not known."""
        if self.rule == "always":
            return self.values[:1]
        if self.rule == "by size" and size is not None:
            return (self.values[bool(size % self.period)],)
        return self.values

    def code(self) -> str:
        """Write the function."""
        arguments = ARGUMENTS[self.function]
        lines = [f"right = _right[{self.function!r}]({arguments})"]
        if self.part >= 0:
            lines += ["parts = list(right)", f"right = np.asarray(parts[{self.part}], float)"]
        rule = RULES[self.rule].format(name=self.function, size=SIZE[arguments], period=self.period)
        first, second = (each.code for each in (self.values * 2)[:2])
        lines += [f"value = ({second}) if {rule} else ({first})"]
        if self.part >= 0:
            lines += [f"parts[{self.part}] = value", "value = tuple(parts)"]
        return f"def {self.function}({arguments}):\n{indent(chr(10).join([*lines, 'return value']), '    ')}\n"


@dataclass(frozen=True)
class Drawn:
    """One submission."""

    text: str
    behaviours: dict[str, Behaviour] = field(default_factory=dict)
    answers: dict[str, Value] = field(default_factory=dict)
    composed: bool = False


def drawn(seed: str) -> Drawn:
    """Draw one submission."""
    draw = random.Random(seed)
    names = [name for name in ARGUMENTS if draw.random() < 0.7]
    behaviours = {name: _behaviour(draw, name) for name in names}
    composed = draw.random() < 0.3
    if composed:
        behaviours.pop("gauss_newton_step", None)
    blocks = [each.code() for each in behaviours.values()] + [COMPOSED] * composed
    draw.shuffle(blocks)
    answers = {name: draw.choice(draw.choice(KINDS[:4])) for name in ANSWERS if draw.random() < 0.3}
    reported = [f"right = np.ones({REPORTED})\n{name} = {value.code}\n" for name, value in answers.items()]
    prelude = PRELUDE.format(reference=inspect.getsource(slam1d))
    return Drawn("\n\n".join([prelude, *blocks, *reported]), behaviours, answers, composed)


def _behaviour(draw: random.Random, name: str) -> Behaviour:
    part = draw.choice((0, 1, -1)) if name in PARTS else -1
    whole = name in PARTS and part < 0

    def one() -> Value:
        if whole:
            return draw.choice([*PARTED, RIGHT, RAISES[draw.randrange(len(RAISES))]])
        return RIGHT if draw.random() < 0.25 else draw.choice(draw.choice(KINDS))

    rule = draw.choice(list(RULES))
    return Behaviour(name, (one(),) if rule == "always" else (one(), one()), part, rule, draw.choice((2, 3, 7)))

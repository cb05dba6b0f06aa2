"""Whatever a function returns becomes plain numbers with a shape, or words that say what came."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from autograder.sandbox.frames import Kind, Outcome
from autograder.sandbox.host import Outputs

Value = Callable[..., Outputs]

GOOD: dict[str, tuple[str, Kind, list[float], tuple[int, ...]]] = {
    "a float array": ("np.array([1.0, 2.0])", Kind.FLOAT_ARRAY, [1, 2], (2,)),
    "an array in Fortran order": ("np.array([[1.0, 2.0], [3.0, 4.0]]).T", Kind.FLOAT_ARRAY, [1, 3, 2, 4], (2, 2)),
    "a strided view": ("np.arange(6.0)[::2]", Kind.FLOAT_ARRAY, [0, 2, 4], (3,)),
    "an array of the other byte order": ("np.array([1.0, 2.0], '>f8')", Kind.FLOAT_ARRAY, [1, 2], (2,)),
    "an array without elements": ("np.zeros((0, 3))", Kind.FLOAT_ARRAY, [], (0, 3)),
    "an array of no dimension": ("np.array(3.0)", Kind.FLOAT_ARRAY, [3], ()),
    "the input itself": ("x", Kind.FLOAT_ARRAY, [0, 1, 2], (3,)),
    "an integer array": ("np.array([1, 2])", Kind.INTEGER_ARRAY, [1, 2], (2,)),
    "an unsigned array": ("np.array([255], np.uint8)", Kind.INTEGER_ARRAY, [255], (1,)),
    "a bool array": ("np.array([True, False])", Kind.BOOL_ARRAY, [1, 0], (2,)),
    "a float32 array": ("np.array([0.5], np.float32)", Kind.FLOAT32_ARRAY, [0.5], (1,)),
    "a float16 array": ("np.array([0.5], np.float16)", Kind.FLOAT32_ARRAY, [0.5], (1,)),
    "a longdouble array": ("np.array([0.5], np.longdouble)", Kind.OTHER, [0.5], (1,)),
    "a list": ("[1, 2.5]", Kind.LIST, [1, 2.5], (2,)),
    "a list of lists": ("[[1], [2]]", Kind.LIST, [1, 2], (2, 1)),
    "a tuple": ("(1.0, 2.0)", Kind.LIST, [1, 2], (2,)),
    "a list of arrays": ("[x[:1], x[1:2]]", Kind.LIST, [0, 1], (2, 1)),
    "a matrix": ("np.matrix([[1.0], [2.0]])", Kind.MATRIX, [1, 2], (2, 1)),
    "a float": ("1.5", Kind.SCALAR, [1.5], ()),
    "an int": ("7", Kind.SCALAR, [7], ()),
    "a numpy scalar": ("np.float32(0.5)", Kind.SCALAR, [0.5], ()),
    "fractions": ("[Fraction(1, 2), Fraction(1, 4)]", Kind.LIST, [0.5, 0.25], (2,)),
    "an array of fractions": ("np.array([Fraction(1, 2), 3])", Kind.OTHER, [0.5, 3], (2,)),
    "a long integer": ("[10**30]", Kind.LIST, [1e30], (1,)),
    "infinite numbers": ("[np.inf, -np.inf]", Kind.LIST, [np.inf, -np.inf], (2,)),
    "a subclass that lies": ("np.arange(2.0).view(Liar)", Kind.OTHER, [0, 1], (2,)),
    "a record array's numbers": ("np.arange(2.0).view(np.recarray)", Kind.OTHER, [0, 1], (2,)),
    "a float that lies": ("[Float(2.0)]", Kind.LIST, [2], (1,)),
}
BEFORE = """
from fractions import Fraction
class Liar(np.ndarray):
    def __eq__(self, other): return True
    def tobytes(self): return b""
    def __array_ufunc__(self, *a, **k): return self
    shape = (7, 7)
    dtype = "nonsense"
class Float(float):
    def __eq__(self, other): return True
    def __sub__(self, other): return 0.0
class Equal:
    def __eq__(self, other): return True
    __class__ = np.ndarray
class Array:
    def __array__(self, *a, **k): return np.ones(3)
"""
BAD = {
    "None": ("None", "None"),
    "a str": ("'1.0'", "a str"),
    "bytes": ("b'x'", "bytes"),
    "a complex number": ("1j", "a complex number"),
    "a generator": ("(k for k in x)", "a generator"),
    "a dict": ("{}", "a dict"),
    "a set": ("{1.0}", "a set"),
    "a function": ("f", "a function"),
    "complex numbers": ("x + 0j", "an array of complex128"),
    "strings": ("np.array(['1'])", "an array of str"),
    "dates": ("np.array(['2020-01-01'], 'M8[D]')", "an array of dates"),
    "records": ("np.zeros(1, [('a', float)])", "an array of records"),
    "objects": ("np.array([None])", "an array of objects such as None"),
    "objects that lie": ("np.array([Equal()])", "an array of objects such as an object of your class Equal"),
    "a list of strings": ("['1']", "a list of 1 that holds str"),
    "a list with None": ("[1.0, None]", "a list of 2 that holds objects such as None"),
    "rows of unequal length": ("[[1.0], [1.0, 2.0]]", "a list of 2 that holds rows of unequal length"),
    "a masked array": ("np.ma.masked_array([1.0], [True])", "a masked array"),
    "an object that lies about its class": ("Equal()", "an object of your class Equal"),
    "an array-like": ("Array()", "an object of your class Array"),
    "too many elements": ("np.zeros((1000, 1000))", "shape (1000, 1000)"),
    "a view of a million million elements": ("np.broadcast_to(1.0, (10**6, 10**6))", "shape (1000000, 1000000)"),
    "a long side of nothing": ("np.zeros((0, 10**9))", "shape (0, 1000000000)"),
    "too many dimensions": ("np.zeros((1,) * 9)", "an array of 9 dimensions"),
    "an integer too large": ("[10**400]", "a list of 1 that holds integers too large for a float"),
    "a list in itself": ("Loop", "a list of 1 that is nested too deeply"),
}


@pytest.mark.parametrize("case", GOOD.values(), ids=GOOD.keys())
def test_real_numbers_are_taken(value: Value, case: tuple[str, Kind, list[float], tuple[int, ...]]) -> None:
    """Every array, list or scalar of real numbers arrives as float64, with a note of what it was."""
    expression, kind, numbers, shape = case
    outputs = value(expression, BEFORE)
    assert outputs.outcome.tolist() == [Outcome.OK], outputs.reasons
    assert outputs.shapes == [shape]
    assert outputs.data.tolist() == numbers
    assert outputs.kinds.tolist() == [kind]
    assert outputs.offsets.tolist() == [0, len(numbers)]


@pytest.mark.parametrize(("expression", "words"), BAD.values(), ids=BAD.keys())
def test_anything_else_is_named(value: Value, expression: str, words: str) -> None:
    """What is no array of real numbers is refused with words that say what came."""
    outputs = value(expression, BEFORE + "Loop = [None]\nLoop[0] = Loop\n")
    assert outputs.outcome.tolist() == [Outcome.BAD_VALUE], outputs.reasons
    assert outputs.shapes == [()]
    assert outputs.data.size == 0
    assert outputs.reasons == {0: words}


def test_two_values_are_two_values(run: Callable[..., Outputs]) -> None:
    """A function of two values returns them as a tuple or a list; each has a shape and a kind of its own."""
    outputs = run("import numpy as np\ndef f(x, graph):\n    return np.eye(2), [1, 2]\n", parts=2, cases=2)
    assert outputs.shapes == [(2, 2), (2,)] * 2
    assert outputs.kinds.tolist() == [Kind.FLOAT_ARRAY, Kind.LIST] * 2
    assert outputs.data.tolist() == [1, 0, 0, 1, 1, 2] * 2
    assert outputs.offsets.tolist() == [0, 4, 6, 10, 12]


@pytest.mark.parametrize(
    ("expression", "words"),
    [
        ("(x, None)", "value 2 of 2: None"),
        ("(x, x, x)", "a tuple of 3, expected 2 values"),
        ("np.ones((2, 3))", "an array of shape (2, 3), expected 2 values"),
        ("None", "None, expected 2 values"),
    ],
)
def test_two_values_that_are_not(run: Callable[..., Outputs], expression: str, words: str) -> None:
    """Where two values were expected, the words say what came instead, and nothing is kept of the other."""
    outputs = run(f"import numpy as np\ndef f(x, graph):\n    return {expression}\n", parts=2)
    assert outputs.outcome.tolist() == [Outcome.BAD_VALUE]
    assert outputs.reasons == {0: words}
    assert outputs.shapes == [(), ()]
    assert outputs.data.size == 0

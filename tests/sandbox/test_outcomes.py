"""Each call of a batch ends in an outcome of its own; what went wrong in one costs no other."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from autograder.sandbox.frames import Array, Outcome, Source
from autograder.sandbox.host import Failure, Outputs, Sandbox
from autograder.sandbox.outputs import MOST_SHOWN
from tests.sandbox.conftest import X, batch

Value = Callable[..., Outputs]
Run = Callable[..., Outputs | Failure]

RAISING = {
    "an error": ("raise ValueError('bad luck')", Outcome.RAISED, "ValueError: bad luck"),
    "an error without words": ("raise ValueError", Outcome.RAISED, "ValueError"),
    "an index": ("return x[9]", Outcome.RAISED, "IndexError: index 9 is out of bounds for axis 0 with size 3"),
    "unfinished": ("raise NotImplementedError('your turn')", Outcome.UNFINISHED, "NotImplementedError: your turn"),
    "a wrong call": ("return f(x)", Outcome.RAISED, "TypeError: f() missing 1 required positional argument: 'graph'"),
    "leaving": ("import sys; sys.exit(0)", Outcome.RAISED, "SystemExit: 0"),
    "an interrupt": ("raise KeyboardInterrupt", Outcome.RAISED, "KeyboardInterrupt"),
    "a generator's exit": ("raise GeneratorExit", Outcome.RAISED, "GeneratorExit"),
    "endless recursion": ("return f(x, graph)", Outcome.RAISED, "RecursionError: maximum recursion depth exceeded"),
    "words on lines": ("raise ValueError('a\\x1b[31m\\n\\tb\\u202e')", Outcome.RAISED, "ValueError: a [31m b"),
    "endless words": ("raise ValueError('x' * 10**7)", Outcome.RAISED, "ValueError: " + "x" * 288),
    "no words": ("raise Mute", Outcome.RAISED, "Mute"),
    "too much memory": ("return [0.0] * 10**9", Outcome.MEMORY, "MemoryError"),
    "too large an array": ("import numpy; return numpy.ones(10**10)", Outcome.MEMORY, "MemoryError"),
}
BEFORE = """
class Mute(Exception):
    def __str__(self): raise self
"""


@pytest.mark.parametrize(("body", "outcome", "reason"), RAISING.values(), ids=RAISING.keys())
def test_what_a_call_raises_is_said(run: Run, body: str, outcome: Outcome, reason: str) -> None:
    """An exception of any kind is an outcome with bounded words on one line."""
    outputs = run(f"{BEFORE}\ndef f(x, graph):\n    {body}\n", cases=2)
    assert isinstance(outputs, Outputs), outputs
    assert outputs.outcome.tolist() == [outcome] * 2
    assert outputs.reasons[0].startswith(reason[:280])
    assert len(outputs.reasons[0]) <= 300 + len(", in line 6: ``") + MOST_SHOWN


def test_one_bad_call_costs_no_other(run: Run) -> None:
    """Calls before and after one that fails keep their values and places."""
    text = """
calls = 0
def f(x, graph):
    global calls
    calls += 1
    if calls == 2:
        raise ValueError("second")
    if calls == 3:
        return None
    return x * calls
"""
    outputs = run(text, cases=5)
    assert isinstance(outputs, Outputs)
    assert outputs.outcome.tolist() == [Outcome.OK, Outcome.RAISED, Outcome.BAD_VALUE, Outcome.OK, Outcome.OK]
    assert outputs.shapes == [(3,), (), (), (3,), (3,)]
    assert outputs.data.tolist() == [0, 1, 2, 0, 4, 8, 0, 5, 10]
    assert outputs.reasons == {1: 'ValueError: second, in line 7: `raise ValueError("second")`', 2: "None"}


def test_reasons_are_few(run: Run) -> None:
    """Every case comes with its words; of different ones a batch has 64."""
    calls = "calls = 0\n\ndef f(x, graph):\n    global calls\n    calls += 1\n    raise ValueError(calls % {})\n"
    outputs = run(calls.format(2), cases=100)
    assert isinstance(outputs, Outputs)
    shown = ", in line 6: `raise ValueError(calls % {})`"
    assert outputs.reasons == {case: f"ValueError: {1 - case % 2}" + shown.format(2) for case in range(100)}
    outputs = run(calls.format(1000), cases=100)
    assert isinstance(outputs, Outputs)
    assert outputs.reasons == {case: f"ValueError: {case + 1}" + shown.format(1000) for case in range(64)}


def test_a_function_that_is_not_there_is_unfinished(run: Run) -> None:
    """A function that is not defined, or is no function, leaves every case unfinished."""
    for text in ("", "f = 3\n"):
        outputs = run(text, cases=3, parts=2)
        assert isinstance(outputs, Outputs)
        assert outputs.outcome.tolist() == [Outcome.UNFINISHED] * 3
        assert outputs.reasons == dict.fromkeys(range(3), "not defined")
        assert outputs.shapes == [()] * 6


def test_every_call_has_arrays_of_its_own(run: Run) -> None:
    """A call may write into its arrays: the next finds them as they were, and the first change is reported."""
    outputs = run("def f(x, graph):\n    x += 1\n    return x\n", cases=3)
    assert isinstance(outputs, Outputs)
    assert outputs.data.tolist() == [1, 2, 3] * 3
    assert outputs.mutated == 0


@pytest.mark.parametrize("name", ["J", "omega", "f"])
def test_a_change_in_any_argument_is_seen(run: Run, name: str) -> None:
    """Also of three arrays, the first change is reported; it is found although the call raised."""
    text = f"""
count = 0
def f(J, omega, f):
    global count
    count += 1
    if count == 2:
        {name}[0] = 9
        raise ValueError
    return J
"""
    outputs = run(text, cases=3, arguments=[X, X, X])
    assert isinstance(outputs, Outputs)
    assert outputs.mutated == 1


def test_graphs_cannot_be_changed(run: Run) -> None:
    """The arrays of a graph are read-only for good."""
    outputs = run("def f(x, graph):\n    graph.measurements.flags.writeable = True\n")
    assert isinstance(outputs, Outputs)
    assert outputs.reasons[0].startswith("ValueError")


def test_arguments_come_in_any_order(run: Run) -> None:
    """Graphs and rangings by number, arrays by value, wherever they stand."""
    text = "def f(ranging, x, graph):\n    return x + ranging.beacon[1] + graph.n_poses\n"
    outputs = run(text, arguments=[1, X, 0])
    assert isinstance(outputs, Outputs)
    assert outputs.data.tolist() == [4, 5, 6]
    assert outputs.mutated == -1


def test_arrays_keep_their_shape(run: Run) -> None:
    """An array of two dimensions arrives as one, writeable and its own."""
    text = "def f(x):\n    assert x.flags.writeable and x.flags.owndata\n    return x.T\n"
    grid = Array((2, 3), np.arange(6.0).tobytes())
    outputs = run(text, arguments=[grid])
    assert isinstance(outputs, Outputs)
    assert outputs.shapes == [(3, 2)]
    assert outputs.data.tolist() == [0, 3, 1, 4, 2, 5]


def test_prepared_batches_run_like_inline_ones(sandbox: Sandbox) -> None:
    """A batch of the inputs and the same batch sent along give the same."""
    with sandbox.open(Source("module", ["def f(x, graph):\n    return x + graph.n_poses\n"], "student")) as session:
        prepared, inline = session.run(0), session.call(batch(cases=2))
    assert isinstance(prepared, Outputs)
    assert isinstance(inline, Outputs)
    assert prepared.data.tolist() == inline.data.tolist() == [3, 4, 5] * 2


def test_a_fresh_child_has_seen_no_call(sandbox: Sandbox) -> None:
    """State that calls leave behind is gone after `fresh`."""
    text = "calls = []\ndef f(x, graph):\n    calls.append(1)\n    return [len(calls)]\n"
    with sandbox.open(Source("module", [text], "student")) as session:
        first, second = session.call(batch()), session.call(batch())
        session.fresh()
        third = session.call(batch())
    assert [outputs.data.tolist() for outputs in (first, second, third) if isinstance(outputs, Outputs)] == [
        [1],
        [2],
        [1],
    ]


def test_random_numbers_repeat(sandbox: Sandbox) -> None:
    """Unseeded random numbers are the same in every child, and sets have one order."""
    text = """
import random
import numpy as np
def f(x, graph):
    return [random.random(), np.random.rand(), float(''.join({'1', '2', '3'}))]
"""
    seen = set()
    for _ in range(2):
        with sandbox.open(Source("module", [text], "student")) as session:
            outputs = session.call(batch())
            assert isinstance(outputs, Outputs)
            seen.add(tuple(outputs.data.tolist()))
    assert len(seen) == 1

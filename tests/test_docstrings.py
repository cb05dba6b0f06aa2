"""Docstrings are kept: their examples run, and the shapes that they promise are those that come back."""

from __future__ import annotations

import ast
import doctest
import importlib
import inspect
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from assignment import posegraph
from assignment.posegraph import PoseGraph, Ranging
from reference_solution import slam1d as reference
from tests.numpydoc import Entry, entries, sections

ROOT = Path(__file__).resolve().parent.parent
UNFINISHED = {"assignment.slam1d"}  # the stub has the reference's examples, and nothing behind them yet


def _shows_an_example(source: str) -> bool:
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    nodes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, documented)]
    return any(re.search(r"^ *>>> ", ast.get_docstring(node) or "", flags=re.MULTILINE) for node in nodes)


def _modules_with_examples() -> list[str]:
    names = []
    for package in ("assignment", "autograder", "reference_solution"):
        for path in sorted((ROOT / package).rglob("*.py")):
            parts = path.relative_to(ROOT).with_suffix("").parts
            if "specimens" not in parts and _shows_an_example(path.read_text(encoding="utf-8")):
                names.append(".".join(parts[:-1] if parts[-1] == "__init__" else parts))
    return [name for name in names if name not in UNFINISHED]


def _public_functions(module: ModuleType) -> list[Callable[..., Any]]:
    found = [value for name, value in vars(module).items() if inspect.isfunction(value) and not name.startswith("_")]
    return [function for function in found if function.__module__ == module.__name__]


def _public_methods(*classes: type) -> list[Callable[..., Any]]:
    return [
        value
        for cls in classes
        for name, value in vars(cls).items()
        if inspect.isfunction(value) and not name.startswith("_")
    ]


STAGES = _public_functions(reference)
TAUGHT = [*STAGES, *_public_methods(PoseGraph, Ranging)]
NAMED = [function.__qualname__ for function in TAUGHT]


@pytest.fixture
def _flat(monkeypatch: pytest.MonkeyPatch) -> None:
    """`posegraph` is importable as it is in a student's folder, and is one and the same module."""
    monkeypatch.setitem(sys.modules, "posegraph", posegraph)


@pytest.mark.usefixtures("_flat")
@pytest.mark.parametrize("name", _modules_with_examples())
def test_every_example_in_a_docstring_runs(name: str) -> None:
    """What an example prints is what the docstring shows."""
    report: list[str] = []
    runner = doctest.DocTestRunner(verbose=False)
    for example in doctest.DocTestFinder().find(importlib.import_module(name), name):
        runner.run(example, out=report.append)
    assert not runner.summarize(verbose=False).failed, "\n".join(report)
    assert runner.tries, f"{name} shows >>> where doctest finds no example"


@pytest.mark.parametrize("function", TAUGHT, ids=NAMED)
def test_a_taught_function_documents_every_argument_and_result(function: Callable[..., Any]) -> None:
    """Parameters are those of the signature, each with words; a result and an example are shown."""
    signature = inspect.signature(function)
    names = [name for name in signature.parameters if name != "self"]
    parameters, returns = entries(function, "Parameters"), entries(function, "Returns")
    assert [entry.name for entry in parameters] == names
    assert returns
    assert all(entry.type and entry.text for entry in [*parameters, *returns])
    assert "Examples" in sections(function)


@pytest.mark.parametrize("function", TAUGHT, ids=NAMED)
def test_a_taught_function_gives_the_unit_of_every_array(function: Callable[..., Any]) -> None:
    """Every float array has a unit in brackets, [m] or [no unit]."""
    for entry in [*entries(function, "Parameters"), *entries(function, "Returns")]:
        assert "float array" not in entry.type or re.search(r"\[[^\]]+\]", entry.text), entry


@pytest.mark.parametrize("function", TAUGHT, ids=NAMED)
def test_a_summary_is_one_sentence_that_says_what_to_do(function: Callable[..., Any]) -> None:
    """A summary is one line that begins with a verb in the imperative and ends in a full stop."""
    summary = sections(function)[""].splitlines()[0]
    first = summary.split()[0]
    assert summary.endswith(".")
    assert first[0].isupper()
    assert not first.lower().endswith(("s", "ing", "ed")), f"`{first}` is no imperative"


@st.composite
def graphs(draw: st.DrawFn) -> PoseGraph:
    """Draw a chain with loop closures between any two of its poses and one prior or two."""
    n = draw(st.integers(2, 7))
    pairs = st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)).filter(lambda pair: pair[0] != pair[1])
    edges = [(i, i + 1) for i in range(n - 1)] + draw(st.lists(pairs, max_size=4))
    priors = draw(st.lists(st.integers(0, n - 1), min_size=1, max_size=2))
    k, p = len(edges), len(priors)
    reals, positive = st.floats(-5, 5), st.floats(0.01, 4)
    return PoseGraph(
        n,
        np.array(draw(st.permutations(edges))),
        draw(hnp.arrays(float, k, elements=reals)),
        draw(hnp.arrays(float, k, elements=positive)),
        np.array(priors),
        draw(hnp.arrays(float, p, elements=reals)),
        draw(hnp.arrays(float, p, elements=positive)),
    )


@st.composite
def rangings(draw: st.DrawFn, n_poses: int) -> Ranging:
    """Draw measured distances to a beacon from any of the poses."""
    q = draw(st.integers(1, 4))
    return Ranging(
        np.array([draw(st.floats(-5, 5)), draw(st.floats(0.5, 5))]),
        draw(hnp.arrays(int, q, elements=st.integers(0, n_poses - 1))),
        draw(hnp.arrays(float, q, elements=st.floats(0, 9))),
        draw(hnp.arrays(float, q, elements=st.floats(0.01, 4))),
    )


def broken_promises(function: Callable[..., Any], returned: Any, sizes: dict[str, int]) -> Iterator[str]:
    """Say where a result is not what the Returns section promises; the letters stand for `sizes`."""
    promised: list[Entry] = entries(function, "Returns")
    parts = returned if len(promised) > 1 else (returned,)
    if len(parts) != len(promised):
        yield f"{len(promised)} results are promised, {len(parts)} came"
    for entry, part in zip(promised, parts, strict=False):
        shape = tuple(sizes[letter] for letter in entry.shape or ())
        if entry.shape is None:
            yield f"no shape is promised in `{entry.type}`"
        elif np.shape(part) != shape:
            yield f"shape {entry.shape} = {shape} is promised, {np.shape(part)} came"
        elif entry.type.split()[-2] != {"f": "float", "b": "bool", "i": "int"}.get(np.asarray(part).dtype.kind):
            yield f"`{entry.type}` is promised, {np.asarray(part).dtype} came"


@pytest.mark.parametrize("function", TAUGHT, ids=NAMED)
@given(data=st.data(), graph=graphs())
def test_a_promised_shape_is_kept(function: Callable[..., Any], data: st.DataObject, graph: PoseGraph) -> None:
    """On every graph the results have the shapes and types that the docstring promises."""
    ranging = data.draw(rangings(graph.n_poses))
    sizes = {
        "n": graph.n_poses,
        "m": graph.n_factors,
        "k": len(graph.edges),
        "p": len(graph.priors),
        "q": len(ranging.poses),
    }
    given_objects = {"PoseGraph": graph, "Ranging": ranging}
    arguments = [] if function in STAGES else [graph]
    for entry in entries(function, "Parameters"):
        if entry.type in given_objects:
            arguments.append(given_objects[entry.type])
        else:
            assert entry.shape is not None, f"no shape is promised in `{entry.name} : {entry.type}`"
            shape = tuple(sizes[letter] for letter in entry.shape)
            arguments.append(data.draw(hnp.arrays(float, shape, elements=st.floats(-9, 9))))
    assert not list(broken_promises(function, function(*arguments), sizes))


def test_a_broken_promise_is_seen() -> None:
    """A wrong shape, a wrong type and a missing result are told apart."""

    def promise() -> None:
        """Promise two results.

        Returns
        -------
        H : (n, n) float array
            First [m].
        b : (n,) float array
            Second [m].
        """

    sizes = {"n": 2}
    assert not list(broken_promises(promise, (np.eye(2), np.zeros(2)), sizes))
    assert list(broken_promises(promise, (np.eye(3), np.zeros(2)), sizes)) == [
        "shape ('n', 'n') = (2, 2) is promised, (3, 3) came"
    ]
    assert list(broken_promises(promise, (np.eye(2), np.zeros(2, int)), sizes)) == [
        "`(n,) float array` is promised, int64 came"
    ]
    assert list(broken_promises(promise, (np.eye(2),), sizes)) == ["2 results are promised, 1 came"]

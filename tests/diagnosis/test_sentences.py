"""Every sentence about a wrong function is true: each has a checker of its own, which calls the function again.

A known mistake is treated here as one that nobody knows. What facts and probes say of it has to match one of the
patterns below, and the pattern's check has to agree; a new sentence without a check fails.
"""

from __future__ import annotations

import dataclasses
import re
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from autograder.diagnosis.facts import Answered, facts
from autograder.diagnosis.probes import derivative_probe, probes, remembers
from autograder.diagnosis.recognise import trusted_call
from autograder.engine.corpus import draw_corpus
from autograder.stages.base import Slip, Stage
from autograder.stages.catalogue import slips, stage
from reference_solution import slam1d

NAMES = ("residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step")
ALL = [(name, slip) for name in NAMES for slip in slips(name)]
Function = Callable[..., Any]
Calls = list[tuple[Any, ...]]


def calls_of(found: Stage, seed: int) -> list[tuple[Any, tuple[Any, ...]]]:
    """Return cases with their call, a few of every rung."""
    rungs = draw_corpus((found,), seed, 3).cases[found.ladder.name]
    return [(case, found.calls(case)[0]) for cases in rungs.values() for case in cases]


def ask(function: Function, call: tuple[Any, ...]) -> tuple[np.ndarray, ...] | None:
    """Call a function as the sandbox does, on copies."""
    return trusted_call(function, call, 2 if len(call) == 3 else 1)


def said(name: str, slip: Slip, seed: int) -> list[str]:
    """Return all that facts and probes say of a mistake."""
    found, answers, usable = stage(name), [], True
    for case, call in calls_of(found, seed):
        got = ask(slip.function, call)
        wanted = found.expected(*call)
        fits = got is not None and [each.shape for each in got] == [each.shape for each in wanted]
        usable &= fits and all(np.isfinite(each).all() for each in got or ())
        close = fits and all(np.allclose(a, b, rtol=1e-7, atol=1e-9) for a, b in zip(got or (), wanted, strict=True))
        answers.append(Answered(case, close, got if fits else None))
    words = facts(found, answers)
    if not usable:
        return words

    def values(function: Function, calls: Any) -> list[Any]:
        answered = [ask(function, call) for call in calls]
        return [part for each in answered for part in (each or (None,) * found.parts)]

    memory = remembers(name)
    words.append(memory.read(*(values(slip.function, calls) for calls in memory.rounds)))
    words += [probe.read(values(slip.function, probe.rounds[0])) for probe in probes(name)]
    if name == "jacobian":
        of_J, of_f, read = derivative_probe(slam1d.jacobian, residual_is_wrong=False)
        words.append(read(values(slip.function, of_J.rounds[0]), values(slam1d.residual, of_f.rounds[0])))
    return [each for each in words if each]


def wrong_rows(name: str, function: Function, seed: int) -> list[tuple[Any, np.ndarray]]:
    """Return for every graph which rows are off, by the reference's own numbers."""
    found = []
    for case, call in calls_of(stage(name), seed):
        got, right = ask(function, call), np.asarray(getattr(slam1d, name)(*call))
        assert got is not None
        off = ~np.isclose(got[0], right, rtol=1e-6, atol=1e-9)
        found.append((case[1], off if off.ndim == 1 else off.any(axis=1)))
    return found


KINDS: dict[str, Callable[[Any, int], bool]] = {
    "the second prior": lambda graph, row: row > len(graph.edges),
    "the priors": lambda graph, row: row >= len(graph.edges),
    "backward edges (j < i)": lambda graph, row: row < len(graph.edges) and graph.edges[row, 1] < graph.edges[row, 0],
    "loop closures": lambda graph, row: row < len(graph.edges) and abs(np.diff(graph.edges[row])[0]) > 1,
    "doubled edges": lambda graph, row: (
        row < len(graph.edges) and sum(set(pair) == set(graph.edges[row].tolist()) for pair in graph.edges.tolist()) > 1
    ),
    "the edges": lambda graph, row: row < len(graph.edges),
}


def only_these_rows(found: re.Match[str], name: str, function: Function, seed: int) -> bool:
    """Whether the rows of a kind are wrong, all of them where it says so, and no others."""
    rows = [
        (KINDS[found[2]](graph, row), bool(off))
        for graph, marks in wrong_rows(name, function, seed)
        for row, off in enumerate(marks)
    ]
    inside = all(kind for kind, off in rows if off) and any(off for _, off in rows)
    return inside and (found[1] == "Only" or all(off for kind, off in rows if kind))


def turned(graph: Any) -> Any:
    """List the edges from the last to the first."""
    fields = ("edges", "measurements", "edge_variances")
    return dataclasses.replace(graph, **{field: getattr(graph, field)[::-1] for field in fields})


def order_matters(_: re.Match[str], name: str, function: Function, seed: int) -> bool:
    """Whether some graph gives other numbers when its edges are turned round, however its rows are ordered."""
    for case, call in calls_of(stage(name), seed):
        one, other = ask(function, call), ask(function, (*call[:-1], turned(case[1])))
        if one is not None and other is not None:
            a, b = (
                each[0] if name == "gauss_newton_step" else np.array(sorted(each[0].tolist())) for each in (one, other)
            )
            if name == "information_matrix":
                a, b = np.sort(a.ravel()), np.sort(b.ravel())
            if a.shape != b.shape or not np.allclose(a, b, atol=1e-7):
                return True
    return False


def moved(name: str, function: Function, seed: int) -> list[tuple[Any, Any]]:
    """Return answers for a state and for another one."""
    return [
        (ask(function, (x, graph)), ask(function, (x * 3 - 7, graph))) for _, (x, graph) in calls_of(stage(name), seed)
    ]


def ignores_x(_: re.Match[str], name: str, function: Function, seed: int) -> bool:
    """Whether other states get the same answers."""
    pairs = [
        (ask(function, call), ask(function, (call[0] * 3 - 7, call[1]))) for _, call in calls_of(stage(name), seed)
    ]
    return all(a is not None and b is not None and np.allclose(a[0], b[0], atol=1e-9) for a, b in pairs)


def changes_with_x(_: re.Match[str], name: str, function: Function, seed: int) -> bool:
    """Whether another state gets another J."""
    pairs = [
        (ask(function, call), ask(function, (call[0] * 3 - 7, call[1]))) for _, call in calls_of(stage(name), seed)
    ]
    return any(a is not None and b is not None and not np.allclose(a[0], b[0], atol=1e-7) for a, b in pairs)


def no_derivative(_: re.Match[str], name: str, function: Function, seed: int) -> bool:
    """Whether J is not the derivative of the right f, by the reference's J."""
    return any(off.any() for _, off in wrong_rows(name, function, seed))


def skew(_: re.Match[str], name: str, function: Function, seed: int) -> bool:
    """Whether some H is not symmetric."""
    answers = [ask(function, call) for _, call in calls_of(stage(name), seed)]
    return any(each is not None and not np.allclose(each[0], each[0].T) for each in answers)


def one_part(found: re.Match[str], name: str, function: Function, seed: int) -> bool:
    """Whether the part that is called right is so in every call, and the other one is not."""
    right, wrong = (0, 1) if found[1] == "H" else (1, 0)
    gaps = np.zeros(2)
    for _, (J, omega, f) in calls_of(stage(name), seed):
        got = ask(function, (J, omega, f))
        assert got is not None
        for part, exact in enumerate((J.T @ omega @ J, J.T @ omega @ f)):
            gaps[part] = max(gaps[part], np.abs(got[part] - exact).max() / (1.0 + np.abs(exact).max()))
    return bool(gaps[right] < 1e-6 and gaps[wrong] > 1e-12)


def alike(_: re.Match[str], name: str, function: Function, seed: int) -> bool:
    """Whether right and wrong graphs differ as it says: at least one of each."""
    rights = []
    for _, call in calls_of(stage(name), seed):
        got, wanted = ask(function, call), stage(name).expected(*call)[0]
        rights.append(got is not None and got[0].shape == wanted.shape and np.allclose(got[0], wanted))
    return any(rights) and not all(rights)


CHECKS: dict[str, Callable[[re.Match[str], str, Function, int], bool]] = {
    r"(Only|All) rows of (.*?) are wrong(?:, and no others)?\.": only_these_rows,
    r"It depends on the order in which the edges are listed[:,].*": order_matters,
    r"It ignores x: another state gets the same answer\.": ignores_x,
    r"J changes with x, but every row of f is linear in x: .*": changes_with_x,
    r"J is not the derivative of your own residual: .*": no_derivative,
    r"H is not symmetric, and J\^T Omega J always is\.": skew,
    r"(H|b) is right on every case; only [Hb] is wrong.*": one_part,
    r"It is right for .* only\.": alike,
}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("name", NAMES)
def test_every_sentence_about_a_known_mistake_is_true(name: str, seed: int) -> None:
    """Treated as unknown, each slip gets sentences that a second look confirms."""
    false = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for slip in slips(name):
            for sentence in said(name, slip, seed):
                check = next(((m, c) for p, c in CHECKS.items() if (m := re.fullmatch(p, sentence))), None)
                if check is None or not check[1](check[0], name, slip.function, seed):
                    false.append((slip.identifier, sentence))
    assert false == []

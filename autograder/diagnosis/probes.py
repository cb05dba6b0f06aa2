"""A few more calls tell: whether it looks at x, whether it remembers, whether the order of edges matters.

A probe names calls of the submission's own functions and reads what comes back. It runs for a
mistake that no catalogue knows, once a group.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems import core
from autograder.problems.cases import Case
from autograder.stages.base import Array

CLOSE = 1e-6
Values = Sequence[Array | None]

# Small graphs with everything in them: loops, backward and doubled edges, other priors.
_CASES: tuple[Case, ...] = (*core.SEVERAL_LOOPS[:3], *core.PRIORS[3:5])


@dataclass(frozen=True)
class Probe:
    """Calls of one function, and what to say if their answers show something; "" if not."""

    function: str
    calls: tuple[Case, ...]
    read: Callable[[Values], str]


def probes(function: str) -> list[Probe]:
    """Return the probes that suit a function of (x, graph) or (graph)."""
    takes_state = function in {"residual", "jacobian", "gauss_newton_step"}
    if not takes_state and function != "information_matrix":
        return []
    found = [_repeated(function), _reversed(function)]
    if function in {"residual", "gauss_newton_step"}:
        found.append(_ignores_state(function))
    if function == "jacobian":
        found.append(_constant(function))
    return found


def _calls(function: str, cases: Sequence[Case]) -> tuple[Case, ...]:
    return tuple((graph,) if function == "information_matrix" else (x, graph) for x, graph in cases)


def _same(one: Array | None, other: Array | None) -> bool:
    if one is None or other is None:
        return one is other
    return one.shape == other.shape and bool((np.abs(one - other) <= CLOSE * (1.0 + np.abs(other))).all())


def _repeated(function: str) -> Probe:
    def read(values: Values) -> str:
        half = len(values) // 2
        changed = any(not _same(one, other) for one, other in zip(values[:half], values[half:], strict=True))
        return (
            "It answers the same question differently the second time: something is kept between calls."
            if changed
            else ""
        )

    return Probe(function, _calls(function, _CASES) * 2, read)


def _reversed(function: str) -> Probe:
    turned = [(x, _with_edges_reversed(graph)) for x, graph in _CASES]

    def read(values: Values) -> str:
        half = len(values) // 2
        for (_, graph), one, other in zip(_CASES, values[:half], values[half:], strict=True):
            if one is None or other is None or one.shape != other.shape:
                return ""
            order = np.r_[np.arange(len(graph.edges))[::-1], np.arange(len(graph.edges), graph.n_factors)]
            if function == "gauss_newton_step":
                wanted = one
            elif one.shape[:1] != (graph.n_factors,):
                return ""
            else:
                wanted = one[np.ix_(order, order)] if function == "information_matrix" and one.ndim == 2 else one[order]
            if not _same(other, wanted):
                return "It depends on the order in which the edges are listed; a row should follow its edge."
        return ""

    return Probe(function, _calls(function, _CASES) + _calls(function, turned), read)


def _with_edges_reversed(graph: PoseGraph) -> PoseGraph:
    return dataclasses.replace(
        graph,
        edges=graph.edges[::-1],
        measurements=graph.measurements[::-1],
        edge_variances=graph.edge_variances[::-1],
    )


def _ignores_state(function: str) -> Probe:
    moved = [(x + 1.0 + np.arange(len(x)), graph) for x, graph in _CASES]

    def read(values: Values) -> str:
        half = len(values) // 2
        if any(value is None for value in values):
            return ""
        ignored = all(_same(one, other) for one, other in zip(values[:half], values[half:], strict=True))
        return "It ignores x: another state gets the same answer." if ignored else ""

    return Probe(function, _calls(function, _CASES) + _calls(function, moved), read)


def _constant(function: str) -> Probe:
    moved = [(x + 1.0 + np.arange(len(x)), graph) for x, graph in _CASES]

    def read(values: Values) -> str:
        half = len(values) // 2
        if any(value is None for value in values):
            return ""
        same = all(_same(one, other) for one, other in zip(values[:half], values[half:], strict=True))
        return (
            ""
            if same
            else "J changes with x, but every row of f is linear in x: its derivative is the same everywhere."
        )

    return Probe(function, _calls(function, _CASES) + _calls(function, moved), read)


def derivative_probe() -> tuple[Probe, Probe, Callable[[Values, Values], str]]:
    """Return the calls of jacobian and of residual that tell whether J is the derivative of the student's own f.

    f is linear in x, so a difference with a step of 1 is the derivative, up to rounding.
    """
    shifted = [(x + unit, graph) for x, graph in _CASES for unit in (np.zeros(len(x)), *np.eye(len(x)))]

    def read(jacobians: Values, residuals: Values) -> str:
        start = 0
        for (x, graph), J in zip(_CASES, jacobians, strict=True):
            f = residuals[start : start + len(x) + 1]
            start += len(x) + 1
            rows = [each for each in f if each is not None and each.size == graph.n_factors]
            if J is None or len(rows) != len(x) + 1:
                return ""
            own = np.array([row.ravel() - rows[0].ravel() for row in rows[1:]]).T
            if not _same(J, own):
                return "J is not the derivative of your own residual: move one pose by 1 m and see how f changes."
        return "J is the derivative of your own residual, so look for the mistake in residual."

    nothing = lambda _: ""  # noqa: E731 - the two are read together
    return Probe("jacobian", _CASES, nothing), Probe("residual", tuple(shifted), nothing), read

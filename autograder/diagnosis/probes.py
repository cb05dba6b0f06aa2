"""A few more calls tell: whether it looks at x, whether it remembers, whether the order of edges matters.

A probe names calls of the submission's own functions and reads what comes back. It runs for a
mistake that no catalogue knows. What it says holds of what it saw: wherever a number is missing or not finite,
it says nothing.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.diagnosis.equivalence import rows_alike
from autograder.problems import core
from autograder.problems.cases import Case
from autograder.stages.base import Array
from autograder.stages.same import different, finite, same
from autograder.stages.wording import vector

SEEN, ROUNDING = 1e-6, 1e-12  # of the largest number: what is surely another one, and what is surely the same
Values = Sequence[Array | None]

# Small graphs with everything in them: loops, backward and doubled edges, other priors.
CASES: tuple[Case, ...] = (*core.SEVERAL_LOOPS[:3], *core.PRIORS[3:5])
_SYSTEMS: tuple[Case, ...] = (*core.DENSE[:3], *core.GRAPH_SHAPED[:2])


@dataclass(frozen=True)
class Probe:
    """Calls of one function, and what to say if their answers show something; "" if not.

    Each round of calls is made in a child of its own, which has answered nothing before.
    """

    function: str
    rounds: tuple[tuple[Case, ...], ...]
    read: Callable[..., str]


def remembers(function: str) -> Probe:
    """Ask the same questions in another order."""
    calls = _SYSTEMS if function == "normal_equations" else _calls(function, CASES)
    order = [3, 0, 4, 2, 1]

    def read(first: Values, second: Values) -> str:
        parts = len(first) // len(calls)
        pairs = [
            (first[number * parts + part], second[place * parts + part])
            for place, number in enumerate(order)
            for part in range(parts)
        ]
        if not any(_differ(one, other) for one, other in pairs):
            return ""
        return (
            "It answers the same question differently when the questions come in another order: "
            "something is kept between calls, or drawn at random."
        )

    return Probe(function, (calls, tuple(calls[number] for number in order)), read)


def probes(function: str) -> list[Probe]:
    """Return the probes that suit a function of (x, graph) or (graph) which remembers nothing."""
    found = {
        "residual": [_reversed(function), _ignores_state(function)],
        "jacobian": [_reversed(function), _constant(function)],
        "information_matrix": [_reversed(function)],
        "gauss_newton_step": [_reversed(function), _ignores_state(function)],
    }
    return found.get(function, [])


def _calls(function: str, cases: Sequence[Case]) -> tuple[Case, ...]:
    return tuple((graph,) if function == "information_matrix" else (x, graph) for x, graph in cases)


def _size(*arrays: Array | None) -> float:
    """Return the largest number of some arrays, and 1 at least."""
    return max([1.0, *(float(np.abs(each).max(initial=0.0)) for each in arrays if each is not None)])


def _differ(one: Array | None, other: Array | None) -> bool:
    return finite(one, other) and different(one, other, SEEN * _size(one, other))


def _agree(one: Array | None, other: Array | None) -> bool:
    return finite(one, other) and same(one, other, ROUNDING * _size(one, other))


def _reversed(function: str) -> Probe:
    turned = [(x, _with_edges_reversed(graph)) for x, graph in CASES]

    def read(values: Values) -> str:
        half = len(values) // 2
        for (_, graph), one, other in zip(CASES, values[:half], values[half:], strict=True):
            if one is None or other is None or one.shape != other.shape or not finite(one, other):
                return ""
            if not _follows(function, graph, one, other):
                return _order_matters(function, graph, one, other)
        return ""

    return Probe(function, (_calls(function, CASES) + _calls(function, turned),), read)


def _follows(function: str, graph: PoseGraph, one: Array, other: Array) -> bool:
    """Whether answers to two orders of the edges hold the same, each row beside its own edge or elsewhere."""
    within = SEEN * _size(one, other)
    if function == "gauss_newton_step" or len(np.atleast_1d(one)) != graph.n_factors:
        return not _differ(one, other)
    if function == "information_matrix":  # rows and columns change places together
        one, other = np.sort(one), np.sort(other)
    return rows_alike(one, other, within) or (one.ndim == 2 and rows_alike(one.T, other.T, within))


def _order_matters(function: str, graph: PoseGraph, one: Array, other: Array) -> str:
    """Say so, with the answers that show it."""
    edges = ", ".join(f"{i} -> {j}" for i, j in graph.edges.tolist())
    what = "a step does not depend on it" if function == "gauss_newton_step" else "a row should follow its edge"
    shown = [vector(np.diag(each) if function == "information_matrix" else each) for each in (one, other)]
    if function == "jacobian" or shown[0] == shown[1]:
        return f"It depends on the order in which the edges are listed, of a graph with the edges {edges} say; {what}."
    return (
        f"It depends on the order in which the edges are listed: with the edges {edges} it gives {shown[0]}, "
        f"and with the same edges from the last to the first {shown[1]}; {what}."
    )


def _with_edges_reversed(graph: PoseGraph) -> PoseGraph:
    return dataclasses.replace(
        graph,
        edges=graph.edges[::-1],
        measurements=graph.measurements[::-1],
        edge_variances=graph.edge_variances[::-1],
    )


def _moved(function: str) -> tuple[Case, ...]:
    return _calls(function, CASES) + _calls(function, [(x + 1.0 + np.arange(len(x)), graph) for x, graph in CASES])


def _ignores_state(function: str) -> Probe:
    def read(values: Values) -> str:
        half = len(values) // 2
        ignored = all(_agree(one, other) for one, other in zip(values[:half], values[half:], strict=True))
        return "It ignores x: another state gets the same answer." if ignored else ""

    return Probe(function, (_moved(function),), read)


def _constant(function: str) -> Probe:
    def read(values: Values) -> str:
        half = len(values) // 2
        if not any(_differ(one, other) for one, other in zip(values[:half], values[half:], strict=True)):
            return ""
        return "J changes with x, but every row of f is linear in x: its derivative is the same everywhere."

    return Probe(function, (_moved(function),), read)


_FAR, _NEAR = 1.0, 1e-3  # [m] steps of the central differences: they agree where f is linear along every pose


def derivative_probe(
    right: Callable[..., Array], *, residual_is_wrong: bool
) -> tuple[Probe, Probe, Callable[[Values, Values], str]]:
    """Return the calls of jacobian and of residual that tell whether J is the derivative of the student's own f.

    The student's f need not be linear in x: where a difference over 1 m and one over 1 mm do not agree, as with
    rounded numbers or absolute values, nothing is said.

    Parameters
    ----------
    right : callable
        The reference's J: that J is wrong must show on the cases of the probe.
    residual_is_wrong : bool
        Whether residual lost points: only then is it a place where to look.
    """
    shifted = [
        (x + side * step * unit, graph)
        for x, graph in CASES
        for unit in np.eye(len(x))
        for step in (_FAR, _NEAR)
        for side in (1.0, -1.0)
    ]

    def read(jacobians: Values, residuals: Values) -> str:
        place, equal, wrong = 0, True, False
        for (x, graph), J in zip(CASES, jacobians, strict=True):
            f = residuals[place : place + 4 * len(x)]
            place += 4 * len(x)
            if not finite(J, *f) or any(each is None or each.size != graph.n_factors for each in f):
                return ""
            rows = np.array([np.ravel(each) for each in f if each is not None]).reshape(len(x), 2, 2, -1)
            far, near = ((rows[:, s, 0] - rows[:, s, 1]).T / (2 * h) for s, h in enumerate((_FAR, _NEAR)))
            if not same(far, near, 10 * SEEN * _size(far)):
                return ""
            equal &= same(J, far, 10 * SEEN * _size(far))
            wrong |= different(J, right(x, graph), 10 * SEEN)
            if different(J, far, 100 * SEEN * _size(far)):
                return "J is not the derivative of your own residual: move one pose by 1 m and see how f changes."
        if equal and wrong and residual_is_wrong:
            return "J is the derivative of your own residual, so look for the mistake in residual."
        return ""

    nothing = lambda *_: ""  # noqa: E731 - the two are read together
    return Probe("jacobian", (CASES,), nothing), Probe("residual", (tuple(shifted),), nothing), read

"""What each sentence of a message claims, checked by calling the function again and by the exact witness.

`CLAIMS` holds a pattern for every sentence that may stand in a message, and the check of what it says.
"""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph
from reference_solution import slam1d
from tests.diagnosis.shown import (
    b_shown,
    column_shown,
    depends_on_start,
    disagrees,
    does_not_move,
    dx_shown,
    entry_shown,
    mask_shown,
    not_finite,
    not_zero_again,
    object_shown,
    raised_shown,
    row_shown,
    shape_shown,
)
from tests.diagnosis.told import Told, got
from tests.witness import exact_normal_equations, exact_problem, exact_step

EARLIER = ("residual", "jacobian", "information_matrix", "normal_equations")
NUMBER = r"-?[0-9][0-9.e+-]*"
VALUE = rf"(?:{NUMBER}|\[[^\]]*\])"
BESIDE = rf"got ({VALUE}), expected ({VALUE})(?:, which is ({NUMBER}) away)?"
ROW = r"row (\d+) \([a-z]+ [\d >-]*(?:on pose \d+)?\)"


def cases(told: Told) -> list[tuple[np.ndarray, PoseGraph]]:
    """Return states and graphs with loops, backward edges and several priors, used nowhere else."""
    rng = np.random.default_rng(11)
    found = []
    for n in (2, 3, 5, 6):
        pairs = [*[(i + 1, i) if i % 2 else (i, i + 1) for i in range(n - 1)], (0, n - 1)]
        graph = PoseGraph(
            n,
            pairs,
            rng.normal(size=n),
            rng.uniform(0.1, 2.0, n),
            [n - 1, 0],
            rng.normal(size=2),
            rng.uniform(0.1, 2.0, 2),
        )
        found.append((rng.normal(size=n) * 3, graph))
    return found


def alone_right(told: Told) -> bool:
    """Whether the step is right where the functions that it calls are the reference's."""
    space = dict(told.defined)
    try:
        exec(compile(told.text, "by itself", "exec"), space)  # a specimen, or a known mistake: our own text
        space.update({name: getattr(slam1d, name) for name in EARLIER})
        return all(
            np.allclose(
                np.ravel(space["gauss_newton_step"](x, graph)), np.array(exact_step(x, graph), float), atol=1e-6
            )
            for x, graph in cases(told)
        )
    except Exception:  # noqa: BLE001 - whatever a submission raises
        return False


def mend_first(m: re.Match[str], told: Told) -> bool:
    """What is to be mended is wrong."""
    return all(told.verdicts[name].status != "passed" for name in re.split(r", | and ", m[1]))


def white(_: re.Match[str], told: Told) -> bool:
    """H and b are right, and Omega is the identity."""
    for x, graph in cases(told):
        f, J, omega = (np.asarray(told.ask(*call, function=name), float) for name, call in _three(x, graph))
        H, b = (np.array(each, float) for each in exact_normal_equations(*exact_problem(x, graph)))
        if not (np.allclose(J.T @ J, H) and np.allclose(J.T @ f, b) and np.array_equal(omega, np.eye(len(f)))):
            return False
    return True


def _three(x: Any, graph: Any) -> tuple[tuple[str, tuple[Any, ...]], ...]:
    return ("residual", (x, graph)), ("jacobian", (x, graph)), ("information_matrix", (graph,))


def priors_first(_: re.Match[str], told: Told) -> bool:
    """Other edges leave the first rows as they are, as many as there are priors."""
    for x, graph in cases(told):
        changed = dataclasses.replace(
            graph,
            measurements=graph.measurements + 1.0,
            edge_variances=graph.edge_variances * 2,
            edges=graph.edges[:, ::-1],
        )
        name = told.verdict.name
        one, other = (
            np.asarray(told.ask(*((each,) if name == "information_matrix" else (x, each)), function=name), float)
            for each in (graph, changed)
        )
        p = len(graph.priors)
        if not np.allclose(one[:p], other[:p]) or np.allclose(one[p:], other[p:]):
            return False
    return True


def parameters(m: re.Match[str], told: Told) -> bool:
    """The function takes these arguments."""
    return ", ".join(inspect.signature(told.defined[m[1]]).parameters) == m[2]


def redefined(m: re.Match[str], told: Told) -> bool:
    """Both lines define the function, the later one with these parameters."""
    lines = told.text.splitlines()
    return lines[int(m[1]) - 1].startswith(f"def {m[2]}({m[3]})") and lines[int(m[4]) - 1].startswith(f"def {m[2]}(")


def remembers(_: re.Match[str], told: Told) -> bool:
    """A call answers differently after the same question about another state than in a fresh place."""
    name = told.verdict.name
    for x, graph in cases(told):
        parts = slam1d.jacobian(x, graph), slam1d.information_matrix(graph), slam1d.residual(x, graph)
        pairs = {"normal_equations": (parts, (*parts[:2], parts[2] + 1)), "information_matrix": ((graph,), (graph,))}
        call, before = pairs.get(name, ((x, graph), (x + 1.0, graph)))
        places: list[dict[str, Any]] = [{"__name__": "slam1d"}, {"__name__": "slam1d"}]
        for place in places:
            exec(compile(told.text, "afresh", "exec"), place)
        places[1][name](*before)
        one, other = (np.ravel(place[name](*call)) for place in places)
        if not np.allclose(one, other):
            return True
    return False


def own_derivative(_: re.Match[str], told: Told) -> bool:
    """J is the derivative of the submission's own f, which is wrong."""
    for x, graph in cases(told):
        J = np.asarray(told.ask(x, graph, function="jacobian"), float)
        steps = [
            np.subtract(*(told.ask(x + s * e, graph, function="residual") for s in (0.5, -0.5))) for e in np.eye(len(x))
        ]
        if not np.allclose(J, np.array(steps, float).T, atol=1e-5):
            return False
    return told.verdicts["residual"].status != "passed"


AGAIN = "it was asked again, on other graphs and with right functions in the place of yours"
CLAIMS: dict[str, Callable[[re.Match[str], Told], bool]] = {
    r"Mend ([a-z_, ]+) first, which the step builds on\.": mend_first,
    rf"The step is wrong by itself, too: {AGAIN}\.": lambda _, told: not alone_right(told),
    rf"The step keeps its points: {AGAIN}\.": lambda _, told: (
        alone_right(told) and told.verdict.score == told.verdict.max_score
    ),
    r"Right by itself; with your own functions:": lambda _, told: alone_right(told),
    r"The rows of the priors come first, and not only that\.": priors_first,
    r"Your f and J are whitened and your Omega is the identity: together they give the right H, b and step\.": white,
    r"(\w+ of )?(\w+) returned shape (\([\d, ]*\)), expected (\([\d, ]*\))\.": shape_shown,
    (
        r"(\w+ of )?\w+ returned (an object of your class \w+); expected an array of real numbers, shape "
        r"\(.*?\)\."
    ): object_shown,
    r"(\w+)(\([a-zA-Z, ]+\)) raised ((?:(?! raised ).)*?), in line (\d+): `([^`]*)`\.(?= |$)": raised_shown,
    r"(\w+)(\([a-zA-Z, ]+\)) raised ([^`]*?)()()\.(?= |$)": raised_shown,
    r"(\w+) is not defined in the submission\.": lambda m, told: m[1] not in told.defined,
    r"(\w+) uses the module ([\w.]+), which is not allowed here; numpy is\.": lambda m, told: (
        f"import {m[2]}" in told.text or f"from {m[2]}" in told.text
    ),
    rf"{ROW} of ([fJ]): {BESIDE}(?: \[m\])?\.": row_shown,
    rf"column (\d+) of J \(pose \1\): {BESIDE}\.": column_shown,
    r"((?:\w+ of )?\w+(?:\([^)]*\)+)?(?:, graph\))?) returned (nan|inf), expected finite numbers\.": not_finite,
    (
        rf"row \d+ \([^)]*\) has variance {NUMBER} m\^2: Omega\[(?P<i>\d+), (?P<j>\d+)\] got "
        rf"(?P<got>{NUMBER}), expected (?P<wanted>{NUMBER})(?:, which is (?P<gap>{NUMBER}) away)? "
        rf"\[1/m\^2\]\."
    ): entry_shown,
    (
        rf"Omega\[(?P<i>\d+), (?P<j>\d+)\] got (?P<got>{NUMBER}), expected (?P<wanted>0)(?P<gap>z)?: the "
        rf"measurements are independent\."
    ): entry_shown,
    (
        rf"H\[(?P<i>\d+), (?P<j>\d+)\]: got (?P<got>{NUMBER}), expected (?P<wanted>{NUMBER})(?:, which is "
        rf"(?P<gap>{NUMBER}) away)?\."
    ): entry_shown,
    r"H must be symmetric, and yours is not\.": lambda _, told: (
        not np.allclose(got(told)[0], got(told)[0].T, rtol=1e-9)
    ),
    rf"b: {BESIDE}; H is right\.": b_shown,
    rf"dx: {BESIDE} \[m\]; it leaves H dx \+ b = ({NUMBER}) in row (\d+), where it should be 0\.": dx_shown,
    rf"after one step from ({VALUE}) to ({VALUE}), the second step is ({VALUE}), not 0\.": not_zero_again,
    (
        rf"x \+ dx\(x\) depends on the start: ({VALUE}) from ({VALUE}), ({VALUE}) from ({VALUE}); one "
        rf"minimum was expected\."
    ): depends_on_start,
    (
        rf"the point x \+ dx\(x\) = ({VALUE}) does not move when the measurement of edge (\d+) -> (\d+), "
        rf"which lies on a loop, changes from ({NUMBER}) to ({NUMBER}) m\."
    ): does_not_move,
    (
        rf"where all measurements and priors agree with one state, ({VALUE}), the point x \+ dx\(x\) is "
        rf"({VALUE}): it must be that state, whatever the weights\."
    ): disagrees,
    (
        r"([JH])_mask\[(\d+), (\d+)\] \([^)]*\)+: this entry (can differ from 0 and is not marked|is "
        r"always 0 and is marked)\."
    ): mask_shown,
    r"It is called as \w+\([\w, ]+\), and your (\w+) takes \(([\w, ]*)\)\.": parameters,
    (
        r"line (\d+) defines (\w+) again, with the parameters \(([\w, ]*)\), in the place of that of "
        r"line (\d+)\."
    ): redefined,
    (
        r"It answers the same question differently when the questions come in another order: something "
        r"is kept between calls, or drawn at random\."
    ): remembers,
    r"J is the derivative of your own residual, so look for the mistake in residual\.": own_derivative,
}

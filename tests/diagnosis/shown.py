"""Numbers that a message shows: each came, and each was expected, as the call and the exact witness say again."""

from __future__ import annotations

import dataclasses
import re

import numpy as np

from tests.diagnosis.told import Told, both, got, reads, right
from tests.witness import exact_normal_equations, exact_problem


def row_shown(m: re.Match[str], told: Told) -> bool:
    """A row of f or J came and was expected as it says."""
    row = int(m[1])
    return not told.example or both(got(told)[0][row], right(told)[0][row], (m[3], m[4], m[5]))


def column_shown(m: re.Match[str], told: Told) -> bool:
    """A column of J came and was expected as it says."""
    c = int(m[1])
    return not told.example or both(got(told)[0][:, c], right(told)[0][:, c], (m[2], m[3], m[4]))


def not_finite(m: re.Match[str], told: Told) -> bool:
    """A number that is not finite came, as it is called."""
    if not told.example:
        return True
    value = told.ask(*told.call())
    parts = value if isinstance(value, tuple) else (value,)
    kind = np.isnan if m[2] == "nan" else np.isinf
    return any(kind(np.asarray(part, dtype=float)).any() for part in parts)


def entry_shown(m: re.Match[str], told: Told) -> bool:
    """An entry of Omega or H came and was expected as it says."""
    if not told.example:
        return True
    place = (int(m["i"]), int(m["j"]))
    return both(got(told)[0][place], right(told)[0][place], (m["got"], m["wanted"], m["gap"]))


def b_shown(m: re.Match[str], told: Told) -> bool:
    """The vector b is as it says, and H is right."""
    if not told.example:
        return True
    (H, b), (right_H, right_b) = got(told), right(told)
    return both(b, right_b, (m[1], m[2], m[3])) and np.allclose(
        H, right_H, rtol=0, atol=2e-9 * (1 + np.abs(right_H).max())
    )


def dx_shown(m: re.Match[str], told: Told) -> bool:
    """The step is as it says, and leaves of the equations what it says."""
    if not told.example:
        return True
    x, graph = told.call()
    H, b = (np.array(each, dtype=float) for each in exact_normal_equations(*exact_problem(x, graph)))
    mine = told.step(x, graph)
    if "something is kept between calls" in told.verdict.message:  # it cannot be asked the same again
        mine = np.array(m[1].strip("[]").split(), float)
    left = float(H[int(m[5])] @ mine + b[int(m[5])])
    return both(mine, right(told)[0], (m[1], m[2], m[3])) and abs(left - float(m[4])) <= 1e-4 * abs(left)


def shape_shown(m: re.Match[str], told: Told) -> bool:
    """An array of that shape came, and another one is right."""
    value = told.ask(*told.call())
    part = {"b": 1, "H_mask": 1}.get((m[1] or "").removesuffix(" of "), 0)
    mine = np.shape(value[part] if m[1] and isinstance(value, tuple) else value)
    return str(mine) == m[3] and str(right(told)[part].shape) == m[4] and m[3] != m[4]


def object_shown(m: re.Match[str], told: Told) -> bool:
    """An object of that class came, which is no number."""
    name = type(told.ask(*told.call())).__name__
    return name in m[2] and not isinstance(told.ask(*told.call()), int | float | np.ndarray | list)


def raised_shown(m: re.Match[str], told: Told) -> bool:
    """The same call raises that exception, and the line is the submission's own."""
    if not told.example:
        return True
    try:
        told.ask(*told.call())
    except Exception as error:  # noqa: BLE001 - whatever a submission raises
        line = m[4] and told.text.splitlines()[int(m[4]) - 1].strip()
        return m[3].startswith(type(error).__name__) and (not m[4] or line.startswith(m[5].removesuffix("...").strip()))
    return False


def mask_shown(m: re.Match[str], told: Told) -> bool:
    """That entry of a mask came as it says, and the other way round it is right."""
    if not told.example:
        return True
    part = "JH".index(m[1])
    place = (int(m[2]), int(m[3]))
    marked = m[4] == "is always 0 and is marked"
    return bool(got(told)[part][place]) == marked and bool(right(told)[part][place]) != marked


def not_zero_again(m: re.Match[str], told: Told) -> bool:
    """From there the step leads there, and the next one is not 0."""
    if not told.example:
        return True
    x, graph = told.call()
    told.step(*told.call())
    point = x + told.step(x, graph)
    second = told.step(point, graph)
    return (
        reads(m[1], x, 1e-9)
        and reads(m[2], point, 1e-6)
        and np.abs(second).max() > 0
        and bool(re.search("[1-9]", m[3]))
    )


def depends_on_start(m: re.Match[str], told: Told) -> bool:
    """Two states lead to two points, which do not print alike."""
    if not told.example:
        return True
    _, graph = told.call()
    if "..." in m[0]:
        return m[1] != m[3]
    one, two = (np.array(m[place].strip("[]").split(), float) for place in (2, 4))
    first, second = one + told.step(one, graph), two + told.step(two, graph)
    coarse = 2e-4 if re.search(r"\d\.\d{4}", m[2] + m[4]) else 1e-6  # a start of six digits is not quite the start
    return m[1] != m[3] and reads(m[1], first, coarse) and reads(m[3], second, coarse) and bool((first != second).any())


def does_not_move(m: re.Match[str], told: Told) -> bool:
    """That measurement, changed so, leaves the point where it is, up to rounding."""
    if not told.example:
        return True
    x, graph = told.call()
    for e, pair in enumerate(graph.edges.tolist()):
        if pair == [int(m[2]), int(m[3])] and reads(m[4], graph.measurements[e], 1e-9):
            changed = graph.measurements.copy()
            changed[e] += round(float(m[5]) - float(m[4]))
            other = dataclasses.replace(graph, measurements=changed)
            gap = np.abs(told.step(x, graph) - told.step(x, other)).max()
            if gap <= 1e-9 * (1 + np.abs(x).max()) and reads(m[1], x + told.step(x, graph), 1e-9):
                return True  # of two edges between the same poses it may be the other one
    return False


def disagrees(m: re.Match[str], told: Told) -> bool:
    """Where everything agrees with that state, the point is another one."""
    if not told.example:
        return True
    x, graph = told.call()
    if "..." in m[1]:
        return m[1] != m[2]
    state = np.array(m[1].strip("[]").split(), float)
    i, j = graph.edges.T
    agreed = dataclasses.replace(graph, measurements=state[j] - state[i], prior_means=state[graph.priors])
    point = x + told.step(x, agreed)
    return m[1] != m[2] and reads(m[2], point, 1e-6) and not np.allclose(point, state)

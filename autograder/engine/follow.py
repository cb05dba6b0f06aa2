"""Follow-through: a step that is wrong only because an earlier function is wrong solves the student's own equations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from autograder.engine.normal import arrays_of
from autograder.problems.cases import Case
from autograder.sandbox.host import Outputs
from autograder.stages.base import Array
from autograder.stages.gauss_newton_step import BACKWARD_ERROR

STAGE = "gauss_newton_step"
INGREDIENTS = ("jacobian", "information_matrix", "residual")  # in the order of the arguments of the last
LAST = "normal_equations"
EARLIER = (*INGREDIENTS, LAST)


@dataclass(frozen=True)
class Systems:
    """The student's own H and b on the cases of one rung; every H is positive definite with the true pattern."""

    H: list[Array]
    b: list[Array]

    def solved_by(self, steps: Sequence[Array]) -> bool:
        """Whether every dx solves its own H dx = -b, by backward error."""
        return all(_solves(H, b, dx) for H, b, dx in zip(self.H, self.b, steps, strict=True))


def own_calls(cases: Sequence[Case], ingredients: Sequence[Outputs]) -> list[Case] | None:
    """Return (J, Omega, f) of the student for every case; None where one is not numbers of the right shape."""
    if len(ingredients) != len(INGREDIENTS) or any(outputs.outcome.any() for outputs in ingredients):
        return None
    if not all(np.isfinite(outputs.data).all() for outputs in ingredients):
        return None
    calls = []
    for (_, graph), J, omega, f in zip(cases, *map(arrays_of, ingredients), strict=True):
        m, n = graph.n_factors, graph.n_poses
        if J.shape != (m, n) or omega.shape != (m, m) or f.shape != (m,):
            return None
        calls.append((J, omega, f))
    return calls


def own_systems(cases: Sequence[Case], patterns: Sequence[NDArray[np.bool_]], outputs: Outputs) -> Systems | None:
    """Read the student's H and b; None where an H is not positive definite with the true pattern.

    None too where no step has to be worked out, because 0 or -x solves every system: an f that is 0,
    or one that no measurement enters, would pay for a step of one line.
    """
    if outputs.outcome.any() or not np.isfinite(outputs.data).all():
        return None
    arrays = arrays_of(outputs)
    systems = Systems(arrays[::2], arrays[1::2])
    for H, b, pattern in zip(systems.H, systems.b, patterns, strict=True):
        if b.shape != (len(pattern),) or not _sound(H, pattern):
            return None
    states = [x for x, _ in cases]
    trivial = any(systems.solved_by([factor * x for x in states]) for factor in (0.0, -1.0))
    return None if trivial else systems


def _sound(H: Array, pattern: NDArray[np.bool_]) -> bool:
    if H.shape != pattern.shape:
        return False
    size = np.abs(H).max(initial=0.0)
    if not np.abs(H - H.T).max(initial=0.0) <= 1e-9 * size:
        return False
    if not np.array_equal(np.abs(H) > 1e-12 * size, pattern):
        return False
    try:
        np.linalg.cholesky(H)
    except np.linalg.LinAlgError:
        return False
    return True


def _solves(H: Array, b: Array, dx: Array) -> bool:
    if dx.shape != b.shape or not np.isfinite(dx).all():
        return False
    scale = np.abs(H).sum(axis=1).max() * np.abs(dx).max() + np.abs(b).max()
    return bool(np.abs(H @ dx + b).max() <= BACKWARD_ERROR * scale + 1e-12)

"""Bonus stage `range_factor`: a factor that is not linear, the distance to a beacon beside the line."""

from __future__ import annotations

import numpy as np

from assignment.posegraph import Ranging
from autograder.problems.cases import Case
from autograder.problems.ladders import RANGINGS
from autograder.stages.base import Array, ArrayStage, Shape, Stage
from autograder.stages.wording import beside
from reference_solution import slam1d


class RangeResidual(ArrayStage):
    """Asks for distance minus measured range, shape (q,) [m]."""

    name = "range_factor"
    function = "range_residual"
    title = "Range factor"
    position = 8
    points = 5.0
    bonus = True
    ladder = RANGINGS
    shares = {"distances": 0.4, "derivatives": 0.6}

    def facet(self, rung: str) -> Stage:
        """Distances are asked of range_residual, their derivatives of range_jacobian."""
        return self if rung == "distances" else _DERIVATIVES

    def expected(self, x: Array, ranging: Ranging) -> tuple[Array, ...]:
        """Return f."""
        return (slam1d.range_residual(x, ranging),)

    def shapes(self, x: Array, ranging: Ranging) -> list[Shape]:
        """Return (q,)."""
        return [(len(ranging.poses),)]

    def tolerance(self, x: Array, ranging: Ranging) -> tuple[Array, ...]:
        """Allow 1e-9 of the numbers that a row is made of."""
        size = np.abs(x[ranging.poses]) + np.abs(ranging.beacon).sum() + ranging.ranges
        return (1e-9 * (1.0 + size),)

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Name the first wrong row."""
        f = self.expected(*case)[0]
        row = int(np.argmax(~(np.abs(got[0].ravel() - f) <= self.tolerance(*case)[0])))
        pose = int(case[1].poses[row])
        return f"row {row} (pose {pose}) of f: {beside(got[0].ravel()[row], f[row])} [m]."


class RangeJacobian(RangeResidual):
    """Asks for the derivative of these distances, shape (q, n)."""

    function = "range_jacobian"

    def expected(self, x: Array, ranging: Ranging) -> tuple[Array, ...]:
        """Return J."""
        return (slam1d.range_jacobian(x, ranging),)

    def shapes(self, x: Array, ranging: Ranging) -> list[Shape]:
        """Return (q, n)."""
        return [(len(ranging.poses), len(x))]

    def tolerance(self, x: Array, ranging: Ranging) -> tuple[Array, ...]:
        """Allow 1e-6 an entry: central differences pass."""
        return (np.full(1, 1e-6),)

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Name the first wrong row."""
        J = self.expected(*case)[0]
        row = int(np.argmax((~(np.abs(got[0] - J) <= 1e-6)).any(axis=1)))
        pose = int(case[1].poses[row])
        return f"row {row} (pose {pose}) of J: {beside(got[0][row], J[row])}."


_DERIVATIVES = RangeJacobian()
STAGE = RangeResidual()

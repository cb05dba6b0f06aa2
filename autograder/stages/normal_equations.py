"""Stage `normal_equations`: H and b on given (J, Omega, f), also ones that no graph has."""

from __future__ import annotations

import numpy as np

from autograder.problems.cases import Case
from autograder.problems.ladders import MATRICES
from autograder.stages.base import Array, ArrayStage, Shape
from autograder.stages.wording import beside
from reference_solution import slam1d


class NormalEquations(ArrayStage):
    """Asks for H = J^T Omega J, shape (n, n), and b = J^T Omega f, shape (n,)."""

    name = function = "normal_equations"
    title = "Normal equations H, b"
    position = 4
    points = 20.0
    parts = 2
    ladder = MATRICES
    shares = {"whole_numbers": 0.3, "unequal_weights": 0.25, "graph_shaped": 0.2, "dense": 0.2, "large": 0.05}

    def expected(self, J: Array, omega: Array, f: Array) -> tuple[Array, ...]:
        """Return H and b."""
        return slam1d.normal_equations(J, omega, f)

    def shapes(self, J: Array, omega: Array, f: Array) -> list[Shape]:
        """Return (n, n) and (n,)."""
        n = J.shape[1]
        return [(n, n), (n,)]

    def tolerance(self, J: Array, omega: Array, f: Array) -> tuple[Array, ...]:
        """Allow 1e-9 of the largest entry of |J|^T Omega |J| and of |J|^T Omega |f|, which bound the rounding.

        One bound for all entries, also where H is 0: noise from a solver and a guard such as
        H + 1e-9 I move a step by less than rounding does.
        """
        size = np.abs(J).T @ omega
        H, b = size @ np.abs(J), size @ np.abs(f)
        return np.full(1, 1.1e-9 * (1.0 + H.max(initial=0.0))), np.full(1, 1.1e-9 * b.max(initial=0.0))

    def explain(self, case: Case, got: tuple[Array, ...]) -> str:
        """Name the first wrong entry of H, or the whole of b."""
        H, b = self.expected(*case)
        allowed_H, allowed_b = self.tolerance(*case)
        wrong = np.argwhere(~(np.abs(got[0] - H) <= allowed_H))
        if len(wrong):
            i, j = (int(index) for index in wrong[0])
            symmetric = np.abs(got[0] - got[0].T).max() <= allowed_H.max()
            remark = "" if symmetric else " H must be symmetric, and yours is not."
            return f"H[{i}, {j}]: {beside(got[0][i, j], H[i, j])}.{remark}"
        return f"b: {beside(got[1], b)}; H is right."


STAGE = NormalEquations()

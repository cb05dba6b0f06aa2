"""A graded text that can be asked again, what the exact witness has for it, and how numbers are printed."""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph, Ranging
from autograder.verdicts import StageVerdict
from tests.witness import exact_normal_equations, exact_problem, exact_step

ARGUMENTS = {"normal_equations": ("J", "omega", "f"), "information_matrix": ("graph",), "sparsity_pattern": ("graph",)}


@dataclasses.dataclass(frozen=True)
class Told:
    """One stage of a graded text: the verdict, all verdicts, what the text defines, and the text."""

    verdict: StageVerdict
    verdicts: Mapping[str, StageVerdict]
    defined: Mapping[str, Any]
    text: str

    @property
    def example(self) -> dict[str, Any]:
        """The case that is shown; empty where it is too large."""
        failed = sorted((each for each in self.verdict.checks if not each.passed), key=lambda each: each.points > 0)
        return failed[0].counterexample or {}

    def call(self) -> tuple[Any, ...]:
        """Return the arguments of the call that is shown."""
        names = ARGUMENTS.get(self.example["function"], ("x", "graph"))
        return tuple(_argument(self.example.get(name, self.example.get("ranging"))) for name in names)

    def ask(self, *call: Any, function: str = "") -> Any:
        """Call the submission's own function on copies."""
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            given = [each.copy() if isinstance(each, np.ndarray) else each for each in call]
            return self.defined[function or self.example["function"]](*given)

    def step(self, x: Any, graph: Any) -> np.ndarray:
        """Return the submission's own step as a vector."""
        return np.asarray(self.ask(x, graph, function="gauss_newton_step"), dtype=float).ravel()


def _argument(data: Any) -> Any:
    if not isinstance(data, dict):
        return np.array(data, dtype=float)
    return (Ranging if "beacon" in data else PoseGraph)(**data)


def right(told: Told) -> list[np.ndarray]:
    """Return what the witness has for the call that is shown, in floating point."""
    function, call = told.example["function"], told.call()
    if function.startswith("range_"):
        x, ranging = call
        gap = np.hypot(x[ranging.poses] - ranging.beacon[0], ranging.beacon[1])
        J = np.zeros((len(gap), len(x)))
        J[np.arange(len(gap)), ranging.poses] = (x[ranging.poses] - ranging.beacon[0]) / gap
        return [gap - ranging.ranges if function == "range_residual" else J]
    if function == "normal_equations":
        J, omega, f = call
        weights = np.diag(omega)
        H = sum(w * np.outer(row, row) for w, row in zip(weights, J, strict=True))
        return [np.asarray(H), np.asarray(sum(w * row * r for w, row, r in zip(weights, J, f, strict=True)))]
    x, graph = call if len(call) == 2 else (np.zeros(call[0].n_poses), call[0])
    f, J, weights = exact_problem(x, graph)
    if function == "gauss_newton_step":
        return [np.array(exact_step(x, graph), dtype=float)]
    H = exact_normal_equations(f, J, weights)[0]
    masks = [np.array(J, dtype=float) != 0, np.abs(np.array(J, dtype=float)).T @ np.abs(np.array(J, dtype=float)) != 0]
    found = {
        "residual": [np.array(f, dtype=float)],
        "jacobian": [np.array(J, dtype=float)],
        "information_matrix": [np.diag(np.array(weights, dtype=float))],
        "sparsity_pattern": [masks[0], masks[1] | (np.array(H, dtype=float) != 0)],
    }
    return found[function]


def reads(shown: str, value: Any, size: float = 0.0) -> bool:
    """Whether numbers are printed so: six digits, noise as 0, a long vector cut in the middle."""
    numbers = shown.strip("[]").split()
    values = np.asarray(value, dtype=float).ravel().tolist()
    if "..." in numbers:
        cut = numbers.index("...")
        values = [*values[:cut], *values[cut - len(numbers) + 1 :]]
        numbers.remove("...")
    most = max([abs(each) for each in values], default=0.0)
    return len(numbers) == len(values) and all(
        abs(float(text) - each) <= 1e-5 * abs(each) + 1e-9 * most + size
        for text, each in zip(numbers, values, strict=True)
    )


def got(told: Told) -> list[np.ndarray]:
    """Ask for what is shown again; a column is a vector."""
    value = told.ask(*told.call())
    arrays = value if isinstance(value, tuple) else (value,)
    pairs = zip(arrays, right(told), strict=True)
    return [np.asarray(each, dtype=float).reshape(wanted.shape) for each, wanted in pairs]


def both(mine: Any, wanted: Any, shown: tuple[str, str, str | None]) -> bool:
    """Whether numbers came and were expected as it says, differ, and are as far apart as it says."""
    gap = float(np.abs(np.asarray(mine) - wanted).max())
    fits = reads(shown[0], mine, 1e-9 * (1 + gap)) and reads(shown[1], wanted, 1e-9)
    if shown[2] is not None:
        return fits and abs(float(shown[2]) - gap) <= 0.5 * gap + 1e-12
    return fits and shown[0] != shown[1] and gap > 0

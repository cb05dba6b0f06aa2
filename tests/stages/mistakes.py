"""Mistakes that one family of the domain shows and no other: right on the worked example, by stage."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from autograder.problems.graphs import reachable
from reference_solution import slam1d

Function = Callable[..., Any]


def prior_rows(f: np.ndarray, graph: Any, keep: Callable[[int, int], bool]) -> np.ndarray:
    """Set the rows of those priors to 0 that are not kept; `keep` is asked about the number of a prior and its pose."""
    lost = [len(graph.edges) + row for row, pose in enumerate(graph.priors.tolist()) if not keep(row, pose)]
    changed = f.copy()
    changed[lost] = 0.0
    return changed


def first_digits(values: np.ndarray) -> np.ndarray:
    """Read one digit of every number."""
    return np.array([int(str(value)[0]) for value in values.ravel().tolist()], dtype=int).reshape(values.shape)


def variances(graph: Any) -> np.ndarray:
    """Return those of the edges, then those of the priors."""
    return np.concatenate([graph.edge_variances, graph.prior_variances])


def between(x: np.ndarray, graph: Any, edges: np.ndarray, measured: np.ndarray, means: np.ndarray) -> np.ndarray:
    """Return f with other edges, measurements or means."""
    return np.concatenate([x[edges[:, 0]] + measured - x[edges[:, 1]], x[graph.priors] - means])


def has_walk(graph: Any) -> bool:
    """Whether every pose has an edge to the next."""
    pairs = {frozenset(pair) for pair in graph.edges.tolist()}
    return all(frozenset((i, i + 1)) in pairs for i in range(graph.n_poses - 1))


def first_part(graph: Any) -> list[int]:
    """Return the poses that edges join to the first prior."""
    return sorted(reachable(int(graph.priors[0]), [(int(i), int(j)) for i, j in graph.edges]))


def solved(x: np.ndarray, graph: Any, solve: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> np.ndarray:
    """Solve the right equations in another way."""
    J, f = slam1d.jacobian(x, graph), slam1d.residual(x, graph)
    H, b = slam1d.normal_equations(J, slam1d.information_matrix(graph), f)
    return solve(H, -b)


def banded(H: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Solve what is left of H within nine diagonals."""
    n = np.arange(len(b))
    return np.linalg.solve(np.where(np.abs(n[:, None] - n) <= 9, H, 0.0), b)


def where(state: np.ndarray, *, kept: list[int]) -> np.ndarray:
    """Keep only these poses' entries."""
    return np.isin(np.arange(len(state)), kept) * state


f, J_of, omega_of, step = slam1d.residual, slam1d.jacobian, slam1d.information_matrix, slam1d.gauss_newton_step

RESIDUAL: dict[str, Function] = {
    "third prior ignored": lambda x, g: prior_rows(f(x, g), g, lambda row, _: row < 2),
    "at most n priors": lambda x, g: prior_rows(f(x, g), g, lambda row, _: row < g.n_poses),
    "one digit a pose": lambda x, g: (
        f(x, g) if g.n_poses < 10 else between(x, g, first_digits(g.edges), g.measurements, g.prior_means)
    ),
    "measurements cut to 10 m": lambda x, g: between(x, g, g.edges, np.clip(g.measurements, -10, 10), g.prior_means),
    "measurements cut to 100 m": lambda x, g: between(x, g, g.edges, np.clip(g.measurements, -100, 100), g.prior_means),
    "means cut to 50 m": lambda x, g: between(x, g, g.edges, g.measurements, np.clip(g.prior_means, -50, 50)),
    "f cut to 100 m": lambda x, g: np.clip(f(x, g), -100, 100),
    "states cut to 50 m": lambda x, g: f(np.clip(x, -50, 50), g),
    "f below 5 cm is 0": lambda x, g: f(x, g) * (np.abs(f(x, g)).max() > 0.05),
    "rows below 1 mm are 0": lambda x, g: np.where(np.abs(f(x, g)) < 1e-3, 0.0, f(x, g)),
    "a walk is needed": lambda x, g: f(x, g) * has_walk(g),
    "n - 1 edges are needed": lambda x, g: f(x, g) * (len(g.edges) >= g.n_poses - 1),
}
JACOBIAN: dict[str, Function] = {
    "third prior ignored": lambda x, g: prior_rows(J_of(x, g), g, lambda row, _: row < 2),
    "lonely pose forgotten": lambda x, g: prior_rows(J_of(x, g), g, lambda _, pose: pose in g.edges),
    "columns up to 9": lambda x, g: J_of(x, g) * (np.arange(g.n_poses) < 10),
    "first part only": lambda x, g: J_of(x, g) * np.isin(np.arange(g.n_poses), first_part(g)),
}
INFORMATION: dict[str, Function] = {
    "variances kept in a range": lambda g: np.diag(1.0 / np.clip(variances(g), 5e-4, 50.0)),
    "variances above 1e-4": lambda g: np.diag(1.0 / np.maximum(variances(g), 1e-4)),
    "variances below 100": lambda g: np.diag(1.0 / np.minimum(variances(g), 100.0)),
    "weights rounded": lambda g: omega_of(g).round(2),
    "third prior weighs as the second": lambda g: np.diag(
        1.0 / np.concatenate([g.edge_variances, g.prior_variances[np.minimum(np.arange(len(g.priors)), 1)]])
    ),
}
EQUATIONS: dict[str, Function] = {
    "weights above 0.01": lambda J, omega, f: slam1d.normal_equations(J, np.diag(np.maximum(np.diag(omega), 0.01)), f),
    "weights below 5000": lambda J, omega, f: slam1d.normal_equations(J, np.minimum(omega, 5000.0), f),
    "f cut to 100": lambda J, omega, f: slam1d.normal_equations(J, omega, np.clip(f, -100.0, 100.0)),
    "outliers dropped": lambda J, omega, f: slam1d.normal_equations(J, omega * (np.abs(f) < 100.0), f),
    "small f dropped": lambda J, omega, f: slam1d.normal_equations(J, omega, np.where(np.abs(f).max() < 0.05, 0.0, f)),
    "m < n is refused": lambda J, omega, f: slam1d.normal_equations(J * (len(J) >= J.shape[1]), omega, f),
}
STEP: dict[str, Function] = {
    "0 where f is below 5 cm": lambda x, g: step(x, g) * (np.abs(f(x, g)).max() > 0.05),
    "0 where the step is below 1 mm": lambda x, g: step(x, g) * (np.abs(step(x, g)).max() > 1e-3),
    "at most 100 m": lambda x, g: np.clip(step(x, g), -100.0, 100.0),
    "small singular values cut at 1e-5": lambda x, g: solved(x, g, lambda H, b: np.linalg.lstsq(H, b, rcond=1e-5)[0]),
    "nine diagonals of H": lambda x, g: solved(x, g, banded),
    "no more than nine poses": lambda x, g: step(x, g) * (not 10 <= g.n_poses < 100),
    "first part only": lambda x, g: where(step(x, g), kept=first_part(g)),
}
SECOND_STEP: dict[str, Function] = {
    "one prior is expected": lambda x, g: step(x, g) * (len(g.priors) == 1),
    "three priors are too many": lambda x, g: step(x, g) * (len(g.priors) < 3),
    "first part only": lambda x, g: where(step(x, g), kept=first_part(g)),
    "no more than nine poses": lambda x, g: step(x, g) * (g.n_poses < 10),
    "at most 50 m": lambda x, g: np.clip(step(x, g), -50.0, 50.0),
    "a walk is needed": lambda x, g: step(x, g) * has_walk(g),
}
PATTERN: dict[str, Function] = {
    "a walk is expected": lambda g: (
        slam1d.sparsity_pattern(g)[0],
        slam1d.sparsity_pattern(g)[1] | (np.abs(np.subtract.outer(range(g.n_poses), range(g.n_poses))) == 1),
    ),
}
DISTANCES: dict[str, Function] = {
    "60 m at the most": lambda x, r: np.minimum(slam1d.range_residual(x, r) + r.ranges, 60.0) - r.ranges,
}
DERIVATIVES: dict[str, Function] = {
    "a sign far away": lambda x, r: np.where(
        np.abs(slam1d.range_jacobian(x, r)) > 0.999, np.sign(slam1d.range_jacobian(x, r)), slam1d.range_jacobian(x, r)
    ),
    "columns up to 9": lambda x, r: slam1d.range_jacobian(x, r) * (np.arange(len(x)) < 10),
}
MISTAKES: dict[tuple[str, str], dict[str, Function]] = {
    ("residual", ""): RESIDUAL,
    ("jacobian", ""): JACOBIAN,
    ("information_matrix", ""): INFORMATION,
    ("normal_equations", ""): EQUATIONS,
    ("gauss_newton_step", ""): STEP,
    ("second_step", ""): SECOND_STEP,
    ("sparsity_pattern", ""): PATTERN,
    ("range_factor", "distances"): DISTANCES,
    ("range_factor", "derivatives"): DERIVATIVES,
}

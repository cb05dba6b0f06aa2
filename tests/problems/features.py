"""Families of the contract's domain, each as a question about a case: graphs, states, matrices and ranges."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from autograder.problems.graphs import information
from reference_solution import slam1d


def parts(graph) -> list[set[int]]:
    """Return the connected parts, by joining the ends of every edge."""
    found = [{pose} for pose in range(graph.n_poses)]
    for i, j in graph.edges.tolist():
        one, other = (next(part for part in found if pose in part) for pose in (i, j))
        if one is not other:
            found.remove(other)
            one |= other
    return found


def factors_of_walk(graph) -> set[frozenset[int]]:
    """Return the pairs 0 - 1 - ... - (n - 1)."""
    return {frozenset((i, i + 1)) for i in range(graph.n_poses - 1)}


def is_star(graph) -> bool:
    """Whether all edges of a graph of four poses or more, in one part, meet in one pose."""
    common = set.intersection(*(set(pair) for pair in graph.edges.tolist()))
    return graph.n_poses > 3 and len(parts(graph)) == 1 and len(common) == 1


SHAPES: dict[str, Callable[[Any], bool]] = {
    "three and more priors": lambda graph: len(graph.priors) >= 3,
    "three priors in mixed order": lambda graph: _mixed(graph.priors.tolist()),
    "several priors on one pose": lambda graph: len(set(graph.priors.tolist())) < len(graph.priors),
    "several parts": lambda graph: len(parts(graph)) > 1,
    "a lonely pose": lambda graph: len(parts(graph)) > 1 and min(map(len, parts(graph))) == 1,
    "fewer than n - 1 edges": lambda graph: len(graph.edges) < graph.n_poses - 1,
    "connected without the walk": lambda graph: (
        len(parts(graph)) == 1 and not factors_of_walk(graph) <= {frozenset(pair) for pair in graph.edges.tolist()}
    ),
    "a star": is_star,
    "10 to 99 poses": lambda graph: 10 <= graph.n_poses <= 99,
}
WEIGHTS: dict[str, Callable[[Any], bool]] = {
    "variances below 1e-4": lambda graph: min(_variances(graph)) < 1e-4,
    "variances above 100": lambda graph: max(_variances(graph)) > 100.0,
}
CONDITION: dict[str, Callable[[Any], bool]] = {
    "cond(H) beyond 1e4": lambda graph: np.linalg.cond(information(graph)) > 1e4,
    "cond(H) beyond 1e5": lambda graph: np.linalg.cond(information(graph)) > 1e5,
}
STATES: dict[str, Callable[[Any, Any], bool]] = {
    "every |f| below 5 cm": lambda x, graph: 0.0 < np.abs(slam1d.residual(x, graph)).max() < 0.05,
    "a step below 1 mm": lambda x, graph: 0.0 < np.abs(slam1d.gauss_newton_step(x, graph)).max() < 1e-3,
    "a step below 1 mm beside large f": lambda x, graph: (
        0.0 < np.abs(slam1d.gauss_newton_step(x, graph)).max() < 1e-3 and np.abs(slam1d.residual(x, graph)).max() > 0.1
    ),
    "states from -80 to 60": lambda x, _: x.min() < -75.0 or x.max() > 75.0,
    "means beyond 60": lambda _, graph: np.abs(graph.prior_means).max() > 60.0,
    "measurements beyond 100 m": lambda _, graph: np.abs(graph.measurements).max() > 100.0,
    "|f| beyond 100 m": lambda x, graph: np.abs(slam1d.residual(x, graph)).max() > 100.0,
}
SYSTEMS: dict[str, Callable[[Any, Any, Any], bool]] = {
    "weights below 0.005": lambda _J, omega, _f: np.diag(omega).min() < 0.005,
    "weights above 5000": lambda _J, omega, _f: np.diag(omega).max() > 5000.0,
    "|f| beyond 100": lambda _J, _omega, f: np.abs(f).max() > 100.0,
    "every |f| below 0.05": lambda _J, _omega, f: 0.0 < np.abs(f).max() < 0.05,
    "fewer rows than columns": lambda J, _omega, _f: J.shape[0] < J.shape[1],
    "ten columns and more": lambda J, _omega, _f: J.shape[1] >= 10,
}
RANGINGS: dict[str, Callable[[Any, Any], bool]] = {
    "seen from 60 m": lambda x, ranging: np.abs(x[ranging.poses] - ranging.beacon[0]).max() > 60.0,
    "states from -80 to 60": lambda x, _: np.abs(x).max() > 75.0,
    "ten poses and more": lambda x, _: len(x) >= 10,
}


def _mixed(priors: list[int]) -> bool:
    return len(priors) >= 3 and priors not in (sorted(priors), sorted(priors, reverse=True))


def _variances(graph) -> list[float]:
    return [*graph.edge_variances.tolist(), *graph.prior_variances.tolist()]


FEATURES = {
    "graphs": [*SHAPES, *WEIGHTS, *CONDITION, *STATES],
    "loops": [*SHAPES, *WEIGHTS, *STATES],
    "matrices": [*SYSTEMS],
    "rangings": [*RANGINGS],
}


def has(ladder: str, feature: str, case: tuple[Any, ...]) -> bool:
    """Whether a case has a feature; a loop case, at the first of its two states."""
    if ladder == "matrices":
        return bool(SYSTEMS[feature](*case))
    if ladder == "rangings":
        return bool(RANGINGS[feature](*case))
    x, graph = case
    on_graph = SHAPES | WEIGHTS | CONDITION
    if feature in on_graph:
        return bool(on_graph[feature](graph))
    return bool(STATES[feature](x[0] if ladder == "loops" else x, graph))

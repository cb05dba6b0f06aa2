"""What the templates of the handout fill in: the problem in words and numbers, and facts from the reference."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems import graphs
from autograder.problems.conclusion import choices
from autograder.problems.ladders import GRAPHS
from autograder.problems.problem import Problem
from autograder.render import landmarks
from autograder.render.facts import BY_HAND, TWIN, row_by_hand, solve_worked
from autograder.render.grading import Grading
from autograder.render.stub import CORE, graph_source, start_source
from autograder.render.template import source

__all__ = ["values"]

PLAN = (
    ("the story and the model", 20),
    ("1: residual", 25),
    ("2: Jacobian", 20),
    ("3: information matrix", 15),
    ("4: normal equations", 20),
    ("sparsity", 10),
    ("5: step", 20),
    ("question 2", 25),
    ("question 3", 25),
)
WORDS = ("none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
SIGN = (  # the one rule of the signs, in the words of docstring and hints
    "The row of an edge is where the edge puts pose $j$, minus where the state puts it: $x_i + u_{ij} - x_j$. "
    "The row of a prior is where the state puts pose $i$, minus the mean: $x_i - \\mu_i$."
)
OLDEST_PYTHON = "3.9"  # on which a student's files run


def values(problem: Problem, grading: Grading | None = None) -> dict[str, Any]:
    """Collect everything that a template may name. Nothing of it is an answer about this problem.

    `grading` is what the course says of titles, points and dates; without it the defaults hold.
    """
    graph = problem.graph
    worked = solve_worked()
    return {
        "variant": problem.variant,
        "graph": graph,
        "own_landmarks": problem.landmarks,
        "graph_source": graph_source(graph),
        "start": start_source(problem.start),
        "truth": start_source(problem.truth),
        "factors": _factors(graph, problem.landmarks),
        "poses": [
            {"index": k, "truth": number(true), "start": number(start)}
            for k, (true, start) in enumerate(zip(problem.truth, problem.start, strict=True))
        ],
        "plan": PLAN,
        "sign": SIGN,
        **(grading or Grading()).words(),
        "oldest_python": OLDEST_PYTHON,
        "explore_minutes": 60,
        **_counted(),
        "certain": 100,
        "graded": _graded(),
        "twin": {
            "pose": int(TWIN.poses[0]),
            "beacon": "(" + ", ".join(number(place) for place in TWIN.beacon) + ")",
            "source": "Ranging("
            + ", ".join(f"np.array({getattr(TWIN, name).tolist()})" for name in TWIN.__dataclass_fields__)
            + ")",
        },
        "choices": choices(problem.variant),
        "by_hand": _by_hand(graph),
        "example": {
            "sigma": number(graph.edge_variances[0] ** 0.5),
            "variance": number(graph.edge_variances[0]),
            "weight": number(1 / graph.edge_variances[0]),
        },
        "prior": {
            "variance": number(graph.prior_variances[0]),
            "sigma": number(graph.prior_variances[0] ** 0.5),
            "compared": _compared(graph.prior_variances[0], graph.edge_variances[0]),
        },
        "worked": {
            "rmse": f"{worked.rmse:.3f}",
            "rmse1": f"{worked.rmse1:.3f}",
            "cost": number(worked.cost),
            "cost1": number(worked.cost1),
            "prior_weight": number(worked.omega[-1, -1]),
        },
        "sparsity": _sparsity(graph),
        "row_sums": _row_sums(graph),
        "landmarks": landmarks.counts(),
    }


def number(value: float) -> str:
    """Print a number short, without the noise of adding floats.

    Examples
    --------
    >>> number(0.1 + 0.2), number(-0.0), number(0.001 ** 0.5)
    ('0.3', '0', '0.0316')
    """
    return f"{round(float(value), 4) + 0.0:g}"


def _bracket(value: float) -> str:
    return f"({number(value)})" if value < 0 else number(value)


def _compared(variance: float, other: float) -> str:
    """Compare two standard deviations in words."""
    ratio = (other / variance) ** 0.5
    if round(ratio, 2) == 1:
        return "the same as"
    return f"{ratio:.2g} times smaller than" if ratio > 1 else f"{1 / ratio:.2g} times larger than"


def _factors(graph: PoseGraph, marks: tuple[int, ...]) -> list[dict[str, Any]]:
    rows: list[dict[str, str]] = []
    met: set[int] = set()
    for (i, j), u, v in zip(
        graph.edges.tolist(), graph.measurements.tolist(), graph.edge_variances.tolist(), strict=True
    ):
        kind = (
            "odometry" if abs(i - j) == 1 and not {i, j} & set(marks) else "loop" if {i, j} <= met else "edge"
        )  # to what is seen first
        met |= {i, j}
        rows.append({"words": f"{kind} {i} → {j}", "value": f"{u:.2f}", "variance": number(v)})
    for k, mean, v in zip(
        graph.priors.tolist(), graph.prior_means.tolist(), graph.prior_variances.tolist(), strict=True
    ):
        rows.append({"words": f"prior on pose {k}", "value": f"{mean:.2f} (mean)", "variance": number(v)})
    return [{"row": row, **words} for row, words in enumerate(rows)]


def _by_hand(graph: PoseGraph) -> dict[str, Any]:
    """Work one edge row and one prior row where every pose stands at 1 m."""
    prior_row = len(graph.edges)
    (i, j), u, mean = graph.edges[0].tolist(), float(graph.measurements[0]), float(graph.prior_means[0])
    return {
        "edge_row": 0,
        "i": i,
        "j": j,
        "u": number(u),
        "u_bracket": _bracket(u),
        "predicted": number(BY_HAND + u),
        "f_edge": number(row_by_hand(graph, 0)),
        "prior_row": prior_row,
        "place": number(BY_HAND),
        "k": int(graph.priors[0]),
        "mean": number(mean),
        "mean_bracket": _bracket(mean),
        "f_prior": number(row_by_hand(graph, prior_row)),
    }


@cache
def _counted() -> dict[str, Any]:
    """Count what the handout counts in words."""
    headings = re.findall(r"^## \d+\. .*$", source("explore.ipynb.j2"), re.MULTILINE)
    states = len(solve_worked().iterates)
    return {
        "functions": len(CORE),
        "functions_word": WORDS[len(CORE)],
        "steps_word": WORDS[states - 1],
        "states_word": WORDS[states],
        "row_word": WORDS[landmarks.counts()["row"]],
        "experiments_word": WORDS[sum("bonus" not in heading for heading in headings)],
    }


@cache
def _graded() -> dict[str, str]:
    """Say how far the cases go: the fixed ones hold the smallest and the largest graph, the bounds hold for all."""
    sizes = [case[1].n_poses for rung in GRAPHS.rungs for case in rung.core]
    bounds = {
        "fewest": min(sizes),
        "most": max(sizes),
        "measured": graphs.MAX_MEASUREMENT,
        "state": graphs.MAX_STATE,
        "surest": graphs.VARIANCES[0],
        "least_sure": graphs.VARIANCES[1],
        "lightest": graphs.WEIGHTS[0],
        "heaviest": graphs.WEIGHTS[1],
        "residual": graphs.MAX_RESIDUAL,
    }
    return {name: np.format_float_positional(bound, trim="-") for name, bound in bounds.items()}


def _sparsity(graph: PoseGraph) -> dict[str, int]:
    _J, H = landmarks.patterns(graph)
    return {
        "n": graph.n_poses,
        "pairs": len(landmarks.pairs_of(graph)),
        "nnz": int(np.sum(H)),
        "cells": graph.n_poses**2,
    }


def _row_sums(graph: PoseGraph) -> str:
    weights = np.zeros(graph.n_poses)
    np.add.at(weights, graph.priors, 1.0 / graph.prior_variances)
    return "(" + ", ".join(number(weight) for weight in weights) + ")"

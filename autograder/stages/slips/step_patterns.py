"""Recognise a wrong step by the equations that it does solve: damped, without priors, held at pose 0, of few digits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from autograder.problems.cases import Case
from autograder.stages.base import Array, Met
from reference_solution import slam1d

SOLVED = 1e-8  # backward error of a system that was solved, with room for a J from differences
SOME = 16  # calls that tell a constant


@dataclass(frozen=True)
class _Left:
    """What a step leaves of a system: H dx + b = `left`, beside the size of the terms."""

    x: Array
    dx: Array
    H: Array
    left: Array
    size: float


def _left(call: Case, got: tuple[Array, ...] | None, *, priors: bool = True) -> _Left | None:
    """Put a step into the equations, without the rows of the priors where these are to be left out."""
    x, graph = call
    if got is None or got[0].shape != x.shape or not np.isfinite(got[0]).all():
        return None
    rows = slice(None) if priors else slice(len(graph.edges))
    J, omega, f = slam1d.jacobian(x, graph), slam1d.information_matrix(graph), slam1d.residual(x, graph)
    H, b = slam1d.normal_equations(J[rows], omega[rows, rows], f[rows])
    dx = got[0]
    reach = np.abs(x).max() + np.abs(graph.measurements).max(initial=0.0) + np.abs(dx).max()
    return _Left(x, dx, H, H @ dx + b, float(np.abs(H).sum(axis=1).max(initial=0.0) * reach) + 1e-9)


def damped(met: Sequence[Met]) -> bool:
    """Find a step of (H + lambda D) dx = -b, with one lambda above 0 in all calls and D = I or diag(H)."""
    return _constant(met, lambda H: np.ones(len(H))) or _constant(met, np.diag)


def held_by_a_number(met: Sequence[Met]) -> bool:
    """Find a step of H with one positive number more in its first entry."""
    return _constant(met, lambda H: np.eye(len(H))[0])


def _constant(met: Sequence[Met], diagonal: Callable[[Array], Any]) -> bool:
    """Whether H dx + b = -c D dx holds with one c > 0 for all calls."""
    best, found = 0.0, 0.0
    for call, got in met[:SOME]:
        case = _left(call, got)
        if case is None:
            return False
        moved = diagonal(case.H) * case.dx
        seen = float(np.abs(moved).max() / case.size)
        if seen > best:
            best, found = seen, float(-(case.left @ moved) / (moved @ moved))
    if found <= 0:
        return False
    for call, got in met:
        case = _left(call, got)
        if case is None:
            return False
        moved = found * diagonal(case.H) * case.dx
        if np.abs(case.left + moved).max() > SOLVED * case.size + 1e-5 * np.abs(moved).max():
            return False
    return True


def of_single_precision(met: Sequence[Met]) -> bool:
    """Find steps near the right ones whose numbers all have 24 bits."""
    for call, got in met:
        case = _left(call, got)
        if case is None or np.abs(case.left).max() > 1e-5 * case.size:
            return False
        if (case.dx.astype(np.float32).astype(np.float64) != case.dx).any():
            return False
    return True


def priors_replaced_by_pose_0_held(met: Sequence[Met]) -> bool:
    """Find steps that fit the edges alone and leave pose 0 where it starts."""
    return _edges_alone(met, lambda case: case.dx[0])


def priors_replaced_by_pose_0_at_0(met: Sequence[Met]) -> bool:
    """Find steps that fit the edges alone and put pose 0 at 0."""
    return _edges_alone(met, lambda case: case.x[0] + case.dx[0])


def of_singular_equations(met: Sequence[Met]) -> bool:
    """Find steps that fit the edges alone and stand anywhere, and none, or 0, where the solver gave up."""
    return _edges_alone(met, None)


def _edges_alone(met: Sequence[Met], anchor: Callable[[_Left], float] | None) -> bool:
    """Whether all steps fit the edges, and the anchor is 0, but do not fit the priors.

    No step, or 0, is allowed where H is singular: without an anchor everywhere, with one for a graph in several
    parts. One prior on pose 0 may agree with an anchor, but not with a chain that stands anywhere.
    """
    fitting = wrong = 0
    for call, got in met:
        case = _left(call, got, priors=False)
        held = anchor is not None and _in_one_piece(call[1])
        if case is None:
            if held or (got is not None and got[0].shape != call[0].shape):
                return False
            continue
        if not case.dx.any() and not held:
            continue
        if np.abs(case.left).max() > SOLVED * case.size:
            return False
        if held and anchor is not None and abs(anchor(case)) > 1e-5 * (1.0 + np.abs(case.dx).max()):
            return False
        whole = _left(call, got)
        fitting += 1
        wrong += whole is not None and bool(np.abs(whole.left).max() > SOLVED * whole.size)
    return bool(5 * fitting >= len(met) and (wrong > 0 if anchor else 4 * wrong >= 3 * fitting))


def _in_one_piece(graph: Any) -> bool:
    reached, before = {0}, 0
    while len(reached) > before:
        before = len(reached)
        reached |= {end for edge in graph.edges.tolist() if reached & set(edge) for end in edge}
    return bool(len(reached) == graph.n_poses)


def step_sizes(x: Array, graph: Any) -> tuple[Array, ...]:
    """Return how large the numbers are that a step is made of, and what the rounding of H makes of them."""
    reach = 1.0 + np.abs(x).max() + np.abs(graph.measurements).max(initial=0.0)
    return (np.full(1, reach * 1e3),)

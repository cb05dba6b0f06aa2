"""Recognise a mistake by what it is, where its numbers depend on a constant of the student's or on rounding.

A lambda, a number of digits and the last bits of a processor are not the same for two students: such a slip is known
by the size and the pattern of its error over all calls of the exam.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from autograder.stages.base import Array, Met, Pattern
from autograder.stages.same import off
from reference_solution import slam1d

_WORKED = ((0, 1), (1, 2), (2, 3), (3, 4), (0, 4))  # the edges of the worked example
SINGLE, DOUBLE = 2.0**-24, 2.0**-53  # the rounding of the two types, relative
MANY = 6  # different errors: so many are no constant


@dataclass(frozen=True)
class _Errors:
    """All numbers of one part end to end: what came, what is right, and the size of the terms."""

    got: Array
    wanted: Array
    size: Array

    @property
    def relative(self) -> Array:
        return np.abs(self.got - self.wanted) / self.size


Sizes = Callable[..., tuple[Array, ...]]


def _errors(met: Sequence[Met], right: Callable[..., Any], sizes: Sizes) -> list[_Errors] | None:
    """Lay answers beside the right ones; None where an answer has another shape, or is not finite."""
    parts: list[list[tuple[Array, Array, Array]]] = []
    for call, got in met:
        value = right(*call)
        wanted = value if isinstance(value, tuple) else (value,)
        if got is None or [each.shape for each in got] != [each.shape for each in wanted]:
            return None
        for part, (mine, other, size) in enumerate(zip(got, wanted, sizes(*call), strict=True)):
            if not np.isfinite(mine).all():
                return None
            parts += [[]] * (part >= len(parts))
            parts[part] = [*parts[part], (mine.ravel(), other.ravel(), np.broadcast_to(size, mine.shape).ravel())]
    return [_Errors(*(np.concatenate(column) for column in zip(*rows, strict=True))) for rows in parts]


def rounded(right: Callable[..., Any], sizes: Sizes) -> Pattern:
    """Find numbers that are the right ones but for one number of decimals."""

    def fits(met: Sequence[Met]) -> bool:
        errors = _errors(met, right, sizes)
        if errors is None:
            return False
        states = [_rounded_part(each) for each in errors]
        return all(state is not None for state in states) and any(states)

    return fits


def _rounded_part(errors: _Errors) -> bool | None:
    """Whether one part is rounded (True), right (False), or neither (None)."""
    if errors.relative.max(initial=0.0) <= 1e-11:
        return False
    for digits in range(11):
        steps = errors.got * 10.0**digits
        near = np.abs(errors.got - errors.wanted) <= (0.5 + 1e-6) * 10.0**-digits + 1e-12 * errors.size
        whole = np.abs(steps - np.rint(steps)) <= 1e-6 + 8 * DOUBLE * np.abs(steps)
        if near.all() and whole.all():
            return True
    return None


def single_precision(right: Callable[..., Any], sizes: Sizes, terms: int) -> Pattern:
    """Find errors of the size that numbers of 24 bits have, irregular, and none where 24 bits are enough."""

    def fits(met: Sequence[Met]) -> bool:
        errors = _errors(met, right, sizes)
        if errors is None:
            return False
        worst = max(each.relative.max(initial=0.0) for each in errors)
        signed = np.concatenate([(each.got - each.wanted) / each.size for each in errors])
        seen = signed[np.abs(signed) > SINGLE / 64]
        return bool(
            SINGLE / 16 <= worst <= terms * SINGLE
            and seen.size
            and seen.min() < 0 < seen.max()
            and len(np.unique(seen.round(12))) >= MANY
        )

    return fits


def typed_in(met: Sequence[Met]) -> bool:
    """Find an f whose rows are those of the worked example's edges, and which fails where there are fewer."""
    answered = 0
    for (x, graph), got in met:
        if min(len(x), len(graph.edges)) < len(_WORKED):
            if got is not None:
                return False
            continue
        if got is None or got[0].ndim != 1 or len(got[0]) <= len(_WORKED):
            return False
        i, j = np.array(_WORKED).T
        rows = x[i] + graph.measurements[: len(_WORKED)] - x[j]
        priors = (x[0], x[0] - graph.prior_means[0])
        if off(got[0][: len(_WORKED)], rows, 1e-9 * (1.0 + np.abs(x).max())).any():
            return False
        if min(abs(got[0][len(_WORKED)] - prior) for prior in priors) > 1e-9 * (1.0 + abs(x[0])):
            return False
        answered += 1
    return answered > 0


def small_difference(met: Sequence[Met]) -> bool:
    """Find a J whose entries are right but for the noise of a difference over a very small step."""
    noise = []
    for (x, graph), got in met:
        J = slam1d.jacobian(x, graph)
        if got is None or got[0].shape != J.shape or off(got[0], J, 0.1).any():
            return False
        if np.abs(got[0][J == 0]).max(initial=0.0) > DOUBLE:  # a row without the pose does not change at all
            return False
        noise.append((got[0] - J)[J != 0])
    found = np.concatenate(noise)
    return bool(np.abs(found).max() > 1e-9 and found.min() < 0 < found.max() and len(np.unique(found)) >= MANY)


def regularised(met: Sequence[Met]) -> bool:
    """Find an H with one number more on its diagonal, or one share of it, beside a right b."""
    return any(_added(met, diagonal) for diagonal in (lambda H: np.ones(len(H)), np.diag))


def _added(met: Sequence[Met], diagonal: Callable[[Array], Array]) -> bool:
    added = []
    for call, got in met:
        H, b = slam1d.normal_equations(*call)
        sizes = product_sizes(*call)
        if got is None or got[0].shape != H.shape or got[1].shape != b.shape:
            return False
        if off(got[1], b, 1e-9 * sizes[1]).any():
            return False
        more = got[0] - H
        if off(more, np.diag(np.diag(more)), 1e-9 * sizes[0]).any() or not np.isfinite(got[0]).all():
            return False
        fine = diagonal(H) > 1e-6 * sizes[0]
        added += [np.array([np.diag(more)[fine] / diagonal(H)[fine], (1e-9 * sizes[0] / diagonal(H)[fine])])]
    found = np.concatenate(added, axis=1)
    best = int(np.argmin(found[1]))
    constant = found[0][best]
    return bool(constant > 10 * found[1][best] and (np.abs(found[0] - constant) <= 1e-5 * constant + found[1]).all())


def residual_sizes(x: Array, graph: Any) -> tuple[Array, ...]:
    """Return how large the numbers are that each row of f adds up."""
    i, j = graph.edges.T
    between = np.abs(x[i]) + np.abs(graph.measurements) + np.abs(x[j])
    return (np.concatenate([between, np.abs(x[graph.priors]) + np.abs(graph.prior_means)]) + 1e-9,)


def weight_sizes(graph: Any) -> tuple[Array, ...]:
    """Return the weight of each row of Omega."""
    return (np.diag(slam1d.information_matrix(graph))[:, None],)


def product_sizes(J: Array, omega: Array, f: Array) -> tuple[Array, ...]:
    """Return the largest sum of the sizes of the terms, of H and of b."""
    size = np.abs(J).T @ omega
    H, b = size @ np.abs(J), size @ np.abs(f)
    return np.full(1, H.max(initial=0.0) + 1e-9), np.full(1, b.max(initial=0.0) + 1e-9)

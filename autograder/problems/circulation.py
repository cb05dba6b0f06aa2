"""Construction of problems with short answers: choose the answer, read off the data.

At the least-squares state the forces y = Omega f satisfy J^T y = 0: at every pose they cancel, as
currents do at a node of a circuit. So they run round the loops. Choose the state x1, the variances
v and one force for each loop; the force of an edge is the sum of those of the loops that it lies
on, with signs, the prior's force is 0, and

    u_ij = x1_j - x1_i + v_ij y_ij .

For fixed variances (x1, forces) <-> data is one to one, so no short problem is missed. Every number
is a whole number of grains (hundredths, where two decimals are asked for) until the very end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from autograder.problems.band import Band
from autograder.problems.exact import ExactGraph
from autograder.problems.stream import Stream

__all__ = ["Circulation", "Draw", "Pairs", "rounds_of"]

Pairs = tuple[tuple[int, int], ...]
PRIOR_VARIANCE = Fraction(1, 1000)
ATTEMPTS = 100_000
PRINTED = 300  # H[3, 3] as the source of the worked example misprints it: here it must not be right by accident


@dataclass(frozen=True)
class Draw:
    """One problem with its answer: what a family draws from a stream.

    `attempts` counts the trials that the filters let through or not, this one included.
    """

    graph: ExactGraph
    x1: tuple[Fraction, ...]
    truth: tuple[Fraction, ...]
    attempts: int = 1


@dataclass(frozen=True)
class Circulation:
    """What is fixed for a family, and from what the rest is drawn.

    Parameters
    ----------
    tree : tuple of pairs
        Edges that dead reckoning walks, in its order from pose 0: n - 1 of them.
    loops : tuple of pairs
        Edges that close a loop each.
    band : Band
        Limits that a draw must keep.
    steps : tuple of int
        True displacements along the edges of the tree [m].
    offsets : tuple of int
        Answer minus truth, for every pose but the first [tenths of a metre]; less than half a metre,
        so that rounding the answer recovers the truth and different draws are different data.
    variances : tuple of int
        Variances of the edges [hundredths of a square metre].
    half_forces : tuple of int
        Forces of the loops, in halves [1/(2 m)].
    prior_means : tuple of Fraction
        Means of the prior on pose 0 [m].
    equal_variances : bool
        Whether one variance serves all edges.
    """

    tree: Pairs
    loops: Pairs
    band: Band
    steps: tuple[int, ...]
    offsets: tuple[int, ...]
    variances: tuple[int, ...]
    half_forces: tuple[int, ...]
    prior_means: tuple[Fraction, ...]
    equal_variances: bool = False

    @property
    def raw_count(self) -> int:
        """Number of different data before any filter: the base of the counting argument."""
        free = len(self.tree)
        variances = 1 if self.equal_variances else len(self.tree) + len(self.loops)
        states = (len(self.steps) * len(self.offsets)) ** free * len(self.prior_means)
        weights = len(self.variances) ** variances * len(self.half_forces) ** len(self.loops)
        return int(states * weights)

    @cached_property
    def _limits(self) -> tuple[int, int]:
        """Limits of chi-squared in 1/400: whole numbers, so that a trial is judged in whole numbers."""
        low, high = self.band.chi_squared
        return math.ceil(low * 400), math.floor(high * 400)

    def draw(self, stream: Stream) -> Draw:
        """Draw until a problem passes every filter.

        A trial that fails is thrown away as a whole, so all problems that pass are equally likely.

        Raises
        ------
        ValueError
            Where no trial passes: the limits of the family contradict one another.
        """
        rounds = rounds_of(self.tree, self.loops)
        for attempt in range(1, ATTEMPTS + 1):
            weights = self._weights(stream, rounds)
            if weights is None:
                continue
            drops, variances = weights
            found = self._state(stream, drops, variances)
            if found is not None:
                return Draw(*found, attempts=attempt)
        raise ValueError(f"the limits of a family must leave a problem, got none in {ATTEMPTS} trials")

    def _weights(self, stream: Stream, rounds: list[list[tuple[int, int]]]) -> tuple[list[int], list[int]] | None:
        """Draw variances and forces; return v * y of every edge in grains, and v in hundredths."""
        edges = len(self.tree) + len(self.loops)
        if self.equal_variances:
            variances = [stream.pick(self.variances)] * edges
        else:
            variances = stream.picks(self.variances, edges)
        forces = [0] * edges
        for loop, (path, force) in enumerate(zip(rounds, stream.picks(self.half_forces, len(rounds)), strict=True)):
            forces[len(self.tree) + loop] = force
            for row, sign in path:
                forces[row] -= sign * force
        if not self.equal_variances:
            for loop, path in enumerate(rounds):
                closing = variances[len(self.tree) + loop]
                if closing == variances[0] or len({closing, *(variances[row] for row, _ in path)}) < min(3, len(path)):
                    return None
        squares = [v * y * y for v, y in zip(variances, forces, strict=True)]  # residual^2 / variance, in 1/400
        low, high = self._limits
        if max(squares) > 3600 or not low <= sum(squares) <= high:
            return None
        if sum(map(bool, forces)) != self.band.products:
            return None
        scale = 10**self.band.decimals
        drops = [v * y * scale for v, y in zip(variances, forces, strict=True)]
        if any(drop % 200 for drop in drops) or self._information(3, variances) == PRINTED:
            return None
        return [drop // 200 for drop in drops], variances

    def _state(
        self, stream: Stream, drops: list[int], variances: list[int]
    ) -> tuple[ExactGraph, tuple[Fraction, ...], tuple[Fraction, ...]] | None:
        """Draw truth and answer; return the problem where it passes the filters."""
        grain = 10**self.band.decimals
        size = len(self.tree) + 1
        mean = stream.pick(self.prior_means)
        truth, x1, start = [0] * size, [0] * size, [0] * size
        truth[0] = x1[0] = start[0] = math.floor(mean * grain)
        steps, offsets = stream.picks(self.steps, size - 1), stream.picks(self.offsets, size - 1)
        for (i, j), step, offset, drop in zip(self.tree, steps, offsets, drops, strict=False):
            truth[j] = truth[i] + step * grain
            x1[j] = truth[j] + offset * grain // 10
            start[j] = start[i] + x1[j] - x1[i] + drop
        edges = self.tree + self.loops
        u = [x1[j] - x1[i] + drop for (i, j), drop in zip(edges, drops, strict=True)]
        low, high = self.band.long_numbers
        if not all(u) or not low <= sum(1 for value in u if value % 10) <= high:
            return None
        if len(set(u[len(self.tree) :])) < len(self.loops):
            return None
        moved = [x1[j] - start[j] for (_, j), drop in zip(self.tree, drops, strict=False) if drop]
        if 0 in moved or len(set(moved)) < len(moved):
            return None
        if not self._telling(u, x1, start):
            return None
        graph = ExactGraph(
            n_poses=size,
            edges=edges,
            measurements=tuple(Fraction(value, grain) for value in u),
            edge_variances=tuple(Fraction(v, 100) for v in variances),
            priors=(0,),
            prior_means=(mean,),
            prior_variances=(PRIOR_VARIANCE,),
        )
        return graph, tuple(Fraction(x, grain) for x in x1), tuple(Fraction(x, grain) for x in truth)

    def _information(self, pose: int, variances: list[int]) -> Fraction:
        """Add up the information of the edges at a pose: the diagonal entry of H there [1/m^2]."""
        edges = zip(self.tree + self.loops, variances, strict=True)
        return sum((Fraction(100, v) for pair, v in edges if pose in pair), Fraction(0))

    def _telling(self, u: list[int], x1: list[int], start: list[int]) -> bool:
        """Whether no known mistake can be right by accident.

        A residual without its sign shows where a row of f is negative, so where a mismatch is
        positive; rounding to one decimal, where a mismatch has two; a loop taken to span the whole
        chain, where the chain has another length; a free shift of all poses, where they do not move
        by 0 on average.
        """
        spans = [start[j] - start[i] for i, j in self.loops]
        mismatches = [span - z for span, z in zip(spans, u[len(self.tree) :], strict=True)]
        if 0 in mismatches or max(mismatches) < 0 or sum(x1) == sum(start):
            return False
        tenth = 10 ** (self.band.decimals - 1)
        if self.band.decimals > 1 and not any(mismatch % tenth for mismatch in mismatches):
            return False
        whole = (0, len(self.tree))
        return all(span != start[-1] - start[0] for span, loop in zip(spans, self.loops, strict=True) if loop != whole)


def rounds_of(tree: Pairs, loops: Pairs) -> list[list[tuple[int, int]]]:
    """List for each loop the tree edges under it: (row, +1 walked forwards or -1 backwards).

    Parameters
    ----------
    tree : tuple of pairs
        Edges (i, j), each of which leads from a pose that is reached to a new one; pose 0 is reached.
    loops : tuple of pairs
        Edges (i, j) between poses that are reached.

    Examples
    --------
    >>> rounds_of(((0, 1), (1, 2), (0, 3)), ((1, 3),))
    [[(0, -1), (2, 1)]]
    """
    path: dict[int, dict[int, int]] = {0: {}}
    for row, (i, j) in enumerate(tree):
        path[j] = path[i] | {row: 1}
    found = []
    for i, j in loops:
        signs = {row: path[j].get(row, 0) - path[i].get(row, 0) for row in path[i].keys() | path[j].keys()}
        found.append(sorted((row, sign) for row, sign in signs.items() if sign))
    return found

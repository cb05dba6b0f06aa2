"""The page that solves a variant by hand, in whole numbers: for staff, and for students afterwards.

Lengths are counted in the variant's smallest unit (centimetres, where it has two decimals) and
variances in hundredths of a square metre, so that nothing but small integers is left.
"""

from __future__ import annotations

from fractions import Fraction

from autograder.problems.exact import decimal
from autograder.problems.families import family as family_of
from autograder.problems.loops import LoopSolution, solve_by_loops
from autograder.problems.variants import Variant

__all__ = ["hand_solution"]


def hand_solution(variant: Variant) -> str:
    """Write the solution of a variant by its loops, and the check H dx = -b, as Markdown.

    Parameters
    ----------
    variant : Variant
        Of a family whose loops follow the tree that dead reckoning walks: all of ours.

    Returns
    -------
    str
        The page.
    """
    solved = solve_by_loops(variant.exact)
    if solved.x1 != variant.x1:
        raise ValueError(f"the loops and the normal equations must agree, got {solved.x1} for {variant.identifier}")
    parts = [
        f"# Solution by hand: variant {variant.identifier}",
        _data(variant),
        _mismatch(variant, solved),
        _force(variant, solved),
        _edges(variant, solved),
        _state(variant),
        _check(variant),
    ]
    return "\n\n".join(parts) + "\n"


def _scale(variant: Variant) -> int:
    return int(max(100, 10 ** family_of(variant.family).band.decimals))


def _data(variant: Variant) -> str:
    graph = variant.exact
    rows = [
        [str(row), f"{i} → {j}", decimal(u), decimal(v), decimal(1 / v)]
        for row, ((i, j), u, v) in enumerate(zip(graph.edges, graph.measurements, graph.edge_variances, strict=True))
    ]
    mean, variance = graph.prior_means[0], graph.prior_variances[0]
    rows.append([str(len(rows)), "prior on 0", decimal(mean), decimal(variance), decimal(1 / variance)])
    return (
        "## What was measured\n\n"
        + _table(["row", "edge", "u [m]", "variance [m²]", "information [1/m²]"], rows)
        + f"\n\nDead reckoning adds the measurements up from the prior's mean: x⁽⁰⁾ = {_vector(variant.x0)}."
        + "\nThere every residual is 0 but those of the loops."
    )


def _mismatch(variant: Variant, solved: LoopSolution) -> str:
    x0 = variant.x0
    lines = ["## 1. Mismatch: what dead reckoning says of the loop, minus what was measured\n"]
    for name, (i, j), z, e in zip(
        _names(solved, "e"), _loops(variant), _closing(variant), solved.mismatches, strict=True
    ):
        says = f"({decimal(x0[j])}) − ({decimal(x0[i])})"
        lines.append(f"- Loop {i} → {j}: {name} = {says} − ({decimal(z)}) = **{decimal(e)} m**")
    return "\n".join(lines)


def _force(variant: Variant, solved: LoopSolution) -> str:
    graph, scale = variant.exact, _scale(variant)
    size = graph.n_poses - 1
    lines = ["## 2. Variance round the loop\n"]
    names = _names(solved, "V")
    for loop, (name, path) in enumerate(zip(names, solved.rounds, strict=True)):
        terms = [graph.edge_variances[row] for row, _ in path] + [graph.edge_variances[size + loop]]
        total = solved.matrix[loop][loop]
        lines.append(f"- {name} = {' + '.join(decimal(term) for term in terms)} = **{decimal(total)} m²**")
    for a in range(len(names)):
        for b in range(a):
            shared = [row for row, _ in solved.rounds[b] if row in dict(solved.rounds[a])]
            rows = ", ".join(map(str, shared)) or "none"
            lines.append(f"- shared by loops {b + 1} and {a + 1} (rows {rows}): S = {decimal(solved.matrix[a][b])} m²")
    lines.append("\n## 3. Force of the loop\n")
    whole = [_whole(e, scale) for e in solved.mismatches]
    if len(names) == 1:
        V = _whole(solved.matrix[0][0], scale)
        lines.append(
            f"q = e / V = {decimal(solved.mismatches[0])} / {decimal(solved.matrix[0][0])}"
            f" = {whole[0]} / {V} = **{decimal(solved.forces[0])} per metre**"
        )
        return "\n".join(lines)
    lines.append(f"Each loop feels the forces of all that share edges with it: R q = e, times {scale}:\n")
    for loop, row in enumerate(solved.matrix):
        left = " + ".join(f"({_whole(entry, scale)}) q{_low(k)}" for k, entry in enumerate(row))
        lines.append(f"    {left} = {whole[loop]}")
    if len(names) == 2:
        (first, shared_variance), (_, second) = [[_whole(entry, scale) for entry in row] for row in solved.matrix]
        det = first * second - shared_variance * shared_variance
        top = second * whole[0] - shared_variance * whole[1], first * whole[1] - shared_variance * whole[0]
        lines += [
            "",
            f"Determinant: ({first})({second}) − ({shared_variance})² = {det}.",
            "",
            f"- q₁ = (({second})({whole[0]}) − ({shared_variance})({whole[1]})) / {det} = {top[0]} / {det}",
            f"- q₂ = (({first})({whole[1]}) − ({shared_variance})({whole[0]})) / {det} = {top[1]} / {det}",
        ]
    values = ", ".join(f"q{_low(k)} = {decimal(q)}" for k, q in enumerate(solved.forces))
    return "\n".join([*lines, "", f"So **{values}** (per metre)."])


def _edges(variant: Variant, solved: LoopSolution) -> str:
    graph = variant.exact
    size = graph.n_poses - 1
    rows = []
    for row, ((i, j), u, v) in enumerate(zip(graph.edges, graph.measurements, graph.edge_variances, strict=True)):
        if row < size:
            over = [(sign, k) for k, path in enumerate(solved.rounds) for edge, sign in path if edge == row]
        else:
            over = [(-1, row - size)]
        shorter = solved.corrections[row]
        product = " ".join(f"{'+' if sign > 0 else '−'} {decimal(v)} · q{_low(k, solved)}" for sign, k in over) or "0"
        rows.append([f"{i} → {j}", decimal(u), product.removeprefix("+ "), decimal(shorter), decimal(u - shorter)])
    return (
        "## 4. Shorten each edge under a loop by variance × force\n\n"
        "A loop closure itself becomes longer by as much; an edge under no loop stays.\n\n"
        + _table(["edge", "u [m]", "shorter by", "[m]", "new length [m]"], rows)
    )


def _state(variant: Variant) -> str:
    return (
        "## 5. Add up again\n\n"
        f"- x⁽¹⁾ = **{_vector(variant.x1)}**\n"
        f"- Δx = x⁽¹⁾ − x⁽⁰⁾ = {_vector(variant.step)}\n"
        f"- The second step is 0: x⁽²⁾ = x⁽³⁾ = x⁽¹⁾, because f is affine in x."
    )


def _check(variant: Variant) -> str:
    scale = _scale(variant)
    H, b = variant.exact.normal_equations(variant.x0)
    dx = [_whole(entry, scale) for entry in variant.step]
    rows = []
    for k, (row, entry) in enumerate(zip(H, b, strict=True)):
        terms = [f"({decimal(h)})({d})" for h, d in zip(row, dx, strict=True) if h and d]
        total = sum((h * d for h, d in zip(row, dx, strict=True)), Fraction(0))
        if total != -entry * scale:
            raise ValueError(f"H dx = -b must hold, got {total} and {-entry * scale} in row {k}")
        rows.append([str(k), " + ".join(terms) or "0", decimal(total), decimal(-entry * scale)])
    entries = [[decimal(entry) for entry in row] for row in H]
    width = max(len(entry) for row in entries for entry in row)
    matrix = "\n".join("    " + "  ".join(entry.rjust(width) for entry in row) for row in entries)
    return (
        f"## 6. Check H Δx = −b\n\nH:\n\n{matrix}\n\nb at x⁽⁰⁾: {_vector(b)}\n\n"
        f"With Δx in 1/{scale} of a metre everything is a whole number:\n\n"
        + _table(["row", f"H · {scale} Δx", "=", f"−{scale} b"], rows)
    )


def _loops(variant: Variant) -> tuple[tuple[int, int], ...]:
    return variant.exact.edges[variant.exact.n_poses - 1 :]


def _closing(variant: Variant) -> tuple[Fraction, ...]:
    return variant.exact.measurements[variant.exact.n_poses - 1 :]


def _whole(value: Fraction, scale: int) -> int | Fraction:
    scaled = value * scale
    return scaled.numerator if scaled.denominator == 1 else scaled


def _low(index: int, solved: LoopSolution | None = None) -> str:
    """Write the number of a loop below the line; nothing where there is only one."""
    if solved is not None and len(solved.forces) == 1:
        return ""
    return "".join("₀₁₂₃₄₅₆₇₈₉"[int(digit)] for digit in str(index + 1))


def _names(solved: LoopSolution, letter: str) -> list[str]:
    return [letter + _low(k, solved) for k in range(len(solved.forces))]


def _vector(values: tuple[Fraction, ...] | list[Fraction]) -> str:
    return "(" + ", ".join(decimal(value) for value in values) + ")"


def _table(headings: list[str], rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(cells) + " |" for cells in (headings, ["---"] * len(headings), *rows)]
    return "\n".join(lines)

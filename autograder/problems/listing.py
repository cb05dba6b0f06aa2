"""One student's variant as text: the data for everybody, the answers for staff."""

from __future__ import annotations

from fractions import Fraction

from autograder.problems.conclusion import CHOICES
from autograder.problems.exact import decimal
from autograder.problems.variants import Variant

__all__ = ["RIGHT_CHOICE", "describe", "key_columns", "key_row"]

RIGHT_CHOICE = "linear"


def describe(variant: Variant, *, picture: str = "", answers: bool = False) -> str:
    """Show a variant on a terminal.

    Parameters
    ----------
    variant : Variant
        The variant.
    picture : str
        A drawing of the graph in text, put above the data.
    answers : bool
        Whether to show what only staff may see.
    """
    rows = str(variant.graph).split("\n", 1)[1]
    marks = f" (landmarks: {', '.join(f'x{k}' for k in variant.landmarks)})" if variant.landmarks else ""
    parts = [f"Variant {variant.identifier} of {variant.student_id}, family {variant.family}{marks}"]
    parts += [picture] if picture else []
    parts += [rows, f"  start x^(0) = {_vector(variant.x0)}"]
    if answers:
        f = variant.exact.residual(variant.x1)
        parts.append(
            f"  truth       = {_vector(variant.truth)}\n"
            f"  dx          = {_vector(variant.step)}\n"
            f"  x^(1)       = {_vector(variant.x1)}  (and every further iterate)\n"
            f"  f(x^(1))    = {_vector(f)}\n"
            f"  chi-squared = {decimal(_chi_squared(variant, variant.x0))} at x^(0),"
            f" {decimal(_chi_squared(variant, variant.x1))} at x^(1)\n"
            f"  conclusion  = {right_letter(variant)}"
        )
    return "\n".join(parts)


def right_letter(variant: Variant) -> str:
    """Return the letter of the right choice in the variant's order."""
    return next(choice.letter for choice in variant.choices if choice.identifier == RIGHT_CHOICE)


def key_columns() -> tuple[str, ...]:
    """Return the headings of the staff's table of answers."""
    return ("student_id", "variant", "x0", "dx", "x1", "conclusion")


def key_row(variant: Variant) -> tuple[str, ...]:
    """Return a variant's answers as they stand in the staff's table; vectors are separated by blanks."""
    vectors = (" ".join(map(decimal, values)) for values in (variant.x0, variant.step, variant.x1))
    return (variant.student_id, variant.identifier, *vectors, right_letter(variant))


def _chi_squared(variant: Variant, x: tuple[Fraction, ...]) -> Fraction:
    graph = variant.exact
    variances = graph.edge_variances + graph.prior_variances
    return sum((r * r / v for r, v in zip(graph.residual(x), variances, strict=True)), Fraction(0))


def _vector(values: tuple[Fraction, ...]) -> str:
    return "(" + ", ".join(decimal(value) for value in values) + ")"


if RIGHT_CHOICE not in CHOICES:
    raise ValueError(f"the right choice must be one of {', '.join(CHOICES)}, got {RIGHT_CHOICE!r}")

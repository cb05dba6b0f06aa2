"""What a wrong cell of an audit means, in words."""

from __future__ import annotations

from autograder.audit.expectation import CAUGHT, KEPT, Cell

_SHARE = "+follow_through"


def meaning(cell: Cell) -> str:
    """Say what is wrong with a cell; "" where nothing is.

    Examples
    --------
    >>> meaning(Cell("jacobian", "caught:jacobian_transposed", "caught"))
    'caught, not named as itself'
    >>> meaning(Cell("residual", "passed", "failed"))
    'a right answer loses points'
    >>> meaning(Cell("remarks", "lists rows", "rows columns"))
    'the remark lists is missing; the remark columns is too much'
    """
    if cell.right:
        return ""
    if cell.stage == "remarks":
        return _remarks(set(cell.expected.split()) - {"none"}, set(cell.got.split()) - {"none"})
    if cell.fault == "miss":
        return "a wrong answer passes"
    if cell.fault == "false alarm":
        return "a mistake elsewhere costs points here" if cell.expected == KEPT else "a right answer loses points"
    return _misjudged(cell.expected, cell.got)


def _misjudged(expected: str, got: str) -> str:
    (wanted, slip), (status, named) = _parts(expected), _parts(got)
    if wanted != status:
        return f"the outcome is {status}, not {wanted}"
    if slip != named:
        found = "caught" if wanted == CAUGHT else wanted
        if not named:
            return f"{found}, not named as itself"
        return f"{found}, named {named}" + (f" instead of {slip}" if slip else ", where no name fits")
    return "the follow-through share is " + ("not paid" if expected.endswith(_SHARE) else "paid")


def _parts(text: str) -> tuple[str, str]:
    """Split a cell into status and name of the mistake."""
    status, _, slip = text.removesuffix(_SHARE).partition(":")
    return status, slip


def _remarks(wanted: set[str], came: set[str]) -> str:
    missing = [f"the remark {kind} is missing" for kind in sorted(wanted - came)]
    return "; ".join(missing + [f"the remark {kind} is too much" for kind in sorted(came - wanted)])

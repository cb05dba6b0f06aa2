"""Turns a slip into the text of a submission that is right but for this one mistake."""

from __future__ import annotations

import inspect
import itertools

from autograder.stages.base import Slip
from reference_solution import slam1d

FUNCTIONS = ("residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step")


def submission_text(slip: Slip, function: str) -> str:
    """Write the reference solution with one function replaced by the slip.

    The other functions call the wrong one, as they would in the file of a student.

    Parameters
    ----------
    slip : Slip
        One entry of the catalogue. Its function uses `np`, `right` and its own name, nothing else.
    function : str
        Name of the function of the submission that it replaces.

    Returns
    -------
    str
        Python source that stands by itself.

    Examples
    --------
    >>> from autograder.stages.slips.jacobian import SLIPS
    >>> text = submission_text(SLIPS[0], "jacobian")
    >>> text.splitlines()[-1]
    'jacobian = jacobian_of_worked_example'
    """
    lines = inspect.getsource(slip.function).splitlines()
    body = itertools.dropwhile(lambda line: not line.startswith("def "), lines)
    rights = ", ".join(f"{name}={name}" for name in FUNCTIONS)
    return "\n".join(
        [
            inspect.getsource(slam1d),
            "",
            "from types import SimpleNamespace",
            "",
            f"right = SimpleNamespace({rights})",
            "",
            "",
            *body,
            "",
            "",
            f"{function} = {slip.identifier}",
            "",
        ]
    )

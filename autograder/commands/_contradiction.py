"""Uploads say which variant they are of: where a run would judge a class on others, it stops and says so."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from autograder.intake.submission import Submission
    from autograder.problems.ledger import Ledger

_TRY = "Give the --ledger of the release, or its --roster, --term, --secret-file and --course or --family"


def check_variants(submissions: Sequence[Submission], ledger: Ledger | None, *, anyway: bool) -> str:
    """Return a note on uploads of variants that nobody was given; "" where there is none.

    Parameters
    ----------
    submissions : sequence of Submission
        All uploads.
    ledger : Ledger or None
        Who got which numbers; None where everybody is judged on the worked example.
    anyway : bool
        Go on.

    Raises
    ------
    UsageError
        Where at least half of those who carry a variant carry one that is not on record: then it is not the
        students who are wrong.
    """
    from autograder.errors import UsageError
    from autograder.problems.variants import published

    example = published().identifier
    known = {example, *(variant.identifier for variant in ledger or ())}
    carrying = [one for one in submissions if one.variant and one.variant != example]
    strange = [one for one in carrying if one.variant not in known]
    if not strange:
        return ""
    told = (
        f"{len(strange)} of {len(carrying)} uploads with numbers of their own carry a variant that "
        f"{'nobody of this class was given' if ledger is not None else 'is not known without a ledger'} "
        f"(the first is {strange[0].id}, {strange[0].variant})"
    )
    if anyway or 2 * len(strange) < len(carrying):
        return f"{told}; they are judged on other numbers."
    raise UsageError(f"{told}; nothing was graded. {_TRY}; --anyway goes on.")

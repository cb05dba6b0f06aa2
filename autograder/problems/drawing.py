"""The variants of a whole class: drawn in the same way for a release and, without its ledger, for grading."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping

from autograder.errors import UsageError
from autograder.problems.families import family as family_of
from autograder.problems.ledger import Ledger
from autograder.problems.secret import Secret
from autograder.problems.variants import Variant, choose_family

__all__ = ["checked_mix", "draw_class"]


def checked_mix(mix: Mapping[str, int]) -> dict[str, int]:
    """Bring the families of a mix to their labels, and add up the weights of equal ones.

    Raises
    ------
    UsageError
        Where a family is unknown, or none has a positive weight.

    Examples
    --------
    >>> checked_mix({"unequal-variances": 1, "A": 2})
    {'A': 3}
    """
    labels: Counter[str] = Counter()
    for text, weight in mix.items():
        labels[family_of(text).label] += weight
    if not labels or min(labels.values()) < 0 or sum(labels.values()) < 1:
        raise UsageError(f"The mix of families is {dict(mix)}; expected at least one family with a positive weight.")
    return dict(labels)


def draw_class(
    ledger: Ledger,
    student_ids: Iterable[str],
    secret: Secret,
    term: str,
    mix: Mapping[str, int],
    *,
    accept: Callable[[Variant], bool] | None = None,
    tally: Counter[str] | None = None,
    on_draw: Callable[[int, int, str], None] | None = None,
) -> None:
    """Enter a variant for everybody who has none yet.

    Parameters
    ----------
    ledger : Ledger
        What was drawn before; it is added to.
    student_ids : iterable of str
        The class, in any order.
    secret, term
        What the variants depend on.
    mix : mapping
        Label of a family -> weight.
    accept : callable, optional
        A further demand on a variant.
    tally : Counter, optional
        Counts draws that were thrown away, by reason.
    on_draw : callable, optional
        Called with (done, total, student id) after every draw.
    """
    labels = checked_mix(mix)
    wanted = {name: choose_family(secret, term, name, labels) for name in student_ids if name not in ledger}
    for count, name in enumerate(sorted(wanted), 1):
        ledger.extend(secret, term, {name: wanted[name]}, accept=accept, tally=tally)
        if on_draw is not None:
            on_draw(count, len(wanted), name)

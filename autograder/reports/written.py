"""The written answers of the class on one page, side by side, with the marking guide: for reading offline."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files

from markupsafe import Markup

from autograder.marking.answers import Answer
from autograder.reports.html import page
from autograder.reports.prose import prose

_GUIDE = "## Marking guide"


@dataclass(frozen=True)
class Side:
    """One answer, ready for the page."""

    answer: Answer
    words: Markup


def written_page(answers: Sequence[Answer], course: str = "1D SLAM", guide: str = "", anonymous: bool = False) -> str:
    """Write the page.

    Parameters
    ----------
    answers : sequence of Answer
        What there is to read.
    course : str
        Title of the homework.
    guide : str
        Marking guide as markdown; "" for that of the worked solution.
    anonymous : bool
        Whether the names on it tell nothing.
    """
    by_name: dict[str, list[Side]] = {}
    for one in sorted(answers, key=lambda one: (one.name, one.question)):
        by_name.setdefault(one.name, []).append(Side(one, prose(one.text, one.images)))
    maxima = {one.question: one.most for one in answers}
    return page(
        "written.html.j2",
        course=course,
        guide=prose(guide or default_guide()),
        people=list(by_name.items()),
        maxima=sorted(maxima.items()),
        waiting=sum(one.mark is None for one in answers),
        count=len(answers),
        anonymous=anonymous,
    )


def default_guide() -> str:
    """Return the marking guide of the worked solution, as markdown without its heading."""
    text = (files("reference_solution") / "SOLUTION.md").read_text(encoding="utf-8")
    _, _, rest = text.partition(f"{_GUIDE}\n")
    return rest.partition("\n## ")[0].strip()

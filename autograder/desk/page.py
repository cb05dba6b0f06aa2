"""The page of one answer on the desk: the answer, the guide, and a form that the keyboard fills in."""

from __future__ import annotations

from autograder.desk.beside import beside
from autograder.desk.guide import guide_points, with_letters
from autograder.desk.pile import Pile
from autograder.reports.html import hash_of, page
from autograder.reports.prose import prose
from autograder.reports.written import default_guide


def answer_page(pile: Pile, index: int, course: str, guide: str) -> str:
    """Write the page of one answer."""
    answer = pile[index] if len(pile) else None
    reported = None if answer is None else answer.reported
    guide = with_letters(guide or default_guide(), {} if reported is None else reported.letters)
    return page(
        "desk.html.j2",
        course=course,
        answer=answer,
        earned=[] if answer is None else guide_points(guide, answer.question, answer.most),
        used=[] if answer is None else pile.used(answer.question),
        alike=[pile[other] for other in pile.alike(index) if other != index] if answer is not None else [],
        beside=beside(reported),
        words=prose(answer.text, answer.images) if answer is not None else "",
        guide=prose(guide),
        number=index + 1,
        count=len(pile),
        waiting=pile.waiting,
        before=index if index > 0 else len(pile),
        after=index + 2 if index + 1 < len(pile) else 1,
    )


def content_policy() -> str:
    """Return the policy that every answer of the server carries."""
    return (
        f"default-src 'none'; img-src data:; style-src {hash_of('style.css')}; script-src {hash_of('desk.js')}; "
        "connect-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'"
    )

"""The page of one answer on the desk: the answer, the guide, and a form that the keyboard fills in."""

from __future__ import annotations

from autograder.desk.pile import Pile
from autograder.reports.html import hash_of, page
from autograder.reports.prose import prose
from autograder.reports.written import default_guide


def answer_page(pile: Pile, index: int, course: str, guide: str) -> str:
    """Write the page of one answer."""
    answer = pile[index] if len(pile) else None
    return page(
        "desk.html.j2",
        course=course,
        answer=answer,
        words=prose(answer.text, answer.images) if answer is not None else "",
        guide=prose(guide or default_guide()),
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

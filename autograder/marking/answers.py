"""The written answers of a class, in order: what there is to read, and what has been given for it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from autograder.course import Course
from autograder.marking.marks import Mark, Marks
from autograder.marking.merging import WRITTEN, is_current, question_maxima
from autograder.verdicts import Reported, Result


@dataclass(frozen=True)
class Answer:
    """One answer to one question.

    Parameters
    ----------
    submission, question : str
        Which answer.
    name : str
        The name to show: the submission's, or one that tells nothing.
    text : str
        Markdown, as the student wrote it.
    images : mapping of str to str
        Pictures in it, as data URIs.
    most : float
        Points of the question.
    mark : Mark or None
        What a reader gave for these very words.
    stale : bool
        Whether it was marked, and has changed since.
    variant : str
        The variant on record.
    reported : Reported or None
        The student's other answers, beside what is right.
    """

    submission: str
    question: str
    name: str
    text: str
    images: Mapping[str, str]
    most: float
    mark: Mark | None = None
    stale: bool = False
    variant: str = ""
    reported: Reported | None = None


def answers(
    results: Sequence[Result], marks: Marks, course: Course, names: Mapping[str, str] | None = None
) -> list[Answer]:
    """List the answers with words in them, by question and then by the name that is shown."""
    found = []
    for result in results:
        stage = next((stage for stage in result.stages if stage.name == WRITTEN), None)
        if stage is None or WRITTEN not in course.stages:
            continue
        for question, most in question_maxima(course, course.points[WRITTEN]).items():
            text = result.written.get(question, "")
            if text.strip():
                mark = marks.get((result.submission, question))
                current = mark is not None and is_current(mark, text)
                name = result.submission if names is None else names[result.submission]
                found.append(
                    Answer(
                        result.submission,
                        question,
                        name,
                        text,
                        result.images,
                        most,
                        mark if current else None,
                        mark is not None and not current,
                        result.variant,
                        result.reported,
                    )
                )
    return sorted(found, key=lambda one: (one.question, one.name))

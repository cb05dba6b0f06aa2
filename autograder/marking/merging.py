"""What every report and export shows: the machine's verdicts, with what people and the course's rules made of them.

Results on disk keep what the machine said; the rest is put on top of it here, the same for every reader.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec.structs import replace

from autograder.course import BONUS, Course
from autograder.marking.lateness import days_late, penalised, unknown_time
from autograder.marking.marks import Mark, Marks, digest
from autograder.marking.overrides import TOTAL, Override, whose
from autograder.marking.repointing import repointed
from autograder.verdicts import Adjustment, Result, StageStatus, StageVerdict

WRITTEN = "written"


def merged(
    results: Iterable[Result],
    marks: Marks | None = None,
    overrides: Sequence[Override] = (),
    course: Course | None = None,
) -> tuple[Result, ...]:
    """Merge machine verdicts with marks, overrides and the rules of the course.

    In this order: the course's points, marks of written answers, overrides of stages, the late rule,
    overrides of the total.

    Parameters
    ----------
    results : iterable of Result
        As the machine stored them.
    marks : mapping of (submission, question) to Mark
        Of written answers.
    overrides : sequence of Override
        By hand.
    course : Course
        Points and rules; without one the points stay as they are stored.
    """
    results = tuple(results)
    course = course or Course()
    graded = {stage.name for result in results for stage in result.stages} & set(course.stages)
    maximum = sum(course.points[name] for name in graded - BONUS) if graded else course.max_score
    mine = whose(overrides, results)
    return tuple(_merged(one, marks or {}, mine.get(one.submission, ()), course, maximum) for one in results)


def question_maxima(course: Course, whole: float) -> dict[str, float]:
    """Return the points of each question where their stage has `whole` points.

    Examples
    --------
    >>> question_maxima(Course(), 10.0)
    {'2': 4.0, '3': 6.0}
    """
    unit = sum(course.question_points.values())
    return {name: round(whole * value / unit, 6) if unit else 0.0 for name, value in course.question_points.items()}


def is_current(mark: Mark, answer: str) -> bool:
    """Whether a mark is for these words; a mark without a digest is for any."""
    return not mark.answer or mark.answer == digest(answer)


def _merged(result: Result, marks: Marks, overrides: Sequence[Override], course: Course, maximum: float) -> Result:
    stages = [repointed(stage, course) for stage in result.stages if stage.name in course.stages]
    adjustments: list[Adjustment] = []
    awaiting = sum(stage.max_score for stage in stages if stage.status == "awaiting_mark")
    comments: dict[str, str] = {}
    for index, stage in enumerate(stages):
        if stage.name == WRITTEN and result.written:
            stages[index], awaiting, comments = _marked(result, stage, marks, course)
    for one in overrides:
        for index, stage in enumerate(stages):
            if stage.name == one.stage:
                awaiting = 0.0 if stage.name == WRITTEN else awaiting
                stages[index] = _overridden(stage, one)
                adjustments.append(_adjustment(one, stage.score))
    score = result.score
    bonus = sum(stage.score for stage in stages if stage.bonus)
    if score is not None and result.status == "graded":
        score = round(min(sum(stage.score for stage in stages), max(course.bonus_cap, maximum)), 6)
    flags = list(result.flags)
    if score is not None:
        after, said = penalised(score, days_late(result, course), course, maximum)
        if said and after != score:
            adjustments.append(Adjustment(stage="", before=score, after=after, said=said))
            score = after
        if doubt := unknown_time(result, course):
            flags.append(doubt)
    for one in overrides:
        if one.stage == TOTAL:
            adjustments.append(_adjustment(one, score))
            score, awaiting = one.points, 0.0
    return replace(
        result,
        stages=tuple(stages),
        score=score,
        max_score=float(maximum),
        bonus=float(bonus),
        awaiting=awaiting,
        provisional=awaiting > 0,
        comments=comments,
        adjustments=tuple(adjustments),
        flags=tuple(flags),
    )


def _marked(
    result: Result, stage: StageVerdict, marks: Marks, course: Course
) -> tuple[StageVerdict, float, dict[str, str]]:
    """Put the reader's marks into the stage; return it with the points that still wait and the comments.

    As long as nobody has read anything the whole stage waits, an answer that is not there included.
    """
    earned = waiting = 0.0
    told, comments, read = [], {}, False
    for question, most in question_maxima(course, stage.max_score).items():
        answer = result.written.get(question, "")
        mark = marks.get((result.submission, question))
        if not answer.strip():
            told.append(f"question {question}: no answer")
        elif mark is None:
            waiting += most
        elif not is_current(mark, answer):
            waiting += most
            told.append(f"question {question}: the answer has changed since it was marked")
        else:
            points = mark.points if not mark.of else mark.points * most / mark.of
            earned, read = earned + points, True
            told.append(f"question {question}: {round(points, 6):g} of {most:g}")
            if mark.comment:
                comments[question] = mark.comment
    waiting = stage.max_score if waiting and not read else waiting
    earned = round(earned, 6)
    status: StageStatus
    if waiting:
        status = "awaiting_mark"
    elif abs(earned - stage.max_score) < 1e-9 and earned > 0:
        status = "passed"
    else:
        status = "partial" if earned > 0 else ("missing" if stage.status == "missing" else "failed")
    message = f"{'; '.join(told)}." if told else ""
    return replace(stage, status=status, score=earned, message=message), waiting, comments


def _overridden(stage: StageVerdict, override: Override) -> StageVerdict:
    status: StageStatus = stage.status
    if override.points >= stage.max_score:
        status = "passed"
    elif override.points > 0:
        status = "partial"
    elif status in ("passed", "partial", "awaiting_mark"):
        status = "failed"
    return replace(stage, status=status, score=override.points)


def _adjustment(override: Override, before: float | None) -> Adjustment:
    stage = "" if override.stage == TOTAL else override.stage
    was = "" if before is None else f", was {before:g}"
    said = f"{override.stage} set to {override.points:g}{was}: {override.reason} ({override.who}, {override.when})"
    return Adjustment(stage=stage, before=before, after=override.points, said=said)

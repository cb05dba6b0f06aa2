"""Which exam a run takes: the one that is named, the one that its folder keeps, or a new one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from autograder.engine.exam import Exam


def exam_for(out: Path, named: Path | None, seed: int | None, examples: int | None, *, merge: bool) -> Exam | None:
    """Return the exam to grade with; None where one has to be drawn. A change of exam is announced.

    Parameters
    ----------
    out : Path
        The folder of the results, with the exam of earlier ones in it.
    named : Path or None
        The file that was asked for.
    seed, examples : int or None
        What was asked for, on the command line or in the course file; None takes any.
    merge : bool
        Whether only some of the class are graded, so that the others keep their results.

    Raises
    ------
    UsageError
        Where an exam cannot be read, contradicts what was asked for, or would hold for some of a class only.
    """
    from autograder.commands._reporting import say
    from autograder.engine.exam import kept_exam, read_exam
    from autograder.errors import UsageError

    kept = kept_exam(out)
    exam = kept
    if named is not None:
        exam = read_exam(named)
        if seed is not None and seed != exam.seed:
            raise UsageError(f"{named} was drawn from seed {exam.seed}, and seed {seed} was asked for; leave one out.")
    elif kept is not None and not kept.asks_for(seed, examples):
        exam = None
    if kept is None or (exam is not None and exam.digest == kept.digest):
        return exam
    new = "another exam" if exam is None else str(named)
    if merge:
        raise UsageError(
            f"The results in {out} are of an exam with seed {kept.seed} and {kept.examples} cases a stage; --only "
            f"cannot grade one of the class on {new}. Leave --only out, or grade into another folder."
        )
    say(
        f"The results in {out} are of an exam with seed {kept.seed} and {kept.examples} cases a stage; "
        f"everybody is graded again, on {new}."
    )
    return exam


def shared_exam(path: Path, seed: int, examples: int, *, force: bool) -> str:
    """Draw the exam of a class into a file that its graders share; return what they should know, "" if nothing.

    An exam that is there stays: somebody may have graded with it, and another version of Hypothesis draws another.

    Raises
    ------
    UsageError
        Where the exam that is there cannot be used.
    """
    from autograder.engine.exam import draw_exam, read_exam, save_exam

    if path.exists() and not force:
        there = read_exam(path)
        if there.asks_for(seed, examples):
            return ""
        return (
            f"{path} was left, with seed {there.seed} and {there.examples} cases a stage; today it would be drawn "
            f"with seed {seed} and {examples}. --force draws it again."
        )
    save_exam(draw_exam(seed, examples), path)
    return ""

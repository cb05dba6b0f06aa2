"""Puts cases through the engine: the worker processes of a real run, without its store and its reports."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import msgspec

from autograder.course import Course
from autograder.engine.exam import Exam
from autograder.engine.local import LocalPool, default_workers
from autograder.engine.messages import Answer, Grade, Orders, Trouble
from autograder.errors import SandboxError
from autograder.sandbox.frames import Source
from autograder.stages.base import Stage
from autograder.verdicts import StageVerdict

Done = Callable[[int, int, str], None]
"""Told after every case how many are done, of how many, and which it was."""


@dataclass(frozen=True)
class Examined:
    """What the engine says of every source, in order, and the confinement that it gave."""

    verdicts: list[tuple[StageVerdict, ...]]
    confinement: str


def examine(
    sources: Sequence[Source],
    stages: Sequence[Stage],
    exam: Exam,
    course: Course,
    on_done: Done = lambda *_: None,
    workers: int | None = None,
) -> Examined:
    """Grade sources as a run does, on all cores, each in its locked child.

    Raises
    ------
    SandboxError
        Where this machine cannot confine, or the grader failed on a source, be it only in finding words.
    """
    orders = Orders(
        exam=exam.data,
        stages=tuple(stage.name for stage in stages),
        points={stage.name: course.points[stage.name] for stage in stages},
        time_limit=course.time_limit,
        memory_mib=course.memory_mib,
        output_mib=course.output_mib,
        allow_unconfined=course.min_confinement == "none",
        follow_through=course.follow_through,
    )
    found: dict[int, tuple[StageVerdict, ...]] = {}
    late: set[int] = set()

    def keep(index: int, answer: Answer) -> Grade | None:
        if isinstance(answer, Trouble):
            raise SandboxError(f"{sources[index].name} could not be judged: {answer.message}")
        if answer.unsure and index not in late:
            late.add(index)  # it ran out of time by the clock alone, and is run once more
            return Grade(sources[index], alone=True)
        if answer.flags:
            raise SandboxError(f"{sources[index].name} could not be explained: {' '.join(answer.flags)}")
        found[index] = answer.stages
        on_done(len(found), len(sources), sources[index].name)
        return None

    with LocalPool(lambda: msgspec.msgpack.encode(orders), workers or default_workers()) as pool:
        assert pool.confinement is not None  # entering the pool waits for it
        level = pool.confinement.level
        pool.run([(index, Grade(source)) for index, source in enumerate(sources)], keep)
    return Examined([found[index] for index in range(len(sources))], level)

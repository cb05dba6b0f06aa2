"""A plan as bytes: laid out when an exam is drawn, so that nobody who is graded with it waits for that."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec
import numpy as np

from autograder.diagnosis.gallery import gallery
from autograder.engine.corpus import Corpus
from autograder.engine.exam import Exam
from autograder.engine.kept import pack
from autograder.engine.plan import GALLERY, Bundle, Plan, Task, key_of, make_plan
from autograder.engine.store import code_digest
from autograder.problems.apart import ladder_apart
from autograder.stages.catalogue import all_stages
from autograder.stages.catalogue import stage as stage_of


class _Task(msgspec.Struct, array_like=True):
    stage: str
    rung: str
    batch: int
    asked: bytes
    numbers: tuple[int, ...]


class _Layout(msgspec.Struct, array_like=True):
    tasks: list[_Task]
    bundles: list[tuple[list[int], int, list[int]]]
    galleries: list[_Task]
    apart: list[_Task]
    inputs: bytes


def laid_out(corpus: Corpus) -> tuple[dict[str, bytes], bytes]:
    """Work out, once, what verdicts on a corpus need, by the keys of the checks, and lay out all calls."""
    plan = make_plan(all_stages(), {}, corpus)
    answers = {key_of(stage_of(task.stage.name), task.rung): pack(task.prepared) for task in plan.tasks}
    answers |= {key_of(task.stage, task.rung, apart=True): pack(task.prepared) for task in plan.apart}
    return answers, pack_plan(plan)


def pack_plan(plan: Plan) -> bytes:
    """Write a plan down; cases and answers stay where they are."""
    facets = {task.stage: task.rung.name for task in reversed(plan.tasks)}
    places = {task.batch: number for number, task in enumerate(plan.tasks)}

    def plain(task: Task, rung: str = "") -> _Task:
        asked = task.asked.astype("<i8").tobytes()
        return _Task(task.stage.name, rung or task.rung.name, task.batch, asked, task.numbers)

    return msgspec.msgpack.encode(
        _Layout(
            tasks=[plain(task) for task in plan.tasks],
            bundles=[([places[t.batch] for t in each.tasks], each.batch, list(each.ends)) for each in plan.bundles],
            galleries=[plain(task, facets[task.stage]) for task in plan.galleries],
            apart=[plain(task) for task in plan.apart],
            inputs=plan.inputs,
        )
    )


def plan_of_exam(exam: Exam, stages: Sequence[str], points: Mapping[str, float], follow_through: float) -> Plan:
    """Return the plan of a run with an exam: as it was laid out, if by this code, else laid out anew.

    Parameters
    ----------
    exam : Exam
        The exam.
    stages : sequence of str
        The stages that are used.
    points : mapping of str to float
        Points of each stage.
    follow_through : float
        Share of the points for what is right by itself.
    """
    if exam.laid_out_by != code_digest():
        chosen = [stage_of(name) for name in stages]
        return make_plan(chosen, points, exam.corpus, follow_through, exam.answers)
    found = msgspec.msgpack.decode(exam.layout, type=_Layout)
    used = set(stages)
    all_tasks = [_task(each, exam, apart=False) for each in found.tasks]
    return Plan(
        tasks=tuple(task for task in all_tasks if task.stage.name in used),
        bundles=tuple(
            Bundle(tuple(all_tasks[number] for number in numbers), batch, tuple(ends))
            for numbers, batch, ends in found.bundles
            if all_tasks[numbers[0]].stage.name in used
        ),
        galleries=tuple(_gallery(each) for each in found.galleries if each.stage in used),
        apart=tuple(_task(each, exam, apart=True) for each in found.apart if each.stage in used),
        points=points,
        follow_through=follow_through,
        inputs=found.inputs,
    )


def _task(plain: _Task, exam: Exam, *, apart: bool) -> Task:
    stage = stage_of(plain.stage)
    rung = next(rung for rung in stage.ladder.rungs if rung.name == plain.rung)
    ladder = ladder_apart(stage.ladder.name) if apart else stage.ladder.name
    key = key_of(stage, rung, apart=apart)
    return Task(
        stage=stage if apart else stage.facet(rung.name),
        rung=rung,
        batch=plain.batch,
        asked=np.frombuffer(plain.asked, dtype="<i8"),
        numbers=plain.numbers,
        find=lambda: exam.corpus.cases[ladder][rung.name],
        answers=exam.answers.get(key, b""),
    )


def _gallery(plain: _Task) -> Task:
    stage = stage_of(plain.stage).facet(plain.rung)
    asked = np.frombuffer(plain.asked, dtype="<i8")
    return Task(stage, GALLERY, plain.batch, asked, plain.numbers, lambda: gallery(stage.ladder.name))

"""The plan of a run: which calls are made for which check, built once for all submissions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from assignment.posegraph import PoseGraph, Ranging
from autograder.diagnosis.gallery import gallery
from autograder.engine.carrying import SLACK, Shared, batch_of, identity, joined, shared_data, table_of
from autograder.engine.corpus import Corpus
from autograder.engine.kept import prepared_type, unpack
from autograder.problems.apart import ladder_apart
from autograder.problems.cases import Case, simplicity
from autograder.problems.ladders import Rung
from autograder.sandbox import frames
from autograder.stages.base import Stage
from autograder.stages.earlier import answers

MAX_REPLY = 8 * 1024 * 1024  # bytes that one reply may have at the most, where checks are asked together
GALLERY = Rung("gallery", "small cases", 0.0, ())


@dataclass(frozen=True)
class Task:
    """One check of one stage: its cases, its share of the points, and the batch of calls that it needs.

    `batch` is the number of the batch in the inputs of the sandbox. A call that several cases need
    is made once: `asked` says for each call which one of the batch answers it. `numbers` are those
    of the cases' graphs. `find` gives the cases, and `answers` what the verdict needs: both are
    wanted of few tasks only where most of a class is right.
    """

    stage: Stage
    rung: Rung
    batch: int
    asked: NDArray[np.int64]
    numbers: tuple[int, ...]
    find: Callable[[], tuple[Case, ...]] = field(repr=False)
    answers: bytes = field(default=b"", repr=False)

    @cached_property
    def cases(self) -> tuple[Case, ...]:
        """The arguments of the calls."""
        return self.find()

    @property
    def share(self) -> float:
        """Share of the stage's points."""
        return self.stage.shares[self.rung.name]

    @cached_property
    def first_calls(self) -> NDArray[np.int64]:
        """For each case the number of its first call in the batch."""
        counts = np.array([len(self.stage.calls(case)) for case in self.cases])
        return np.asarray(np.cumsum(counts) - counts)

    @cached_property
    def same_as(self) -> NDArray[np.int64]:
        """For each call the number of the first one that asks the same, mostly its own."""
        _, firsts = np.unique(self.asked, return_index=True)
        return np.asarray(firsts[self.asked])

    @cached_property
    def order(self) -> NDArray[np.int64]:
        """For each case its place from simple to rich."""
        order = sorted(range(len(self.cases)), key=lambda index: simplicity(self.cases[index]))
        return np.argsort(np.array(order))

    @cached_property
    def prepared(self) -> Any:
        """What the verdict needs: as the exam has it, or worked out at the first use."""
        if self.answers:
            return unpack(self.answers, prepared_type(self.stage))
        return self.stage.prepare(self.cases)


@dataclass(frozen=True)
class Bundle:
    """Checks of one function that are asked in one request, which saves most of the talking.

    `batch` is the number of the joint batch; `ends` says where the calls of each check end in it.
    """

    tasks: tuple[Task, ...]
    batch: int
    ends: tuple[int, ...]


@dataclass(frozen=True)
class Plan:
    """All tasks of a run, in order, and the inputs of the sandbox as bytes.

    `galleries` are asked to explain, `apart` are the checks that can be asked by themselves, on
    graphs of their own.
    """

    tasks: tuple[Task, ...]
    bundles: tuple[Bundle, ...]
    galleries: tuple[Task, ...]
    apart: tuple[Task, ...]
    points: Mapping[str, float]
    follow_through: float
    inputs: bytes

    @cached_property
    def objects(self) -> Mapping[Shared, int]:
        """The graphs and rangings of all tasks with their numbers; for calls that nobody planned."""
        return _numbered((*self.tasks, *self.galleries, *self.apart))

    @cached_property
    def stages(self) -> tuple[tuple[Stage, tuple[Task, ...]], ...]:
        """The tasks, grouped by stage."""
        grouped: dict[str, list[Task]] = {}
        for task in self.tasks:
            grouped.setdefault(task.stage.name, []).append(task)
        return tuple((tasks[0].stage, tuple(tasks)) for tasks in grouped.values())

    def bundles_of(self, stage: Stage) -> list[Bundle]:
        """Return the bundles of a stage."""
        return [bundle for bundle in self.bundles if bundle.tasks[0].stage.name == stage.name]

    def stage(self, name: str) -> Stage:
        """Return a stage of this run by its name."""
        return next(stage for stage, _ in self.stages if stage.name == name)

    def has(self, name: str) -> bool:
        """Whether the run has a stage of this name."""
        return any(stage.name == name for stage, _ in self.stages)

    def tasks_of(self, stage: Stage) -> tuple[Task, ...]:
        """Return the checks of a stage."""
        return next(tasks for each, tasks in self.stages if each.name == stage.name)  # a facet has those of its stage

    def gallery_of(self, stage: Stage) -> Task:
        """Return the small cases of a stage, or of the facet that one rung sees, for whoever is wrong."""
        return next(task for task in self.galleries if task.stage is stage)

    @cached_property
    def tables(self) -> list[frames.Table]:
        """What the earlier functions answer for the graphs of `apart`; made when it is first needed."""
        calls = (call for task in self.apart for case in task.cases for call in task.stage.calls(case))
        graphs = dict.fromkeys(argument for call in calls for argument in call if isinstance(argument, PoseGraph))
        return [table_of(each, self.objects) for each in answers(tuple(graphs))]

    def batch(self, stage: Stage, calls: Sequence[Case]) -> frames.Batch:
        """Make a batch of calls that can be sent as it is; graphs of the corpus go by number."""
        return batch_of(stage, calls, self.objects)

    def second_round(self, tasks: Sequence[Task], calls: Sequence[Case]) -> frames.Batch:
        """Make the batch of a second round: new states on the graphs of the tasks' own cases, by number."""
        numbers = [number for task in tasks for number in task.numbers]
        cases: list[list[frames.Argument]] = [
            [frames.Array(x.shape, x.tobytes()), number] for (x, _), number in zip(calls, numbers, strict=True)
        ]
        largest = max(x.size for x, _ in calls)
        return frames.Batch(tasks[0].stage.function, tasks[0].stage.parts, 2 * largest + SLACK, cases)


def make_plan(
    stages: Sequence[Stage],
    points: Mapping[str, float],
    corpus: Corpus,
    follow_through: float = 1.0,
    answers: Mapping[str, bytes] = MappingProxyType({}),
) -> Plan:
    """Lay out every call of a run; `answers` are those of an exam, by the keys of its checks."""
    batches: list[frames.Batch] = []
    objects: dict[Shared, int] = {}

    def task(stage: Stage, rung: Rung, cases: tuple[Case, ...], key: str = "") -> Task:
        calls = [call for case in cases for call in stage.calls(case)]
        _number(calls, objects)
        batch = batch_of(stage, calls, objects)
        first: dict[Any, int] = {}
        asked = [first.setdefault(identity(case), len(first)) for case in batch.cases]
        once = dict(zip(asked, batch.cases, strict=True))
        batches.append(msgspec.structs.replace(batch, cases=list(once.values())))
        numbers = tuple(objects.get(case[-1], -1) if isinstance(case[-1], PoseGraph) else -1 for case in cases)
        return Task(stage, rung, len(batches) - 1, np.array(asked), numbers, lambda: cases, answers.get(key, b""))

    tasks = [
        task(stage.facet(rung.name), rung, corpus.cases[stage.ladder.name][rung.name], key_of(stage, rung))
        for stage in stages
        for rung in stage.ladder.rungs
    ]
    bundles = _bundles(tasks, batches)
    facets = dict.fromkeys(each.stage for each in tasks)
    galleries = [task(stage, GALLERY, gallery(stage.ladder.name)) for stage in facets]
    apart = [
        task(stage, rung, corpus.cases[ladder_apart(stage.ladder.name)][rung.name], key_of(stage, rung, apart=True))
        for stage in stages
        if stage.builds_on
        for rung in stage.ladder.rungs
    ]
    inputs = frames.encode_inputs(frames.Inputs(objects=[shared_data(each) for each in objects], batches=batches))
    return Plan(tuple(tasks), tuple(bundles), tuple(galleries), tuple(apart), points, follow_through, inputs)


def key_of(stage: Stage, rung: Rung, *, apart: bool = False) -> str:
    """Name a check of the exam; `apart` for what is asked by itself."""
    return f"{stage.name}/{rung.name}{'/apart' if apart else ''}"


def _number(calls: Iterable[Case], objects: dict[Shared, int]) -> None:
    """Give every graph and ranging that is met for the first time the next number."""
    for call in calls:
        for argument in call:
            if isinstance(argument, PoseGraph | Ranging):
                objects.setdefault(argument, len(objects))


def _numbered(tasks: Iterable[Task]) -> dict[Shared, int]:
    objects: dict[Shared, int] = {}
    for each in tasks:
        _number((call for case in each.cases for call in each.stage.calls(case)), objects)
    return objects


def _bundles(tasks: Sequence[Task], batches: list[frames.Batch]) -> list[Bundle]:
    """Join the checks of one function as long as the reply stays bounded; the joint batches go to the end."""
    bundles: list[Bundle] = []
    open_tasks: list[Task] = []

    def close() -> None:
        joint = joined([batches[task.batch] for task in open_tasks])
        ends = np.cumsum([len(batches[task.batch].cases) for task in open_tasks]).tolist()
        bundles.append(Bundle(tuple(open_tasks), len(batches), tuple(ends)))
        batches.append(joint)
        open_tasks.clear()

    for task in tasks:
        if open_tasks:
            same = open_tasks[-1].stage is task.stage
            joint = joined([batches[each.batch] for each in (*open_tasks, task)])
            if not same or frames.reply_bound(joint) > MAX_REPLY:
                close()
        open_tasks.append(task)
    if open_tasks:
        close()
    return bundles

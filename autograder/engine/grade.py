"""Grade a class: draw the exam once, reuse what is already graded, run the rest, store each result at once."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import msgspec

from autograder.course import Course
from autograder.engine.crew import crew, demanded, level_of
from autograder.engine.exam import FILE as EXAM
from autograder.engine.exam import Exam, draw_exam, kept_exam, save_exam
from autograder.engine.messages import Answer, Grade, Graded, Orders
from autograder.engine.pool import LEVELS, Pool
from autograder.engine.resulting import Ran, Results
from autograder.engine.run import Assigned, Progress, Run, Settings
from autograder.engine.sharing import Shared
from autograder.engine.store import RunRecord, Store, versions
from autograder.intake.submission import Submission
from autograder.intake.written import written_answers
from autograder.problems.variants import published
from autograder.sandbox.server import Server
from autograder.stages.catalogue import all_stages
from autograder.verdicts import Result

__all__ = ["Assigned", "Progress", "Run", "Settings", "grade"]


def grade(
    submissions: Sequence[Submission],
    course: Course,
    settings: Settings,
    out: Path,
    on_progress: Callable[[Progress], None] = lambda _: None,
    assigned: Mapping[str, Assigned] | None = None,
    exam: Exam | None = None,
    server: Server | None = None,
) -> Run:
    """Grade all submissions into a folder.

    Parameters
    ----------
    submissions : sequence of Submission
        What intake found; ids are unique.
    course : Course
        Points and limits.
    settings : Settings
        What holds for this run only.
    out : Path
        The output folder; results that it already holds from the same work are reused.
    on_progress : callable
        Called after every result.
    assigned : mapping of str to Assigned
        For each submission its student and variant; the worked example where nothing is said.
    exam : Exam, optional
        The exam; without it the one that is kept in the folder, where it is what the settings ask for, else one is
        drawn while the workers start. It is kept in the folder before anything is graded.
    server : Server, optional
        A fork server that is starting already, for a run of one submission; whoever started it ends it.

    Returns
    -------
    Run
        All results, sorted by submission; `interrupted` after Ctrl-C, with what is done so far.

    Raises
    ------
    SandboxError
        Where the confinement is weaker than demanded.
    UsageError
        Where the output folder cannot be written, or the exam in it cannot be read.
    """
    return _Grading(submissions, course, settings, Store(out), on_progress, assigned or {}, exam, server).run()


class _Grading:
    """The state of one run."""

    def __init__(
        self,
        submissions: Sequence[Submission],
        course: Course,
        settings: Settings,
        store: Store,
        on_progress: Callable[[Progress], None],
        assigned: Mapping[str, Assigned],
        exam: Exam | None,
        server: Server | None,
    ) -> None:
        self.began = time.perf_counter()
        self.submissions = sorted(submissions, key=lambda one: one.id)
        self.course, self.settings, self.store, self.on_progress = course, settings, store, on_progress
        everybodys = Assigned(published())
        self.assigned = {one.id: assigned.get(one.id, everybodys) for one in submissions}
        self.write = Results(course, settings.time_limit, self.assigned)
        self.stages = tuple(stage for stage in all_stages() if stage.name in course.stages)
        self.points = {name: course.points[name] for name in course.stages}
        self.results: dict[str, Result] = {}
        self.shared = Shared()
        self.reused = 0
        self.level = self.locks = ""
        self.server = server
        kept = kept_exam(store.out) if exam is None else exam
        self.exam = kept if exam or (kept and kept.asks_for(settings.seed, settings.examples)) else None

    def run(self) -> Run:
        """Do everything; an interruption keeps what is done."""
        interrupted = False
        try:
            if self.exam is not None:
                save_exam(self.exam, self.store.out / EXAM)
                self._take_known(self.exam)
            if len(self.results) < len(self.submissions):
                self._grade_the_rest()
        except KeyboardInterrupt:
            interrupted = True
        if not self.level:
            self._recall_the_locks()
        record = self._record(interrupted)
        self.store.save_record(record)
        return Run(tuple(self.results[name] for name in sorted(self.results)), record, interrupted)

    def _take_known(self, exam: Exam) -> None:
        """Keep what needs no worker: results of the same work, and uploads that could not be read."""
        for submission in self.submissions:
            known = (
                None
                if self.settings.fresh
                else self.store.load(submission.id, self.write.fingerprint(submission, exam))
            )
            if known is not None and self._is_locked_enough(known):
                self.reused += 1
                self._keep(known)
            elif submission.source is None:
                self._finish(self.write.rejected(submission, exam))

    def _is_locked_enough(self, known: Result) -> bool:
        return not known.confinement or LEVELS.index(known.confinement) >= LEVELS.index(demanded(self.settings))

    def _grade_the_rest(self) -> None:
        """Start workers and grade what has no result yet; the exam is drawn while they start, where it must be."""
        most = len(self.submissions) - len(self.results)
        with crew(self._orders, self.settings, most, self.server) as pool:
            self.level = level_of(pool, self.settings)
            self.locks = "" if pool.confinement is None else f"{self.level}: {pool.confinement.detail}"
            jobs = [
                (index, self._job(submission))
                for index, submission in enumerate(self.submissions)
                if submission.id not in self.results
            ]
            self._run(pool, jobs)

    def _recall_the_locks(self) -> None:
        """Where nothing was run, the weakest level under which the results came about is that of the run."""
        locked = [result for result in self.results.values() if result.confinement]
        if locked:
            weakest = min(locked, key=lambda result: LEVELS.index(result.confinement))
            self.level, self.locks = weakest.confinement, weakest.locks

    def _orders(self) -> bytes:
        if self.exam is None:
            self.exam = draw_exam(self.settings.seed, self.settings.examples)
            save_exam(self.exam, self.store.out / EXAM)
            self._take_known(self.exam)
        return msgspec.msgpack.encode(
            Orders(
                exam=self.exam.data,
                stages=tuple(stage.name for stage in self.stages),
                points=self.points,
                time_limit=self.settings.time_limit,
                memory_mib=self.course.memory_mib,
                output_mib=self.course.output_mib,
                allow_unconfined=self.settings.allow_unconfined,
                follow_through=self.course.follow_through,
            )
        )

    def _run(self, pool: Pool, jobs: list[tuple[int, Grade]]) -> None:
        """Grade; what ran out of time by the clock alone is confirmed, once, with a processor to itself."""
        late: set[int] = set()
        goes_on = pool.has_a_processor_each

        def done(index: int, answer: Answer) -> Grade | None:
            if isinstance(answer, Graded) and answer.unsure and index not in late:
                late.add(index)
                return self._job(self.submissions[index], alone=True) if goes_on else None
            self._done(index, answer)
            return None

        pool.run(jobs, done)
        if not goes_on:
            for index in sorted(late):
                pool.run([(index, self._job(self.submissions[index], alone=True))], done)

    def _job(self, submission: Submission, *, alone: bool = False) -> Grade:
        assert submission.source is not None  # a rejected upload has no job
        sheet = self.assigned[submission.id].sheet
        return Grade(submission.source, sheet, written_answers(submission.markdown), alone)

    def _done(self, index: int, answer: Answer) -> None:
        assert self.exam is not None  # it was drawn before the first worker was ready
        self._finish(self.write.of(self.submissions[index], answer, Ran(self.exam, self.level, self.locks)))

    def _finish(self, result: Result) -> None:
        self.store.save(result)
        self._keep(result)

    def _keep(self, result: Result) -> None:
        self.results[result.submission] = self.shared.result(result)
        self.on_progress(Progress(len(self.results), len(self.submissions), self.reused, result.submission))

    def _record(self, interrupted: bool) -> RunRecord:
        return RunRecord(
            seed=self.settings.seed if self.exam is None else self.exam.seed,
            examples=self.settings.examples if self.exam is None else self.exam.examples,
            exam="" if self.exam is None else self.exam.digest,
            confinement=self.level,
            locks=self.locks,
            versions=versions(),
            settings={
                "time_limit": self.settings.time_limit,
                "memory_mib": self.course.memory_mib,
                "output_mib": self.course.output_mib,
                "points": self.points,
                "feedback": self.settings.feedback,
            },
            submissions=len(self.submissions),
            graded_now=len(self.results) - self.reused,
            reused=self.reused,
            interrupted=interrupted,
            seconds=round(time.perf_counter() - self.began, 3),
        )

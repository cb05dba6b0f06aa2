"""One worker process: its own fork server, one submission at a time, from source to verdicts."""

from __future__ import annotations

import contextlib
import os
import time
import warnings
from collections.abc import Sequence
from multiprocessing.connection import Connection

import msgspec
import numpy as np

from autograder.attempts import Attempts, only_words
from autograder.engine.advice import advised
from autograder.engine.answering import judge_answers, judge_written
from autograder.engine.collect import Collected, collect
from autograder.engine.corpus import case_of
from autograder.engine.describe import Describer
from autograder.engine.exam import exam_of
from autograder.engine.explain import explain
from autograder.engine.follow import follow
from autograder.engine.judge import Judge
from autograder.engine.laid_out import plan_of_exam
from autograder.engine.messages import Answer, Grade, Graded, Message, Orders, Ready, Trouble
from autograder.engine.plan import Plan
from autograder.engine.reported import reported
from autograder.errors import AutograderError, SandboxLost
from autograder.lifeline import live_with_parent
from autograder.problems.variants import published
from autograder.sandbox.host import Answers, Limits, Sandbox, Server
from autograder.stages import answers, written
from autograder.stages.answers import Sheet
from autograder.verdicts import StageVerdict


def plan_of(told: Orders) -> Plan:
    """Lay out the run."""
    return plan_of_exam(exam_of(told.exam, "The exam"), told.stages, told.points, told.follow_through)


def limits_of(told: Orders) -> Limits:
    """Return the limits of a child."""
    return Limits(cpu_seconds=told.time_limit, memory_mib=told.memory_mib, output_bytes=told.output_mib * 1024 * 1024)


def main(connection: Connection) -> None:
    """Serve until the other end closes: the orders come first, then jobs; verdicts go out."""
    live_with_parent()
    warnings.simplefilter("ignore")  # they would end up in the grader's terminal, and are nobody's there

    def send(message: Message) -> None:
        connection.send_bytes(msgspec.msgpack.encode(message))

    # A lost fork server ends the worker without a word: who waits for it starts another.
    with contextlib.suppress(BrokenPipeError, EOFError, ConnectionResetError, SandboxLost):
        server = Server()  # it starts while the exam is still being drawn
        try:
            told = msgspec.msgpack.decode(_received(connection), type=Orders)
            plan = plan_of(told)
            sandbox = Sandbox(plan.inputs, limits_of(told), allow_unconfined=told.allow_unconfined, server=server)
            send(Ready(sandbox.confinement.level, sandbox.confinement.detail))
            examiner = Examiner(plan, sandbox)
            while True:
                send(examiner.do(msgspec.msgpack.decode(_received(connection), type=Grade)))
        except SandboxLost:
            raise
        except AutograderError as error:
            send(Trouble(str(error), fatal=True))
        finally:
            server.close()


def _received(connection: Connection) -> bytes:
    """Wait for a message; one that breaks off, because the client was stopped while it sent, is the end of it."""
    try:
        return connection.recv_bytes()
    except OSError:
        raise EOFError from None


class Examiner:
    """Grades one submission after another.

    Parameters
    ----------
    plan : Plan
        The exam.
    sandbox : Sandbox
        The worker's own fork server, with the inputs of the plan in it.
    """

    def __init__(self, plan: Plan, sandbox: Sandbox) -> None:
        self.sandbox = sandbox
        self.plan = plan
        self.judge = Judge(plan)
        self.describer = Describer(plan)

    def do(self, job: Grade) -> Answer:
        """Grade one submission; whatever goes wrong here is the grader's fault, never a zero.

        Raises
        ------
        SandboxLost
            Where the fork server has gone: this worker is of no use any more.
        """
        try:
            with np.errstate(all="ignore"):  # what a student returns is no reason for a warning to anybody
                return self._grade(job)
        except SandboxLost:
            raise
        except Exception as error:
            if os.environ.get("AUTOGRADER_DEBUG"):
                raise
            return Trouble(f"The grader failed ({type(error).__name__}: {error}).")

    def _grade(self, job: Grade) -> Graded:
        began = time.perf_counter()
        sheet = _sheet(job)
        with self.sandbox.open(job.source) as session:
            collected = collect(session, self.plan, alone=job.alone)
            if job.alone or not collected.unsure:
                follow(session, self.plan, collected)
            if collected.unsure and not job.alone:
                return Graded((), (), unsure=True, seconds=time.perf_counter() - began, written={}, iterates=None)
            marks = list(self.judge.judge(collected))
            given = collected.loaded.answers
            if answers.NAME in self.plan.points:
                marks.append(judge_answers(self.plan, sheet, given, marks, session))
            attempt = Attempts()  # the marks are final: from here on only words are added
            stages = attempt("describing", self.describer.describe, collected, marks, attempt) or marks
            stages = attempt("explaining", explain, session, self.plan, stages, collected.replies, attempt) or stages
            stages = attempt("reading the submission for advice", advised, stages, job.source.cells) or stages
            beside = attempt("keeping what was reported", reported, sheet, given)
            stages = attempt("taking the words", only_words, marks, stages) or marks
        texts = _texts(given, job.markdown_answers)
        if written.NAME in self.plan.points:
            stages.append(judge_written(self.plan.points[written.NAME], texts, given))
        return Graded(
            stages=tuple(stages),
            notes=tuple(f"{note.where}: {note.message}" for note in collected.loaded.notes),
            unsure=collected.unsure,
            seconds=time.perf_counter() - began,
            written=texts,
            iterates=None if given.iterates is None or given.iterates.ndim != 2 else given.iterates.tolist(),
            confinement=self.sandbox.confinement.level,
            flags=attempt.flags,
            in_vain=self._in_vain(collected, marks),
            reported=beside,
        )

    def _in_vain(self, collected: Collected, marks: Sequence[StageVerdict]) -> tuple[str, ...]:
        """Say what became of functions that somebody tried to write and that cost points."""
        lost = {
            self.plan.stage(mark.name).function
            for mark in marks
            if self.plan.has(mark.name) and mark.status != "passed"
        }
        fates = collected.loaded.fates
        return tuple(fates[name].message for name in sorted(lost & fates.keys()) if fates[name].written)


def _sheet(job: Grade) -> Sheet:
    if job.sheet is None:
        return Sheet(published().identifier, published().graph, published().iterates)
    graph, iterates = case_of(job.sheet[1])
    return Sheet(job.sheet[0], graph, iterates)


def _texts(given: Answers, markdown: dict[str, str]) -> dict[str, str]:
    """Join the written answers: a string that is set wins over the markdown of the notebook."""
    strings = {"2": given.written_2, "3": given.written_3}
    return {**markdown, **{question: text for question, text in strings.items() if text is not None}}

"""A small exam in a real sandbox, shared by the tests of the engine."""

import inspect

import pytest

from autograder.attempts import Attempts
from autograder.engine.collect import collect
from autograder.engine.corpus import draw_corpus
from autograder.engine.describe import Describer
from autograder.engine.follow import follow
from autograder.engine.judge import Judge
from autograder.engine.plan import make_plan
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import all_stages
from reference_solution import slam1d

REFERENCE = inspect.getsource(slam1d)


@pytest.fixture(scope="session")
def plan():
    """The exam with few drawn cases."""
    stages = all_stages()
    return make_plan(stages, {stage.name: stage.points for stage in stages}, draw_corpus(stages, 0, 30))


@pytest.fixture(scope="session")
def grade_source(plan):
    """A function that grades the text of a module: stage name to verdict."""
    judge, describer = Judge(plan), Describer(plan)
    with Sandbox(plan.inputs, Limits(cpu_seconds=0.5)) as sandbox:

        def grade(text, kind="module"):
            cells = [text] if kind == "module" else text
            source = Source(kind=kind, cells=cells, name="submission.py")
            for alone in (False, True):  # as in a run: what the clock alone stopped is asked once more
                with sandbox.open(source) as session:
                    collected = collect(session, plan, alone=alone)
                    follow(session, plan, collected)
                if not collected.unsure:
                    break
            verdicts = describer.describe(collected, judge.judge(collected), Attempts())
            return {verdict.name: verdict for verdict in verdicts}

        yield grade

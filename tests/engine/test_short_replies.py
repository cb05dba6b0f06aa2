"""A function that answered on a part of the cases only is not named by it, and nothing breaks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from autograder.engine.collect import collect, spread
from autograder.engine.describe import Describer
from autograder.engine.exam import draw_exam
from autograder.engine.plan import make_plan
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Outputs, Sandbox
from autograder.stages.catalogue import slips, stage
from autograder.stages.slips.submission import submission_text


def test_a_part_of_the_answers_names_no_mistake() -> None:
    """With all of them the mistake is named; with one answer a check, none is."""
    residual = stage("residual")
    slip = next(one for one in slips("residual") if one.pattern is None)
    plan = make_plan((residual,), {"residual": 15.0}, draw_exam(0, 1).corpus)
    source = Source("module", [submission_text(slip, residual.function)], "slip.py")
    with Sandbox(plan.inputs, Limits(cpu_seconds=2.0)) as sandbox, sandbox.open(source) as session:
        collected = collect(session, plan)
    tasks = plan.tasks_of(residual)
    replies = [collected.reply(task) for task in tasks]
    named = Describer(plan)._named(residual, tasks, replies)
    assert named is not None
    assert named[0].identifier == slip.identifier
    short = []
    for reply in replies:
        assert isinstance(reply.outputs, Outputs)
        short.append(replace(reply, outputs=spread(reply.outputs, np.arange(1))))
    assert Describer(plan)._named(residual, tasks, short) is None

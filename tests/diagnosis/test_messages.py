"""Every sentence of every message is true: of wrong specimens, disputed ones and slips, as they are really graded.

A message is read from its beginning, sentence by sentence; what matches no pattern fails, as does a false claim.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator
from typing import Any

import pytest
from msgspec.structs import replace

from autograder.attempts import Attempts
from autograder.engine.advice import advised
from autograder.engine.collect import collect
from autograder.engine.corpus import draw_corpus
from autograder.engine.describe import Describer
from autograder.engine.explain import explain
from autograder.engine.follow import follow
from autograder.engine.judge import Judge
from autograder.engine.plan import make_plan
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import all_stages, slips, stage
from autograder.stages.slips.submission import submission_text
from autograder.verdicts import StageVerdict
from tests.diagnosis.messages import CLAIMS, Told
from tests.diagnosis.test_sentences import CHECKS
from tests.specimens.first_line import code, submissions

WRONG = [path for path in submissions("wrong", "disputed") if path.suffix == ".py"]
RIGHT = [path for path in submissions("correct", "equivalent") if path.suffix == ".py"]
SLIPS = [(each, slip) for each in all_stages() for slip in slips(each.name)]


@pytest.fixture(scope="module", params=[0, 1])
def graded(request: pytest.FixtureRequest) -> Iterator[Any]:
    """A function that grades a text as a worker does, under one of two seeds, and that seed."""
    stages = all_stages()
    exam = draw_corpus(stages, request.param, 3)
    plan = make_plan(stages, {each.name: each.points for each in stages}, exam)
    judge, describer = Judge(plan), Describer(plan)
    with Sandbox(plan.inputs, Limits(cpu_seconds=2.0)) as sandbox:

        def grade(text: str) -> dict[str, StageVerdict]:
            with sandbox.open(Source(kind="module", cells=[text], name="slam1d.py")) as session:
                collected = collect(session, plan)
                follow(session, plan, collected)
                judged = describer.describe(collected, judge.judge(collected), Attempts())
                found = explain(session, plan, judged, collected.replies, Attempts())
            return {each.name: each for each in advised(found, [text])}

        yield grade, request.param


def false_sentences(text: str, verdicts: dict[str, StageVerdict], seed: int) -> list[tuple[str, str, str]]:
    """Return stage, kind and rest of the message for all that is unknown or false."""
    defined: dict[str, Any] = {"__name__": "slam1d"}
    with contextlib.suppress(ImportError):
        exec(compile(text, "slam1d.py", "exec"), defined)  # a specimen, or a known mistake: our own text
    found = []
    for verdict in verdicts.values():
        if verdict.name in ("answers", "written") or verdict.status == "passed":
            assert verdict.status != "passed" or not verdict.message, verdict
            continue
        told = Told(verdict, verdicts, defined, text)
        found += [(verdict.name, *each) for each in _read(verdict.message, told, seed)]
    return found


def _read(message: str, told: Told, seed: int) -> list[tuple[str, str]]:
    known = [slip.name for slip in slips(told.verdict.name) if slip.identifier == told.verdict.slip]
    found = []
    while message:
        name = next((name for name in known if message.startswith(name)), "")
        claim = next(((m, c) for p, c in CLAIMS.items() if (m := re.match(p, message))), None)
        fact = next(
            ((m, c) for p, c in CHECKS.items() if (m := re.match(re.sub(r"\.\*$", r".*?\.(?= |$)", p), message))), None
        )
        if name:
            end = len(name)
        elif claim is not None:
            end = claim[0].end()
            found += [] if claim[1](claim[0], told) else [("false", message)]
        elif fact is not None:
            end = fact[0].end()
            asked = stage(told.verdict.name).function
            found += [] if fact[1](fact[0], asked, told.defined[asked], seed) else [("false", message)]
        else:
            return [*found, ("unknown", message)]
        message = message[end:].lstrip()
    return found


@pytest.mark.slow
def test_every_sentence_about_a_specimen_is_true(graded: Any) -> None:
    """Wrong and disputed specimens hear nothing that a second look does not confirm."""
    grade, seed = graded
    found = {path.stem: false_sentences(code(path)[0], grade(code(path)[0]), seed) for path in WRONG}
    assert {name: said for name, said in found.items() if said} == {}


@pytest.mark.slow
def test_nothing_is_said_of_what_is_right(graded: Any) -> None:
    """Correct styles, and those of another convention, have no message about any function."""
    grade, seed = graded
    for path in RIGHT[seed::2]:
        verdicts = grade(code(path)[0])
        said = {each.name: each.message for each in verdicts.values() if each.status != "missing" and each.message}
        assert said == {}, path.stem


@pytest.mark.slow
def test_every_sentence_about_a_slip_is_true(graded: Any) -> None:
    """Each known mistake, alone in an otherwise right submission, under one seed or the other."""
    grade, seed = graded
    found = {}
    for of, slip in SLIPS[seed::2]:
        text = submission_text(slip, of.function)
        found[slip.identifier] = false_sentences(text, grade(text), seed)
    assert {name: said for name, said in found.items() if said} == {}


@pytest.mark.slow
def test_a_false_sentence_is_found(graded: Any) -> None:
    """Other numbers, another line, a sentence that nobody checks: each is seen."""
    grade, seed = graded
    text = code(next(path for path in WRONG if path.stem == "damped_column"))[0]
    verdicts = grade(text)
    said = verdicts["gauss_newton_step"].message
    assert false_sentences(text, verdicts, seed) == []
    for other in (said.replace("in row 0", "in row 1"), f"It is slow. {said}", said.replace("-1 0]", "-1 0.5]")):
        assert other != said
        changed = {**verdicts, "gauss_newton_step": replace(verdicts["gauss_newton_step"], message=other)}
        assert false_sentences(text, changed, seed)

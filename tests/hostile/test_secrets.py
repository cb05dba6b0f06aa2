"""What a student may see holds no hidden input and no expected value beyond what the policy allows.

A small class is graded three times, once a policy. Its hostile members print and raise the inputs
of the exam. Every file that students get is searched for numbers of the exam, digit by digit.
"""

from __future__ import annotations

import html
import re
import shutil
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from autograder.course import Course
from autograder.engine.corpus import draw_corpus
from autograder.engine.plan import make_plan
from autograder.sandbox import frames
from autograder.stages.catalogue import all_stages
from tests.hostile import corpus, neighbours
from tests.hostile.conftest import OPTIONS, Graded, grade

TELLING = (
    "case_98_echo_the_exam",
    "case_99_markup",
    "case_09_heap_for_given_away_cases",
    "case_54_table_of_known_inputs",
)
POLICIES = ("full", "hint", "score")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
DIGITS = 5  # numbers that agree in so many are the same number


@pytest.fixture(scope="module")
def shown(place: Path) -> dict[str, Graded]:
    """Grade the class under each policy, and keep what each wrote; the later ones reuse the results of the first."""
    folder = place / "telling"
    neighbours.write(folder)
    for name in TELLING:
        (folder / f"{name}.py").write_bytes((corpus.folder() / f"{name}.py").read_bytes())
    found = {}
    for policy in POLICIES:
        graded = grade(folder, place / "shown", [*OPTIONS, "--feedback", policy])
        found[policy] = replace(graded, out=Path(shutil.copytree(graded.out, place / f"shown_{policy}")))
    return found


@pytest.fixture(scope="module")
def hidden() -> set[str]:
    """Every number of the exam that is long enough to be told from others: inputs and expected values."""
    stages = all_stages()
    plan = make_plan(stages, Course().points, draw_corpus(stages, 0, int(OPTIONS[1])))
    inputs = frames.decode(plan.inputs, frames.Inputs)
    found: set[str] = set()
    for thing in inputs.objects:
        for value in (getattr(thing, name) for name in thing.__struct_fields__):
            if isinstance(value, bytes):
                found |= long_numbers(np.frombuffer(value, "<f8").tolist())
    for batch in inputs.batches:
        for argument in (argument for case in batch.cases for argument in case):
            if isinstance(argument, frames.Array):
                found |= long_numbers(np.frombuffer(argument.data, "<f8").tolist())
    for task in plan.tasks:
        for call in (call for case in task.cases for call in task.stage.calls(case)):
            for array in task.stage.expected(*call):
                found |= long_numbers(np.asarray(array, float).ravel().tolist())
    return found


def long_numbers(values: Iterable[float]) -> set[str]:
    """Write numbers with few digits, and keep those that need them all: 2.5 stands everywhere."""
    written = {f"{abs(value):.{DIGITS}g}" for value in values if np.isfinite(value)}
    return {text for text in written if len(text.partition("e")[0].replace(".", "").strip("0")) >= DIGITS}


def told(page: Path) -> set[str]:
    """Find the long numbers in the text of a page; coordinates of pictures are no text."""
    text = re.sub(r"<style.*?</style>|<script.*?</script>|<[^>]*>", " ", page.read_text("utf-8"), flags=re.DOTALL)
    return long_numbers(float(number) for number in NUMBER.findall(html.unescape(text)) if len(number) < 40)


def own(result: Any) -> set[str]:
    """Find the numbers that a result may show under `full`: its counterexamples, and what its own code said."""
    texts = [check.message for stage in result.stages for check in stage.checks]
    texts += [stage.message for stage in result.stages] + list(result.notes)
    texts += [repr(check.counterexample) for stage in result.stages for check in stage.checks]
    return long_numbers(float(number) for text in texts for number in NUMBER.findall(text) if len(number) < 40)


def pages(graded: Graded) -> list[Path]:
    """List the files of a run that students get."""
    return sorted((graded.out / "feedback").iterdir())


def test_the_search_would_find_something(shown: dict[str, Graded], hidden: set[str]) -> None:
    """The exam has numbers to look for, and the results, which are for staff, hold some of them."""
    assert len(hidden) > 500
    result = shown["full"].result("case_98_echo_the_exam")
    assert own(result) & hidden
    assert any("leaked-by-98" in note for note in result.notes)


@pytest.mark.parametrize("policy", ["hint", "score"])
def test_no_hidden_number_is_shown(shown: dict[str, Graded], hidden: set[str], policy: str) -> None:
    """Under `hint` and `score` no page holds a number of the exam."""
    leaks = {page.name: numbers for page in pages(shown[policy]) if (numbers := told(page) & hidden)}
    assert leaks == {}


@pytest.mark.parametrize("policy", ["hint", "score"])
def test_no_text_of_a_hidden_case_is_shown(shown: dict[str, Graded], policy: str) -> None:
    """What was printed or raised, by a call or while loading, appears on no page, nor does a got value."""
    for page in pages(shown[policy]):
        text = page.read_text("utf-8")
        assert "leaked" not in text, page.name
        assert "slam1d-hostile-99" not in text, page.name
        assert 'class="matrix"' not in text, page.name


def test_full_shows_the_own_counterexample_only(shown: dict[str, Graded], hidden: set[str]) -> None:
    """Under `full` a number of the exam is on a page only where the student's own witness or own text has it."""
    for page in pages(shown["full"]):
        result = shown["full"].result(page.stem)
        assert told(page) & hidden <= own(result), page.name


def test_what_is_printed_is_shown_nowhere(shown: dict[str, Graded]) -> None:
    """Standard output is thrown away under every policy, for staff, too."""
    for graded in shown.values():
        for path in graded.out.rglob("*.*"):
            assert "n=2 u=[0.0] x=[0.0, 0.0]\\n" not in path.read_text("utf-8"), path.name
        # The terminal, which is for staff, names what was raised, as far as there is room in its lines.
        assert "leaked" not in re.sub(r"ValueError: leaked-by-9(8|\.\.\.)", "", graded.printed)


def test_score_shows_marks_only(shown: dict[str, Graded]) -> None:
    """Under `score` a page has no reason, no hint, no remark about a line, and no name of a check."""
    for page in pages(shown["score"]):
        result = shown["score"].result(page.stem)
        text = html.unescape(page.read_text("utf-8"))
        words = set(result.notes)
        for stage in result.stages:
            words |= {stage.hint, stage.message, *stage.remarks, *(check.name for check in stage.checks)}
        assert not [said for said in words if len(said) > 20 and said in text], page.name


def test_students_get_nothing_but_their_page(shown: dict[str, Graded]) -> None:
    """The feedback folder holds one page a submission, and no page names another submission."""
    for graded in shown.values():
        names = set(graded.results())
        assert {page.name for page in pages(graded)} == {f"{name}.html" for name in names}
        for page in pages(graded):
            text = page.read_text("utf-8")
            assert not [name for name in names - {page.stem} if name in text], page.name

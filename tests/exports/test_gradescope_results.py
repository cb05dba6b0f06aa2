"""results.json is what Gradescope's documentation asks for, whatever the result."""

from __future__ import annotations

import html.parser
import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from autograder.exports.gradescope.results import failure_json, results_json
from tests.reports.examples import WRONG_J, result, small_class, stage

SCHEMA = json.loads((Path(__file__).parent / "gradescope_results.schema.json").read_text(encoding="utf-8"))
POLICIES = ("full", "hint", "score")
SLIP = {"slip": "loop_sign_flipped", "hint": "Which pose does the factor predict?"}
WRONG = stage("jacobian", "partial", 7.5, "J is off", WRONG_J, **SLIP)


def read(data: bytes) -> dict[str, Any]:
    """Validate and read."""
    found = json.loads(data)
    jsonschema.validate(found, SCHEMA)
    return found


@pytest.mark.parametrize("policy", POLICIES)
@pytest.mark.parametrize("one", small_class(), ids=lambda one: one.submission)
def test_every_result_fits_the_documentation(one: Any, policy: Any) -> None:
    """It validates, no test is hidden, the tests add up, and our own fault is no test."""
    found = read(results_json(one, policy))
    assert {test["visibility"] for test in found["tests"]} <= {"visible"}
    assert found["visibility"] == "visible"
    if one.score is None:
        assert found["tests"] == []
        assert "no fault of yours" in found["output"]
    else:
        assert found["score"] == one.score
        if one.stages:
            assert sum(test["max_score"] for test in found["tests"]) == one.max_score


@pytest.mark.parametrize("visibility", ["after_due_date", "after_published"])
def test_visibility_is_the_same_everywhere(visibility: Any) -> None:
    """One test hidden alone would hide the total of a student."""
    found = read(results_json(result("a", WRONG), visibility=visibility))
    assert {found["visibility"], *(test["visibility"] for test in found["tests"])} == {visibility}
    assert read(failure_json(visibility=visibility))["visibility"] == visibility


@pytest.mark.parametrize(
    ("policy", "shown", "hidden"),
    [
        ("full", ["J is off", "Hint: Which pose", "PoseGraph("], []),
        ("hint", ["Hint: Which pose", "Partly right."], ["J is off", "PoseGraph("]),
        ("score", [], ["J is off", "Hint", "PoseGraph(", "Partly right", "left out"]),
    ],
)
def test_the_policy_decides_what_a_test_says(policy: Any, shown: list[str], hidden: list[str]) -> None:
    """Points only, hints too, or everything: as on the page."""
    one = result("a", WRONG, notes=("cell 3, line 2 was left out",))
    said = results_json(one, policy).decode()
    assert all(words in said for words in shown)
    assert not [words for words in hidden if words in said]


class _Tags(html.parser.HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.seen: set[str] = set()

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        """Note a tag and its attributes."""
        self.seen |= {tag, *(name for name, _ in attrs)}


def test_foreign_text_is_no_markup() -> None:
    """Messages, notes and values of a student are text, and control characters are gone."""
    evil = "<script>alert(1)</script><img src=x onerror=y>\x1b[31m"
    got = {**WRONG_J, "got": evil}
    bad = stage("jacobian", "error", None, evil, got, hint=evil, remarks=(evil,))
    found = read(results_json(result("a", bad, notes=(evil,)), notes=(evil,), course=evil))
    tags = _Tags()
    for text in [found["output"], *(test["output"] for test in found["tests"])]:
        tags.feed(text)
        assert "\x1b" not in text
    assert tags.seen <= {"p", "pre"}


def test_nobody_is_named() -> None:
    """Flags are for staff: what they name is not in the file."""
    assert "flagged" not in results_json(result("a", WRONG, flags=("flagged: bob's numbers",))).decode()

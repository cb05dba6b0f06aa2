"""The pages as text: what each policy shows, that everything foreign is escaped, that nothing can be loaded."""

from __future__ import annotations

import base64
import hashlib
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.reports.charts import bar, histogram
from autograder.reports.feedback import feedback_page
from autograder.reports.folder import write_reports
from autograder.reports.overview import class_page, nobody_passed, unusual
from tests.reports.examples import WRONG_J, result, small_class, stage

POLICIES = ("full", "hint", "score")
EVIL = '"><script>alert(1)</script><b style="x">\u202e{{ 7 * 7 }}'


def student(policy: str) -> str:
    """Write the page of one student with one wrong stage."""
    lost = stage("jacobian", "failed", 0.0, "MESSAGE 0.123", WRONG_J, hint="HINT", remarks=("REMARK",))
    return feedback_page(result("alice", lost, notes=("NOTE",)), policy)


@pytest.mark.parametrize(
    ("policy", "shown", "hidden"),
    [
        ("full", ["MESSAGE 0.123", "HINT", "REMARK", "NOTE", "PoseGraph(", "[1]", "several loops"], []),
        ("hint", ["HINT", "REMARK", "NOTE", "wrong values"], ["MESSAGE", "PoseGraph(", "data:image", "[1]"]),
        (
            "score",
            ["75", "0 of 15"],
            ["MESSAGE", "HINT", "REMARK", "NOTE", "PoseGraph(", "wrong values", "data:image/"],
        ),
    ],
)
def test_a_page_shows_what_its_policy_allows(policy: str, shown: list[str], hidden: list[str]) -> None:
    """`full` shows reasons and cases, `hint` the hints, `score` points only."""
    body = student(policy).partition("<body>")[2]
    assert [words for words in shown if words not in body] == []
    assert [words for words in hidden if words in body] == []


@pytest.mark.parametrize("policy", POLICIES)
def test_a_rejected_upload_has_its_reason_under_every_policy(policy: str) -> None:
    """A student who sent the wrong file must learn it."""
    page = feedback_page(result("judy", status="rejected", message="judy.pdf is no notebook."), policy)
    assert "judy.pdf is no notebook." in page


@pytest.mark.parametrize("policy", ["full", "hint"])
def test_what_was_not_begun_takes_one_line(policy: str) -> None:
    """A missing stage has no section of its own, but a line with its points, to which the table leads."""
    missing = stage("sparsity_pattern", "missing", 0.0, "it is not defined")
    page = feedback_page(result("ann", stage("jacobian", "failed", 0.0, "MESSAGE"), missing), policy)
    assert page.count("<h2>Not begun</h2>") == 1
    assert '<section id="jacobian">' in page
    assert '<section id="sparsity_pattern">' not in page
    (line,) = [line for line in page.splitlines() if line.startswith('<li id="sparsity_pattern">')]
    assert line.endswith("</li>")
    assert ("it is not defined" in line) == (policy == "full")


def test_our_own_fault_shows_no_score() -> None:
    """A grader_error is no zero, and its technical reason stays with the staff."""
    page = feedback_page(result("kim", status="grader_error", message="SANDBOX"))
    assert "Not graded yet" in page
    assert "SANDBOX" not in page
    assert "<strong>0</strong>" not in page


def test_wrong_entries_are_marked_by_shape_and_text_as_well_as_colour() -> None:
    """Brackets, underline and a word for screen readers."""
    assert '<mark><span class="vh">wrong: </span>[1]</mark>' in student("full")


def test_patterns_are_drawn_where_they_differ() -> None:
    """The spy picture of J stands beside the right one, and only where it says something."""
    pattern = {**WRONG_J, "got": [[1.0, 1.0, 0.0], [0.0, 1.0, -1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]}
    page = feedback_page(result("alice", stage("jacobian", "failed", counterexample=pattern)))
    assert "Pattern of your J: 6 of 12" in page
    assert "Pattern of right J: 7 of 12" in page
    assert "Pattern of" not in student("full")


@pytest.mark.parametrize(
    "page", [feedback_page(result("alice")), class_page(small_class(), {})], ids=["feedback", "class"]
)
def test_the_policy_lets_nothing_in_or_out(page: str) -> None:
    """Only the style and script that stand in the page are allowed, by their hashes, and pictures as data."""
    [policy] = re.findall(r'Content-Security-Policy" content="([^"]*)"', page)
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    assert (rules["default-src"], rules["img-src"], rules["base-uri"], rules["form-action"]) == (
        "'none'",
        "data:",
        "'none'",
        "'none'",
    )
    for element, rule in (("style", "style-src"), ("script", "script-src")):
        texts = re.findall(rf"<{element}>(.*?)</{element}>", page, re.DOTALL)
        hashes = [f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'" for text in texts]
        assert hashes == ([rules[rule]] if rule in rules else [])
    assert not re.search(r"<[^>]* (style|on\w+)=", page), "an attribute that the policy would block"
    assert not re.search(r'(src|href)="(?!data:|#|feedback/)', page)


def test_everything_foreign_is_escaped() -> None:
    """Names, variants, messages, hints, remarks, notes and course titles are text, never markup."""
    evil = result(
        EVIL,
        stage("jacobian", "failed", 0.0, EVIL, {**WRONG_J, "got": EVIL}, hint=EVIL, remarks=(EVIL,), slip=None),
        notes=(EVIL,),
        variant=EVIL,
    )
    lost = result("x" + EVIL, status="rejected", message=EVIL)
    for page in (
        *(feedback_page(evil, policy, EVIL) for policy in POLICIES),
        class_page([evil, lost], {"versions": {EVIL: EVIL}, "confinement": EVIL}, EVIL),
    ):
        assert "<script>alert" not in page
        assert "<b style" not in page
        assert "\u202e" not in re.sub(
            r"<title>.*?</title>|<p class=\"over\">.*?</p>|<footer>.*", "", page, flags=re.DOTALL
        )


@given(st.text(max_size=40), st.text(max_size=40))
def test_any_name_and_message_gives_a_well_formed_page(name: str, message: str) -> None:
    """Whatever a student writes, tags stay balanced and no new element appears."""
    page = feedback_page(result(name or "x", stage("residual", "error", message=message)))
    plain = feedback_page(result("x", stage("residual", "error", message="m")))
    assert re.findall(r"</?[a-z0-9]+", page) == re.findall(r"</?[a-z0-9]+", plain) or not message.strip()


def test_the_class_page_says_what_nobody_got_and_what_was_unusual() -> None:
    """Checks without a single pass, and runs that a grader should look at."""
    results = [result("a", stage("jacobian", "timeout")), result("b", stage("jacobian", "failed"))]
    assert nobody_passed(results) == [("jacobian", "worked example", 2), ("jacobian", "several loops", 2)]
    assert [event for event, _ in unusual(small_class())] == [
        "could not be graded, through no fault of the student",
        "could not be read",
        "import not allowed",
        "ran out of memory",
        "ran out of time",
    ]


def test_the_class_page_shows_a_group_with_its_size_slip_and_witness() -> None:
    """A recognised mistake has its name, its count, who made it and the case that shows it."""
    page = class_page(small_class(), {})
    row = re.search(r"<tr><td class=\"n\">2</td>.*?</tr>", page, re.DOTALL)
    assert row is not None
    assert "loop sign flipped" in row[0]
    assert "PoseGraph(" in row[0]
    assert 'href="feedback/carol.html"' in row[0]


def test_the_class_page_of_nobody_is_a_page() -> None:
    """An empty run and one without a graded submission are written too."""
    assert "<strong>0</strong> submissions" in class_page([], {})
    assert "<strong>1</strong> submission" in class_page([result("judy", status="rejected")], {})


def test_charts_say_in_words_what_they_draw() -> None:
    """A screen reader hears the numbers."""
    assert 'aria-label="7.5 of 15"' in bar(7.5, 15.0)
    assert "0 to 45: 1; 45 to 90: 2" in histogram([10.0, 80.0, 120.0], 90.0, bins=2)


def test_pages_are_the_same_every_time(tmp_path: Path) -> None:
    """The same results give the same bytes: no date, no order of a set."""
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        write_reports(small_class(), tmp_path / name, {"seed": 7})
    first = {path.relative_to(tmp_path / "one"): path.read_bytes() for path in (tmp_path / "one").rglob("*.*")}
    second = {path.relative_to(tmp_path / "two"): path.read_bytes() for path in (tmp_path / "two").rglob("*.*")}
    assert first == second
    assert len(first) == 13

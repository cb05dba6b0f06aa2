"""The page that solves a variant by hand, and what is shown of a variant in text."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.problems.exact import ExactGraph, decimal
from autograder.problems.families import family, names
from autograder.problems.hand_solution import hand_solution
from autograder.problems.listing import describe, key_columns, key_row, right_letter
from autograder.problems.loops import solve_by_loops
from autograder.problems.secret import Secret
from autograder.problems.variants import Variant, draw_variant
from autograder.problems.viva import viva, viva_text

SECRET = Secret(b"0123456789abcdef")


def variant_of(text: str, student_id: str = "s1001") -> Variant:
    """Draw one."""
    return draw_variant(SECRET, "2026S", student_id, family(text))


@given(st.sampled_from("WABCDL"), st.integers(0, 10**6))
@settings(max_examples=80)
def test_the_loops_solve_the_normal_equations(letter: str, number: int) -> None:
    """Mismatch, variances and forces give the exact answer, whole forces, and the page checks H dx = -b."""
    variant = variant_of(letter, str(number))
    solved = solve_by_loops(variant.exact)
    assert solved.x1 == variant.x1 == variant.exact.solution()
    assert all(force.denominator == 1 for force in solved.forces)
    assert len(hand_solution(variant).splitlines()) > 40


@pytest.mark.parametrize("letter", ["W", "A", "B", "C"])
def test_the_page_counts_in_whole_numbers(letter: str) -> None:
    """The check of H dx = -b has whole numbers only, and both sides agree in every row."""
    variant = variant_of(letter)
    page = hand_solution(variant)
    rows = re.findall(r"^\| \d+ \| (.*) \| (.*) \| (.*) \|$", page.partition("## 6. ")[2], re.MULTILINE)
    assert len(rows) == variant.exact.n_poses
    for terms, total, right in rows:
        factors = re.findall(r"\((-?\d+)\)\((-?\d+)\)", terms)
        assert sum(int(a) * int(b) for a, b in factors) == int(total) == int(right)
    assert "(" + ", ".join(map(decimal, variant.x1)) + ")" in page


def test_the_page_of_one_loop() -> None:
    """The worked example by hand: mismatch 0.5, variance 0.05, force 10, each edge 0.1 shorter."""
    page = hand_solution(variant_of("E"))
    assert "e = (0.5) − (0) − (0) = **0.5 m**" in page
    assert "V = 0.01 + 0.01 + 0.01 + 0.01 + 0.01 = **0.05 m²**" in page
    assert "q = e / V = 0.5 / 0.05 = 50 / 5 = **10 per metre**" in page
    assert "| 0 → 1 | 1.1 | 0.01 · q | 0.1 | 1 |" in page
    assert "x⁽¹⁾ = **(0, 1, 1.9, 2.9, 0.1)**" in page


def test_the_page_of_two_loops_has_a_two_by_two_system() -> None:
    """Two loops: the system, its determinant, and forces that solve it."""
    page = hand_solution(variant_of("C"))
    system = re.findall(r"^    \((-?\d+)\) q₁ \+ \((-?\d+)\) q₂ = (-?\d+)$", page, re.MULTILINE)
    (a, b, e), (c, d, g) = [tuple(map(int, row)) for row in system]
    found = re.search(r"\*\*q₁ = (-?\d+), q₂ = (-?\d+)\*\*", page)
    assert found is not None
    q, r = map(int, found.groups())
    assert (a * q + b * r, c * q + d * r) == (e, g)
    assert f"= {a * d - b * c}." in page


def test_shared_edges_feel_both_loops() -> None:
    """R has the shared variance off its diagonal, with a sign where the loops run against each other."""
    solved = solve_by_loops(variant_of("L").exact)
    assert solved.matrix[0][1] == solved.matrix[1][0] != 0
    assert {sign for path in solved.rounds for _, sign in path} == {-1, 1}


def test_other_orders_are_refused() -> None:
    """The loops are found by position, so another order is an error and not a wrong page."""
    one = Fraction(1)
    with pytest.raises(ValueError, match="must lead from pose 0 to every pose, got 1 -> 2"):
        solve_by_loops(ExactGraph(3, ((1, 2), (0, 1)), (one, one), (one, one), (0,), (one,), (one,)))
    with pytest.raises(ValueError, match=r"one prior, on pose 0, got priors on \(1,\)"):
        solve_by_loops(ExactGraph(2, ((0, 1),), (one,), (one,), (1,), (one,), (one,)))


@pytest.mark.parametrize("letter", list(names()))
def test_a_listing_keeps_the_answers_back(letter: str) -> None:
    """What everybody may see holds the data and the start; answers come only when asked for."""
    variant = variant_of(letter)
    answer = "(" + ", ".join(map(decimal, variant.x1)) + ")"
    public, staff = describe(variant, picture="(a drawing)"), describe(variant, answers=True)
    assert variant.identifier in public
    assert "(a drawing)" in public
    assert answer not in public
    assert f"x^(1)       = {answer}" in staff
    assert ("landmarks: x4, x5" in public) == (letter == "L")


def test_the_listing_of_the_worked_example() -> None:
    """The staff's listing of the worked example has chi-squared 25 before and 5 after."""
    text = describe(variant_of("E"), answers=True)
    assert "chi-squared = 25 at x^(0), 5 at x^(1)" in text
    assert "dx          = (0, -0.1, -0.2, -0.3, -0.4)" in text


def test_the_key_has_a_row_a_student() -> None:
    """The staff's table has the answers as short decimals and the letter of the right choice."""
    row = dict(zip(key_columns(), key_row(variant_of("E")), strict=True))
    assert row["x1"] == "0 1 1.9 2.9 0.1"
    assert row["conclusion"] == right_letter(variant_of("E")) in "ABCDEF"


@given(st.sampled_from("WABCDLE"), st.integers(0, 10**6))
@settings(max_examples=60)
def test_oral_questions_are_about_the_students_numbers(letter: str, number: int) -> None:
    """Three different questions, the same whenever asked, each with an answer."""
    variant = variant_of(letter, str(number))
    questions = viva(variant)
    assert questions == viva(variant)
    assert len({question for question, _ in questions}) == 3
    assert all(question.count("?") >= 1 and answer.endswith(".") for question, answer in questions)
    assert len(viva(variant, 99)) == 7
    assert viva_text(variant).count("\n   Answer: ") == 3


def test_the_answers_of_the_oral_questions_are_right() -> None:
    """All seven on the worked example, as a hand would work them out."""
    text = " ".join(f"{question} {answer}" for question, answer in viva(variant_of("E"), 7))
    for words in (
        "Your loop closure 0 → 4 measured 0 m.",
        "Dead reckoning says 0.5 m; the row of f is measured minus that, -0.5 m.",
        "Its information goes from 100 to 200: H[0,0] and H[4,4] grow by 100",
        "0 → 1 and 1 → 2 and 2 → 3 and 3 → 4 and 0 → 4, by 0.1 m",
        "with x4 = 0.1; the second step is 0",
        "x0 stays at 0",
        "+1 in column 0, −1 in column 4. Row 5 is the prior: +1 in column 0",
        "No, it is -0.1 m",
    ):
        assert words in text

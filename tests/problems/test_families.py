"""Families: what every variant of a class keeps, and the options that an instructor may set."""

from __future__ import annotations

import dataclasses
import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.problems import families as package
from autograder.problems.band import Band
from autograder.problems.circulation import Circulation
from autograder.problems.families import families, family, names, unequal_variances
from autograder.problems.family import Options
from autograder.problems.ledger import Ledger
from autograder.problems.secret import Secret
from autograder.problems.stream import Stream
from autograder.problems.variants import Variant
from tests.witness import exact_normal_equations, exact_problem, exact_solve, rational

SECRET = Secret(b"0123456789abcdef")
PERSONAL = [letter for letter in names() if letter != "E"]
CLASS = 1000


@pytest.fixture(scope="module", params=PERSONAL)
def variants(request: pytest.FixtureRequest) -> list[Variant]:
    """Draw a class of 1,000 students of one family."""
    chosen = family(request.param)
    return Ledger().extend(SECRET, "2026S", {f"s{k:04}": chosen for k in range(CLASS)})


def test_a_thousand_students_get_different_numbers(variants: list[Variant]) -> None:
    """No two students of a class of 1,000 share data or answer; the step alone may repeat."""
    assert len(variants) == CLASS
    assert len({variant.exact for variant in variants}) == CLASS
    assert len({variant.x1 for variant in variants}) == CLASS
    assert len({variant.identifier for variant in variants}) == CLASS


def test_a_thousand_variants_are_in_the_band(variants: list[Variant]) -> None:
    """Each of 1,000 variants is well-posed, solved exactly and within the family's band."""
    band = family(variants[0].family).band
    assert not [(v.identifier, found) for v in variants if (found := band.complaints(v.exact, v.x1))]


def test_a_thousand_answers_are_exact(variants: list[Variant]) -> None:
    """At the answer, H and b formed by the witness from the float data give b = 0, and H is regular."""
    for variant in variants[:: 1 if len(variants[0].x1) < 7 else 10]:
        f, J, weights = exact_problem([float(value) for value in variant.x1], variant.graph)
        assert not any(sum(w * row[c] * r for row, w, r in zip(J, weights, f, strict=True)) for c in range(len(J[0])))
    for variant in variants[::50]:
        H, b = exact_normal_equations(*exact_problem(variant.start, variant.graph))
        step = exact_solve(H, [-entry for entry in b])
        assert tuple(step) == variant.step
        assert [x + dx for x, dx in zip(rational(variant.start), step, strict=True)] == list(variant.x1)


def test_rounding_the_answer_recovers_the_truth(variants: list[Variant]) -> None:
    """Every pose is less than half a metre off the truth, so different draws are different data."""
    assert all(
        abs(x - t) < Fraction(1, 2) for variant in variants for x, t in zip(variant.x1, variant.truth, strict=True)
    )


def test_judged_bounds_hold(variants: list[Variant]) -> None:
    """A variant keeps the bounds that the contract sets for judged graphs: cond(H) <= 1e6 and |x| <= 100."""
    for variant in variants[::20]:
        H, _ = variant.exact.normal_equations(variant.x0)
        assert np.linalg.cond(np.array([[float(entry) for entry in row] for row in H])) <= 1e6
        assert np.abs(variant.iterates).max() <= 100


def test_collisions_are_as_rare_as_counted() -> None:
    """The counting argument: raw count x share that passes = problems; for A hardly any two of 1,000 meet."""
    chosen = family("A")
    assert chosen.raw_count == 6**4 * 5**4 * 4**5 * 5
    trials = sum(chosen.draw(Stream(b"count", str(k))).attempts for k in range(500))
    problems = chosen.raw_count * 500 / trials
    assert 5e8 < problems < 2e9
    assert 1 - math.exp(-CLASS * (CLASS - 1) / 2 / problems) < 0.001


@given(st.sampled_from(PERSONAL), st.text(min_size=1, max_size=30), st.binary(min_size=16, max_size=40))
@settings(max_examples=60)
def test_every_draw_passes_the_independent_band(letter: str, student_id: str, key: bytes) -> None:
    """Whatever the student and the secret, the band, which shares no code with the draw, finds nothing wrong."""
    chosen = family(letter)
    draw = chosen.draw(Stream(key, student_id))
    assert not chosen.band.complaints(draw.graph, draw.x1)
    assert draw.graph.solution() == draw.x1


@st.composite
def option_texts(draw: st.DrawFn) -> str:
    """Draw a family with options that fit."""
    letter = draw(st.sampled_from("ABC"))
    poses = draw(st.integers(6, 10))
    loops = draw(
        st.lists(st.tuples(st.integers(0, poses - 4), st.integers(3, 5)), min_size=1, max_size=2, unique=True).map(
            lambda pairs: [(i, min(i + length, poses - 1)) for i, length in pairs]
        )
    )
    words = [f"poses={poses}", "loops=" + "+".join(f"{i}-{j}" for i, j in dict.fromkeys(loops))]
    words.append(f"prior_mean={draw(st.sampled_from(['0', '2', '-1.5']))}")
    return f"{letter}:{','.join(words)},decimals={draw(st.sampled_from([2, 3]))}"


@given(option_texts())
@settings(max_examples=40)
def test_options_are_kept(text: str) -> None:
    """Poses, loops, prior mean and decimals are those that were asked for."""
    chosen = family(text)
    draw = chosen.draw(Stream(b"options", text))
    assert chosen.label == text
    assert not chosen.band.complaints(draw.graph, draw.x1)
    asked = dict(word.split("=") for word in text.partition(":")[2].split(","))
    assert draw.graph.n_poses == int(asked["poses"])
    loops = draw.graph.edges[draw.graph.n_poses - 1 :]
    assert "+".join(f"{i}-{j}" for i, j in loops) == asked["loops"]
    assert draw.graph.prior_means == (Fraction(asked["prior_mean"]),)
    assert all(1000 % value.denominator == 0 for value in (*draw.graph.measurements, *draw.x1))


def test_one_decimal_is_possible() -> None:
    """With decimals=1 no number has two."""
    for text in ("W:decimals=1", "A:decimals=1", "B:decimals=1", "C:decimals=1", "L:decimals=1"):
        draw = family(text).draw(Stream(b"one", text))
        assert all(10 % value.denominator == 0 for value in (*draw.graph.measurements, *draw.x1))


def test_landmarks_follow_the_poses() -> None:
    """Family L can have more poses; its landmarks are the last two unknowns, each seen twice."""
    chosen = family("L:poses=6")
    draw = chosen.draw(Stream(b"more", "L"))
    assert chosen.landmarks == (6, 7)
    assert draw.graph.n_poses == 8
    assert [sum(j == k for _, j in draw.graph.edges) for k in chosen.landmarks] == [2, 2]


def test_one_file_is_one_family() -> None:
    """A family is found because its file is there."""
    folder = Path(package.__file__).parent
    assert len(names()) == len([path for path in folder.glob("*.py") if path.name != "__init__.py"])
    assert set(names()) >= set("ABCDELW")
    assert [one.label for one in families()] == sorted(names())
    assert family("Worked-Example") is family("Worked-Example")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Q", "There is no family 'Q'; expected one of A (unequal-variances), B"),
        ("A:colour=red", "Family option 'colour=red' is unknown; expected one of poses, loops, prior_mean, decimals"),
        ("A:poses", "Family option 'poses' is unknown"),
        ("A:poses=many", "Family option poses has the value 'many'; expected for example poses=6"),
        ("A:poses=5,poses=6", "Family option poses is set twice"),
        ("A:poses=2", "Option poses is 2; expected 3 to 24"),
        ("A:poses=0", "Option poses is 0; expected 3 to 24"),
        ("A:poses=99", "Option poses is 99; expected 3 to 24"),
        ("A:loops=0-7", "Loop 0-7 does not fit 5 poses; expected i-j with i + 1 < j < 5"),
        ("A:loops=1-2", "Loop 1-2 does not fit 5 poses"),
        ("A:loops=0-3+0-3", "Option loops names a loop twice"),
        ("A:decimals=0", "Option decimals is 0; expected 1, 2 or 3"),
        ("A:prior_mean=1.234", "Option prior_mean is 1.234; expected at most 2 decimals"),
        ("A:prior_mean=50", "Option prior_mean is 50; expected at most 2 decimals, from -10 to 10"),
        ("L:loops=0-3", "Family L takes no option loops"),
        ("L:poses=2", "Option poses is 2; expected 3 to 24"),
        ("E:poses=6", "The worked example takes no options, got poses=6"),
    ],
)
def test_a_bad_option_says_what_fits(text: str, words: str) -> None:
    """What does not fit is refused with what came and what was expected."""
    with pytest.raises(UsageError) as caught:
        family(text)
    assert words in str(caught.value)


def test_a_family_needs_a_loop() -> None:
    """Without a loop there is nothing to correct."""
    with pytest.raises(UsageError, match="Option loops is empty"):
        unequal_variances.family(Options(loops=()))


def test_the_band_finds_what_is_wrong() -> None:
    """A wrong answer, a missing prior and numbers out of the band are each said."""
    chosen = family("A")
    draw = chosen.draw(Stream(b"wrong"))
    wrong = (draw.x1[0] + 1, *draw.x1[1:])
    assert "x1 is not the solution: b(x1) is not zero." in chosen.band.complaints(draw.graph, wrong)
    floating = dataclasses.replace(draw.graph, priors=(), prior_means=(), prior_variances=())
    assert "The problem is not well-posed: every connected part must have a prior" in " ".join(
        chosen.band.complaints(floating, draw.x1)
    )
    strict = Band(6, 2, 4, 1, (0, 0), (Fraction(0), Fraction(1, 100)))
    assert len(strict.complaints(draw.graph, draw.x1)) == 6
    example = family("E").draw(Stream(b""))
    assert not family("E").band.complaints(example.graph, example.x1)


def test_limits_that_contradict_one_another_are_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """A family without any problem says so instead of drawing for ever."""
    monkeypatch.setattr("autograder.problems.circulation.ATTEMPTS", 50)
    band = Band(3, 1, 3, 2, (0, 3), (Fraction(0), Fraction(0)))
    plan = Circulation(((0, 1), (1, 2)), ((0, 2),), band, (1,), (0,), (1, 2, 4), (10,), (Fraction(0),))
    with pytest.raises(ValueError, match="must leave a problem, got none in 50 trials"):
        plan.draw(Stream(b""))

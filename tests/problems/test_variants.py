"""Variants: personal, reproducible, and nobody else's."""

from __future__ import annotations

import dataclasses
import pickle
import subprocess
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.problems.circulation import Draw
from autograder.problems.exact import decimal
from autograder.problems.families import family
from autograder.problems.family import Family
from autograder.problems.secret import Secret, read_secret
from autograder.problems.stream import Stream
from autograder.problems.variants import choose_family, draw_variant, published

SECRET = Secret(b"0123456789abcdef")
IDS = st.text(st.characters(codec="utf-8"), min_size=1, max_size=30)

PINNED = {
    ("2026S", "s1001", "W"): ("W-387a4dcbbea4a8f9", "0 -3.2 -1.8 -4.8 -4"),
    ("2026S", "s1002", "W"): ("W-cbde008514dd300f", "0 -2.8 -0.2 2.1 4"),
    ("2026S", "s1001", "A"): ("A-e8e7e085e954e7b9", "0 0.9 -0.9 0 2.8"),
    ("2026S", "s1002", "A"): ("A-5d873dd517972285", "0 3.1 0 2.2 1.1"),
    ("2027S", "s1001", "A"): ("A-71f725848c0ebe89", "0 -3.2 -3.9 -5 -6.1"),
    ("2026S", "Zoë Müller", "A"): ("A-2072eb0beab65632", "0 -2.1 -3.2 0.2 0.9"),
    ("2026S", "s1001", "B"): ("B-bdeaa8cf3b4dff7a", "1 -0.1 -2.1 0.1 -2.2 0.8"),
    ("2026S", "s1001", "C"): ("C-64d22d8f5d7666a7", "3 0.9 3.1 4.9 8.1 6.8"),
    ("2026S", "s1001", "D"): ("D-40927e25a92c77c9", "2 4.9 6.1 9 12.1 15 17.8 15.2 17.8 15.9 19.2 21.8"),
    ("2026S", "s1001", "L"): ("L-70afbd1cfffec64b", "1 4.1 6.2 5 2.8 6.9"),
    ("2026S", "s1001", "A:decimals=1"): ("A-0fcd353b61ef11e0", "0 2.8 1.1 0.1 2.2"),
    ("2026S", "s1001", "B:poses=8,loops=1-4+2-6,prior_mean=2.5,decimals=3"): (
        "B-12b626ff3efda1ee",
        "2.5 4.6 7.6 6.3 8.7 7.6 4.6 6.5",
    ),
    ("2026S", "s1001", "E"): ("worked-example", "0 1 1.9 2.9 0.1"),
}


@pytest.mark.parametrize(("key", "variant"), PINNED.items(), ids=" ".join)
def test_variants_are_pinned(key: tuple[str, str, str], variant: tuple[str, str]) -> None:
    """These variants come out on every machine and under every version of Python and numpy."""
    term, student_id, text = key
    drawn = draw_variant(SECRET, term, student_id, family(text))
    assert (drawn.identifier, " ".join(map(decimal, drawn.x1))) == variant


def test_another_process_draws_the_same() -> None:
    """Neither the hash seed nor the state of a process has a part in it."""
    code = (
        "from autograder.problems.families import family\n"
        "from autograder.problems.secret import Secret\n"
        "from autograder.problems.variants import draw_variant\n"
        "for letter in 'ABCDLW':\n"
        "    print(draw_variant(Secret(b'0123456789abcdef'), '2026S', 's7', family(letter)).identifier)\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", code],
        cwd=Path(__file__).resolve().parents[2],
        env={"PYTHONHASHSEED": "12345"},
        capture_output=True,
        text=True,
        check=True,
    )
    here = [draw_variant(SECRET, "2026S", "s7", family(letter)).identifier for letter in "ABCDLW"]
    assert run.stdout.split() == here


@given(IDS, IDS)
@settings(max_examples=50)
def test_a_variant_depends_on_everything(student_id: str, term: str) -> None:
    """Another secret, term, student or option gives another variant; the same give the same."""
    base = draw_variant(SECRET, term, student_id, family("C"))
    assert base == draw_variant(SECRET, term, student_id, family("C"))
    others = [
        draw_variant(Secret(b"0123456789abcdeg"), term, student_id, family("C")),
        draw_variant(SECRET, term + "x", student_id, family("C")),
        draw_variant(SECRET, term, student_id + "x", family("C")),
        draw_variant(SECRET, term, student_id, family("C:poses=6")),
    ]
    assert base.fingerprint not in {other.fingerprint for other in others}


@given(st.sampled_from("ABCDLW"), IDS)
@settings(max_examples=40)
def test_what_follows_from_the_data_follows(letter: str, student_id: str) -> None:
    """Graph, start, step and iterates of a variant belong together."""
    variant = draw_variant(SECRET, "2026S", student_id, family(letter))
    assert variant.iterates.shape == (4, variant.graph.n_poses)
    np.testing.assert_allclose(variant.start, variant.graph.dead_reckoning(), atol=1e-12)
    np.testing.assert_allclose(variant.iterates[0] + [float(dx) for dx in variant.step], variant.iterates[1])
    assert (variant.iterates[1:] == variant.iterates[1]).all()
    assert variant.problem.graph == variant.graph
    assert variant.problem.variant == variant.identifier == f"{letter}-{variant.fingerprint}"
    assert sorted(choice.letter for choice in variant.choices) == list("ABCDEF")
    assert pickle.loads(pickle.dumps(variant)) == variant


def test_the_worked_example_is_nobodys_own() -> None:
    """Everybody may get the worked example, and nobody gets its numbers as their own."""
    one, other = (draw_variant(SECRET, "2026S", name, family("E"), taken=published().marks) for name in ("s1", "s2"))
    assert one.marks == other.marks == published().marks
    assert one.identifier == "worked-example"


def _tiny(size: int) -> Family:
    """Build a family of so many problems: variants of A with a small choice."""
    chosen = family("A")
    pool = [chosen.draw(Stream(b"tiny", str(k))) for k in range(size)]

    def draw(stream: Stream) -> Draw:
        return stream.pick(pool)

    return dataclasses.replace(chosen, draw=draw)


def test_a_collision_is_drawn_again_from_the_same_stream() -> None:
    """In a family of five problems five students get all of them, a sixth none; the draws thrown away are counted."""
    tiny, taken, tally = _tiny(5), set[str](), Counter[str]()
    for student in range(5):
        variant = draw_variant(SECRET, "2026S", f"s{student}", tiny, taken=taken, tally=tally)
        assert not variant.marks & taken
        taken |= variant.marks
    assert tally["collision"] > 0
    with pytest.raises(ValueError, match="family A must have a free variant, got none in 10000 draws"):
        draw_variant(SECRET, "2026S", "s6", tiny, taken=taken)


def test_the_first_free_draw_counts() -> None:
    """Who is first keeps the numbers; the other goes on to the next ones of the own stream."""
    first = draw_variant(SECRET, "2026S", "s1", family("A"))
    second = draw_variant(SECRET, "2026S", "s1", family("A"), taken=first.marks)
    stream = SECRET.stream("variant", "2026S", "s1", "A")
    draws = [family("A").draw(stream).graph for _ in range(2)]
    assert [first.exact, second.exact] == draws


def test_answers_are_not_shared_either() -> None:
    """Other data with the same answer are a collision too."""
    first = draw_variant(SECRET, "2026S", "s1", family("A"))
    answer_only = {mark for mark in first.marks if mark.startswith("x1 ")}
    assert len(answer_only) == 1
    assert draw_variant(SECRET, "2026S", "s1", family("A"), taken=answer_only).exact != first.exact


def test_what_is_not_accepted_is_drawn_again() -> None:
    """A further demand is heard, and counted."""
    tally: Counter[str] = Counter()
    variant = draw_variant(SECRET, "t", "s1", family("A"), accept=lambda v: v.x1[-1] > 5, tally=tally)
    assert variant.x1[-1] > 5
    assert set(tally) == {"not accepted"}


def test_a_mix_is_kept_in_proportion() -> None:
    """With weights 3 and 1 about three quarters get the first family, and each always the same."""
    mix = {"A": 3, "interior-loop": 1, "D": 0}
    chosen = Counter(choose_family(SECRET, "2026S", f"s{k}", mix).label for k in range(2000))
    assert set(chosen) == {"A", "B"}
    assert abs(chosen["A"] - 1500) < 100
    assert choose_family(SECRET, "2026S", "s1", mix) is choose_family(
        SECRET, "2026S", "s1", dict(reversed(mix.items()))
    )


def test_a_secret_is_never_shown(tmp_path: Path) -> None:
    """A secret has its white space stripped, and its repr holds nothing of it."""
    path = tmp_path / "secret"
    path.write_text("  not to be shown at all \n")
    secret = read_secret(path)
    assert secret.key == b"not to be shown at all"
    assert "shown" not in f"{secret} {secret!r}"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (b"short", "holds 5 bytes; expected at least 16"),
        (b"  \n ", "holds 0 bytes; expected at least 16"),
        (b"0123456789abcdef\n0123456789abcdef", "holds several lines"),
        (b"x" * 5000, "is longer than 4096 bytes"),
    ],
)
def test_a_bad_secret_is_refused_without_being_shown(tmp_path: Path, text: bytes, words: str) -> None:
    """The message names the file and the rule, and nothing of what it holds."""
    path = tmp_path / "key"
    path.write_bytes(text)
    with pytest.raises(UsageError) as caught:
        read_secret(path)
    assert words in str(caught.value)
    assert not text.strip() or text.decode().strip()[:5] not in str(caught.value).replace(str(path), "")


def test_a_missing_secret_says_how_to_make_one(tmp_path: Path) -> None:
    """Without a file the message says how to make one."""
    with pytest.raises(UsageError, match="cannot be read .*make one with: python3 -c"):
        read_secret(tmp_path / "none")


def test_seed_and_check_tell_secrets_and_terms_apart() -> None:
    """The seed of a run and the check of a release depend on secret and term."""
    other = Secret(b"another secret of a course")
    assert len({SECRET.seed("a"), SECRET.seed("b"), other.seed("a")}) == 3
    assert len({SECRET.check("a"), SECRET.check("b"), other.check("a")}) == 3
    assert 0 <= SECRET.seed("a") < 2**32

"""Whose a submission is, and whose numbers it carries."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.problems.copied import Carried, Numbers
from autograder.problems.families import family
from autograder.problems.ledger import Ledger
from autograder.problems.matching import Match, Upload, match
from autograder.problems.roster import Student
from autograder.problems.secret import Secret
from autograder.problems.variants import Variant

CLASS = [
    Student("s1", "Ann Lee", "ann@x.edu"),
    Student("s1-b", "Bo Sö Lee", "bo@x.edu"),
    Student("s10", "Ann Lee", "ann.lee@x.edu"),
    Student("Zoë", "Zoë Müller", "zm@x.edu"),
    Student("ann@y.edu", "", ""),
]

PLACES = {
    "s1/slam1d.py": ("s1", "folder"),
    "class/S1/hw/slam1d.ipynb": ("s1", "folder"),
    "s10/s1.py": ("s10", "folder"),
    "s1-b/slam1d.py": ("s1-b", "folder"),
    "hw/s1.py": ("s1", "file name"),
    "hw/slam1d_s10.final.py": ("s10", "file name"),
    "hw/(s1) slam1d.py": ("s1", "file name"),
    "Zoe\u0308/slam1d.py": ("Zoë", "folder"),
    "ann@y.edu/a.py": ("ann@y.edu", "folder"),
    "bo@x.edu/slam1d.py": ("s1-b", "folder"),
    "bo_123/slam1d.py": ("s1-b", "folder"),
    "Zoë Müller_17_assignsubmission_file/slam1d.py": ("Zoë", "folder"),
    "hw/mullerzoe_LATE_1234_5678_slam1d.py": ("Zoë", "file name"),
    "hw\\leeboso_1234.py": ("s1-b", "file name"),
    "s11/slam1d.py": (None, ""),
    "as1/slam1d.py": (None, ""),
    "Ann Lee_3/slam1d.py": (None, ""),  # two students have this name
    "slam1d.py": (None, ""),
    "": (None, ""),
}


@pytest.mark.parametrize(("path", "whose"), PLACES.items())
def test_a_place_names_a_student(path: str, whose: tuple[str | None, str]) -> None:
    """Folder first, then file name; an id stands by itself, the longer one counts, a shared name does not."""
    (found,) = match([Upload("u", path)], CLASS)
    assert (found.student_id, found.by) == whose
    assert bool(found.note) == (found.student_id is None)


def test_metadata_come_last() -> None:
    """The notebook's metadata count where the place says nothing: an id, or a variant on record."""
    uploads = [
        Upload("a", "hw/a.ipynb", "s10"),
        Upload("b", "s1/b.ipynb", "s10"),
        Upload("c", "hw/c.ipynb", "A-123"),
        Upload("d", "hw/d.ipynb", "A-999"),
    ]
    found = match(uploads, CLASS, {"A-123": "zoë"})
    assert found[1].note == "the notebook metadata name s10"
    assert [(item.student_id, item.by) for item in found] == [
        ("s10", "notebook metadata"),
        ("s1", "folder"),
        ("Zoë", "notebook metadata"),
        (None, ""),
    ]


def test_doubt_is_said() -> None:
    """Two ids in one place decide nothing; two submissions of one student are both said."""
    both, alone, again, nobody = match(
        [
            Upload("a", "s1 and s10/x.py"),
            Upload("b", "s1/x.py"),
            Upload("c", "hw/s1.py"),
            Upload("d", "s1_s10.py", "Zoë"),
        ],
        CLASS,
    )
    assert both == Match("a", None, "", "the folder names s1 and s10; it names nobody of the roster")
    assert alone == Match("b", "s1", "folder", "s1 has 2 submissions")
    assert again == Match("c", "s1", "file name", "s1 has 2 submissions")
    assert nobody == Match("d", "Zoë", "notebook metadata", "the file name names s1 and s10")


@given(
    st.lists(st.from_regex(r"[a-z0-9][a-z0-9._@-]{0,8}[a-z0-9]", fullmatch=True), min_size=1, max_size=8, unique=True)
)
@settings(max_examples=60)
def test_everybody_is_found_in_their_own_folder(ids: list[str]) -> None:
    """Whatever ids a class has, a released folder with a submission in it is matched to its student."""
    found = match([Upload(one, f"{one}/slam1d.py") for one in ids], [Student(one) for one in ids])
    assert [(item.student_id, item.by) for item in found] == [(one, "folder") for one in ids]


SECRET = Secret(b"0123456789abcdef")


@pytest.fixture(scope="module")
def variants() -> list[Variant]:
    """Draw a class of three families; two students have the worked example."""
    letters = "AWLCEE"
    return Ledger().extend(SECRET, "2026S", {f"s{k}": family(letter) for k, letter in enumerate(letters)})


def test_own_numbers_are_never_flagged(variants: list[Variant]) -> None:
    """Right answers on one's own variant, and the data of one's own stub, belong to nobody else."""
    numbers = Numbers(variants)
    for variant in variants:
        assert numbers.in_answers(variant.student_id, variant.iterates) == []
        assert numbers.in_text(variant.student_id, repr(variant.graph.measurements.tolist())) == []


def test_somebody_elses_answers_are_flagged(variants: list[Variant]) -> None:
    """The answer and the start of another variant are recognised, up to float noise, and named."""
    numbers, other = Numbers(variants), variants[0]
    found = numbers.in_answers("s1", other.iterates + 1e-12)
    assert found == [Carried(("s0",), "the start x^(0)"), Carried(("s0",), "the answer x^(1)")]
    assert found[1].text() == "The answer x^(1): the numbers of s0."
    assert numbers.in_answers(None, other.iterates[1:2]) == [Carried(("s0",), "the answer x^(1)")]
    assert numbers.in_answers("s1", other.iterates + 0.01) == []


def test_odd_answers_are_nobodys(variants: list[Variant]) -> None:
    """No number, a huge one, or another length is no reason to suspect anybody."""
    numbers = Numbers(variants)
    for odd in (np.full((4, 5), np.nan), np.full((4, 5), 1e300), np.zeros((4, 0)), np.zeros((0, 5)), np.zeros((4, 5))):
        assert numbers.in_answers("s1", odd) == []


def test_somebody_elses_data_are_flagged(variants: list[Variant]) -> None:
    """Another student's measurements are recognised wherever they stand in a source, in their order."""
    numbers, other = Numbers(variants), variants[3]
    source = f"n = 6; u = np.array({other.graph.measurements.tolist()})  # 1e999, 12abc, .5.5"
    assert numbers.in_text("s0", source) == [Carried(("s3",), "the measurements in the source")]
    assert numbers.in_text("s3", source) == []
    assert numbers.in_text("s0", source.replace(", ", "\n,\t")) == [Carried(("s3",), "the measurements in the source")]
    assert numbers.in_text("s0", repr(other.graph.measurements[::-1].tolist())) == []


def test_the_worked_example_is_nobodys(variants: list[Variant]) -> None:
    """The worked example stands in every handout; carrying it means nothing."""
    numbers, example = Numbers(variants), variants[4]
    assert example.identifier == "worked-example"
    assert numbers.in_answers("s0", example.iterates) == []
    assert numbers.in_text("s0", repr(example.graph.measurements.tolist())) == []

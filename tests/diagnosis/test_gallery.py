"""The gallery is what its compiler makes, and shows every known mistake on a case that one can redo by hand."""

from __future__ import annotations

import json

import pytest

from autograder.diagnosis.compile import slip_is_wrong, slip_witness, written
from autograder.diagnosis.gallery import FILE, gallery
from autograder.problems.cases import Case, key, simplicity
from autograder.problems.draw import draw_distinct
from autograder.problems.plain import argument, plain
from autograder.problems.witnesses import DRAWN
from autograder.stages.catalogue import all_stages, slips

# Their numbers are too close to the right ones for any small case; they are shown on a case of the exam.
TOO_CLOSE = {
    "difference_step_too_small",
    "information_in_single_precision",
    "normal_equations_in_single_precision",
    "residual_in_single_precision",
    "step_in_single_precision",
    "single_precision_leaves_a_rest",
    "h_regularised",
}
ALL = [(stage, slip) for stage in all_stages() for slip in slips(stage.name)]
SAMPLE = ALL[:: len(ALL) // 8]


def first_wrong(stage, slip) -> Case | None:
    """Return the simplest case of the gallery that a slip gets wrong."""
    return next((case for case in gallery(stage.ladder.name) if slip_is_wrong(stage, slip, case)), None)


@pytest.mark.parametrize("stage", all_stages(), ids=lambda stage: stage.name)
def test_every_known_mistake_is_in_the_gallery(stage) -> None:
    """A slip goes wrong on some small case, most on one of two or three poses; who added one compiles it anew."""
    missing = [slip.identifier for slip in slips(stage.name) if first_wrong(stage, slip) is None]
    assert set(missing) <= TOO_CLOSE, f"run python -m autograder.diagnosis for {set(missing) - TOO_CLOSE}"


@pytest.mark.slow
@pytest.mark.parametrize(("stage", "slip"), SAMPLE, ids=[slip.identifier for _, slip in SAMPLE])
def test_the_gallery_holds_what_the_shrinker_finds(stage, slip) -> None:
    """Searched for and reduced anew, the witness of a slip is in the file."""
    witness = slip_witness(stage, slip)
    assert witness is None or key(witness) in {key(case) for case in gallery(stage.ladder.name)}


@pytest.mark.parametrize("ladder", DRAWN)
def test_the_gallery_holds_what_is_drawn(ladder: str) -> None:
    """The drawn cases are those of the strategies of today, and all cases stand from simple to rich, each once."""
    held = [key(case) for case in gallery(ladder)]
    for number, (strategy, count) in enumerate(DRAWN[ladder]):
        drawn = draw_distinct(strategy, count, f"gallery/{ladder}/{number}")
        assert {key(case) for case in drawn} <= set(held)
    assert len(set(held)) == len(held)
    assert list(gallery(ladder)) == sorted(gallery(ladder), key=simplicity)


def test_the_file_is_written_as_it_is_read() -> None:
    """One case a line, no digit lost."""
    assert written({ladder: gallery(ladder) for ladder in DRAWN}) == FILE.read_bytes()
    for ladder, cases in json.loads(FILE.read_bytes()).items():
        assert [[plain(argument(each)) for each in case] for case in cases] == cases, ladder

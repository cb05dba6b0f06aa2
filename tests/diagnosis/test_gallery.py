"""The gallery shows every known mistake on a case that one can redo by hand.

It is data: whatever compiled it, it is checked for what it must show, not for being what would be compiled today.
"""

from __future__ import annotations

import json

import pytest

from autograder.diagnosis.compile import slip_is_wrong, slip_witness, written
from autograder.diagnosis.gallery import FILE, gallery
from autograder.problems.cases import Case, fields, key, simplicity
from autograder.problems.graphs import tells, well_posed
from autograder.problems.plain import argument, plain
from autograder.problems.witnesses import DRAWN
from autograder.stages.catalogue import all_stages, slips
from reference_solution import slam1d
from tests.problems.features import has
from tests.stages.answering import verdicts

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
FACETS = list(dict.fromkeys(stage.facet(rung.name) for stage in all_stages() for rung in stage.ladder.rungs))
ALL = [(stage, slip) for stage in all_stages() for slip in slips(stage.name)]
SAMPLE = [(stage, slip) for stage, slip in ALL if slip.identifier not in TOO_CLOSE][:: len(ALL) // 8]


def first_wrong(stage, slip) -> Case | None:
    """Return the simplest case of the gallery that a slip gets wrong."""
    return next((case for case in gallery(stage.ladder.name) if slip_is_wrong(stage, slip, case)), None)


@pytest.mark.parametrize("stage", all_stages(), ids=lambda stage: stage.name)
def test_every_known_mistake_is_in_the_gallery(stage) -> None:
    """A slip goes wrong on some small case, most on one of two or three poses; who added one compiles it anew."""
    missing = [slip.identifier for slip in slips(stage.name) if first_wrong(stage, slip) is None]
    assert set(missing) <= TOO_CLOSE, f"run python -m autograder.diagnosis for {set(missing) - TOO_CLOSE}"


@pytest.mark.parametrize("stage", FACETS, ids=lambda stage: stage.function)
def test_the_reference_is_right_on_all_of_it(stage) -> None:
    """Nobody is shown a case that a right answer gets wrong."""
    found = gallery(stage.ladder.name)
    assert verdicts(stage, found, getattr(slam1d, stage.function)).all()


@pytest.mark.parametrize("ladder", DRAWN)
def test_cases_stand_from_simple_to_rich(ladder: str) -> None:
    """Each case once, the simplest first; of seven rows and poses at the most, so that one can redo it by hand."""
    found = gallery(ladder)
    assert len({key(case) for case in found}) == len(found)
    assert list(found) == sorted(found, key=simplicity)
    assert len(found) >= sum(count for _, count in DRAWN[ladder])
    assert max(max(array.shape, default=1) for case in found for each in case for array in fields(each)) <= 10


def test_cases_keep_the_bounds_of_the_exam() -> None:
    """A student is shown no graph that the contract rules out, nor a loop that tells nothing."""
    assert all(well_posed(*case) for case in gallery("graphs"))
    assert all(tells(*case) for case in gallery("loops"))


@pytest.mark.parametrize("feature", ["three and more priors", "several parts", "a lonely pose", "a step below 1 mm"])
def test_mistakes_that_nobody_has_met_are_seen_on_small_cases(feature: str) -> None:
    """The families of the exam that a small graph can show are in the gallery, too."""
    assert sum(has("graphs", feature, case) for case in gallery("graphs")) >= 3


@pytest.mark.slow
@pytest.mark.parametrize(("stage", "slip"), SAMPLE, ids=[slip.identifier for _, slip in SAMPLE])
def test_the_compiler_finds_a_small_witness(stage, slip) -> None:
    """Searched for and reduced with whatever Hypothesis is installed, the witness is small, and wrong by this slip."""
    witness = slip_witness(stage, slip)
    assert witness is not None
    assert slip_is_wrong(stage, slip, witness)
    assert simplicity(witness)[0] <= 2 * simplicity(first_wrong(stage, slip))[0]


def test_the_file_is_written_as_it_is_read() -> None:
    """One case a line, no digit lost."""
    assert written({ladder: gallery(ladder) for ladder in DRAWN}) == FILE.read_bytes()
    for ladder, cases in json.loads(FILE.read_bytes()).items():
        assert [[plain(argument(each)) for each in case] for case in cases] == cases, ladder

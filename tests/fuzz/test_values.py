"""Nothing that a function returns is the grader's fault, and no page says what is not so."""

import pytest

from tests.fuzz.anything import ARGUMENTS, COMPOSED, FORMS, KINDS, PARTED, RULES, drawn
from tests.fuzz.values import grade

COUNT = 60


def test_any_value_is_graded_and_described_truly(tmp_path):
    """Any shape and kind, changing between calls, sizes and processes: graded, and every claim holds."""
    faults = grade(seed=0, count=COUNT, folder=tmp_path, examples=10)
    assert not faults, "\n".join(faults)


def test_the_drawn_submissions_are_of_every_kind():
    """Sixty submissions hold every rule and every function, and a third of all values."""
    submissions = [drawn(f"0 {number}") for number in range(COUNT)]
    behaviours = [each for submission in submissions for each in submission.behaviours.values()]
    assert {each.rule for each in behaviours} == set(RULES)
    assert {each.function for each in behaviours} == set(ARGUMENTS)
    assert any(COMPOSED in submission.text for submission in submissions)
    values = {value.code for each in behaviours for value in each.values}
    every = {value.code for kind in [*KINDS, PARTED] for value in kind}
    assert len(values) > len(every) / 3
    assert all(any(value.code in values for value in kind) for kind in [*KINDS, FORMS])


@pytest.mark.parametrize("seed", ["0 0", "0 1"])
def test_a_seed_draws_the_same_submission(seed):
    """A run can be repeated."""
    assert drawn(seed) == drawn(seed)

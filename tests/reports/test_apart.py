"""Names that are shortened stay names: whatever they are, no two of them look the same."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from autograder.reports.apart import apart
from autograder.reports.terminal import class_table
from tests.reports.examples import result, stage

MUELLERS = ["müller_thomas_10234", "müller_thomas_10243", "müller_tina_20001", "müller_anna_maria_20002"]


@given(st.sets(st.text("ab_", min_size=1, max_size=20), min_size=1, max_size=6), st.integers(8, 20))
def test_no_two_names_look_the_same(names: set[str], width: int) -> None:
    """As many texts as names; each within the width, or the whole name."""
    shown = apart(sorted(names), width)
    assert len(set(shown.values())) == len(names)
    assert all(len(text) <= width or text == name for name, text in shown.items())


def test_four_people_of_one_name_are_told_apart() -> None:
    """In a narrow terminal too, and their marks stand under each other."""
    class_of_four = [result(name, stage("residual", "passed")) for name in MUELLERS]
    for width in (60, 80, 100):
        lines = [line.plain for line in class_table(class_of_four, width)]
        rows = [line for line in lines if " graded " in line]
        assert (len(rows), len({line.split()[0] for line in rows})) == (4, 4)
        assert len({line.index("graded") for line in rows}) == 1

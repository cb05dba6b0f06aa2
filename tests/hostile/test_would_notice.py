"""The corpus would notice a lock that does not hold: with all locks off, most of its attempts get through.

Cases that would take the machine's memory are left out of the runs without locks; each says so in
its second line. These runs have namespaces and folders of their own, and are skipped where there are none.
"""

from __future__ import annotations

import pytest

from tests.hostile import attempts, corpus, traces

CASES = [case for case in corpus.cases() if case.attempts]
NAMES = [case.name for case in CASES]
TRIED = sum(len(case.attempts) for case in CASES)
MAJORITY = 0.6  # of the attempts; measured: 0.8 as root, 0.77 as an ordinary user


def run(*, locked: bool, ordinary: bool) -> dict[str, list[str]]:
    """Make all attempts, or skip the test."""
    found = attempts.in_a_place_to_throw_away(NAMES, locked=locked, ordinary=ordinary)
    if found is None:
        pytest.skip("no namespaces of its own here" if not locked else "no ordinary user that can run Python here")
    return found


@pytest.mark.parametrize("ordinary", [False, True], ids=["this user", "ordinary user"])
def test_with_the_locks_nothing_gets_through(ordinary: bool) -> None:
    """Not one of the attempts succeeds, for root as for an ordinary user."""
    found = run(locked=True, ordinary=ordinary)
    assert {name: won for name, won in found.items() if won} == {}
    assert len(found) == len(CASES)
    assert traces.found() == []


def test_without_the_locks_most_get_through() -> None:
    """A corpus whose attempts fail anyway would show nothing; every case that claims to succeed does."""
    assert not any(case.destructive for case in CASES)
    found = run(locked=False, ordinary=False)
    assert sum(map(len, found.values())) > MAJORITY * TRIED
    assert [case.name for case in CASES if case.escapes and not found[case.name]] == []
    assert [case.name for case in CASES if not case.escapes and found[case.name]] == []
    assert traces.found() == []


def test_without_the_locks_most_get_through_for_an_ordinary_user() -> None:
    """Most attempts need no root."""
    found = run(locked=False, ordinary=True)
    assert sum(map(len, found.values())) > MAJORITY * TRIED
    assert traces.found() == []

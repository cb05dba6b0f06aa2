"""A short run of what `tests/fuzz/frames.py` does with a million frames."""

from __future__ import annotations

from tests.fuzz.frames import fuzz


def test_random_frames_are_read_or_refused() -> None:
    """Ten thousand frames and a few hundred streams raise nothing but our own refusals; each end occurs."""
    became = fuzz(10_000, seed=0, streams=300)
    assert {"read", "refused", "violation", "stream read", "stream violation", "stream died"} <= set(became), became

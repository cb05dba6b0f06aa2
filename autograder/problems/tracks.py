"""Hypothesis keeps what it computes in a folder beside the user's files; here it keeps nothing."""

from __future__ import annotations

import os
from pathlib import Path

from hypothesis.configuration import set_hypothesis_home_dir


def leave_no_tracks() -> None:
    """Tell Hypothesis to store nothing, whatever folder the program was started in.

    Below a device no folder can be made; Hypothesis then goes on without a store.
    """
    set_hypothesis_home_dir(Path(os.devnull) / "hypothesis")

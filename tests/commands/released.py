"""A class with a release: the roster, the command that releases it, and what a student makes of a folder."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from autograder.problems.conclusion import RIGHT, choices
from autograder.problems.ledger import Ledger, read_ledger
from autograder.problems.release import LEDGER
from autograder.problems.variants import Variant
from autograder.render.stub import reference_source

TERM = "2026S"
SECRET = "0123456789abcdef0123456789abcdef"
CLASS = "student_id,name,email,group\ns1,Ann Lee,ann@x.org,1\ns2,Bo Ray,bo@x.org,1\ns3,Cy Tan,cy@x.org,2\n"


def files_of_the_course(folder: Path) -> dict[str, Path]:
    """Write roster and secret; return the options that every command takes."""
    roster, secret = folder / "class.csv", folder / "secret.txt"
    roster.write_text(CLASS)
    secret.write_text(SECRET + "\n")
    return {"--roster": roster, "--secret-file": secret}


def options(files: dict[str, Any], **more: object) -> list[object]:
    """List the options of a command, the term among them."""
    given = {**files, "--term": TERM, **{f"--{name.replace('_', '-')}": value for name, value in more.items()}}
    return [word for pair in given.items() for word in pair]


def ledger_of(release: Path) -> Ledger:
    """Read the ledger of a release."""
    return read_ledger(release / LEDGER)


def variant_of(release: Path, student_id: str) -> Variant:
    """Return what a student was given."""
    variant = ledger_of(release).get(student_id)
    assert variant is not None
    return variant


def letter(variant: Variant) -> str:
    """Return the letter of the right choice."""
    return next(choice.letter for choice in choices(variant.identifier) if choice.identifier == RIGHT)


def module(variant: Variant) -> str:
    """Write the reference with the answers of a variant, as a student would hand it in."""
    answers = f"iterates = np.array({np.asarray(variant.iterates).tolist()})\nconclusion = {letter(variant)!r}\n"
    return f"{reference_source()}\nmy_u = {variant.graph.measurements.tolist()}\n{answers}"

"""Everything whose verdict is known: the reference, the stub, the specimens, and every slip as a submission."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import assignment
import autograder
import reference_solution
from autograder.audit.expectation import CAUGHT, KEPT, Expected, expected
from autograder.errors import UsageError
from autograder.intake.submission import Submission, collect
from autograder.sandbox.frames import Source
from autograder.stages.base import Slip, Stage
from autograder.stages.catalogue import slips
from autograder.stages.slips.submission import submission_text

SPECIMENS = Path(autograder.__file__).parent / "specimens"
FOLDERS = ("correct", "equivalent", "disputed", "wrong", "sample", "hostile")
KINDS = ("reference", "stub", *FOLDERS, "slip")


@dataclass(frozen=True)
class Case:
    """One submission with the verdict that it must get; a slip says of which stage."""

    kind: str
    name: str
    source: Source
    expected: Expected
    slip_of: str = ""


def all_cases(stages: Sequence[Stage], specimens: Path = SPECIMENS) -> list[Case]:
    """Collect every case.

    Parameters
    ----------
    stages : sequence of Stage
        The stages of the exam; their slips are cases.
    specimens : Path
        The folder of the specimens.

    Returns
    -------
    list of Case
        By kind, then by name.

    Raises
    ------
    UsageError
        Where a specimen cannot be read, or its first line states no verdict.
    """
    found = [*_single("reference", reference_solution.__path__[0], "passed")]
    found += _single("stub", assignment.__path__[0], "missing")
    for folder in FOLDERS:
        if (specimens / folder).is_dir():
            found += [_specimen(folder, one) for one in collect([specimens / folder])]
    found += [_slip(stage, stages, slip) for stage in stages for slip in slips(stage.name)]
    return found


def _single(kind: str, folder: str, status: str) -> Iterator[Case]:
    """Take the module and the notebook of a package."""
    for suffix in (".py", ".ipynb"):
        (found,) = collect([Path(folder) / f"slam1d{suffix}"])
        yield Case(kind, f"slam1d{suffix}", _source(found), Expected(others=status))


def _specimen(folder: str, found: Submission) -> Case:
    source = _source(found)
    first_line = next(iter("".join(source.cells[:1]).splitlines()), "")
    try:
        verdict = expected(first_line)
    except ValueError as error:
        raise UsageError(f"The specimen {found.path} states no verdict: {error}.") from None
    return Case(folder, Path(found.path).name, source, verdict)


def _source(found: Submission) -> Source:
    if found.source is None:
        raise UsageError(f"{found.path} could not be read ({found.rejection}); mend the file or remove it.")
    return found.source


def _slip(stage: Stage, stages: Sequence[Stage], slip: Slip) -> Case:
    """Demand that a slip is named at its own stage, and costs no other that calls another function."""
    spared = {
        other.name: (KEPT if stage.name in other.builds_on else "passed", "", False)
        for other in stages
        if other.function != stage.function
    }
    wanted = Expected(stages={**spared, stage.name: (CAUGHT, slip.identifier, False)}, sentence=slip.name)
    text = submission_text(slip, stage.function)
    return Case("slip", slip.identifier, Source("module", [text], f"{slip.identifier}.py"), wanted, stage.name)

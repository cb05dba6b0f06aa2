"""Judge every mutant of the reference by the autograder, and print which are caught, where, and which are not.

Run by `make mutants`. A mutant that no stage fails is a hole in the exam, unless it is listed in
`EQUIVALENT` with the reason why it behaves as the reference does.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path

import reference_solution
from autograder.audit.examine import examine
from autograder.course import Course
from autograder.engine.exam import draw_exam
from autograder.sandbox.frames import Source
from autograder.stages.catalogue import all_stages
from tests.mutation.mutants import Mutant, mutants

EXAMPLES = 20

_SYMMETRIC = "the two legs of a right-angled triangle may be given in either order"

# The changed line of a mutant that behaves as the reference does, and why.
EQUIVALENT = {
    "if not TYPE_CHECKING:  # only for readers and type checkers: this module runs without it": (
        "the import binds a stand-in for a module that no submission has, and annotations are never evaluated"
    ),
    "distance = np.hypot(ranging.beacon[1], x[ranging.poses] - ranging.beacon[0])": _SYMMETRIC,
    "J[np.arange(len(ranging.poses)), ranging.poses] = ahead / np.hypot(ranging.beacon[1], ahead)": _SYMMETRIC,
}


def main() -> int:
    """Print the table; 1 where a mutant survives without a reason, or a reason has no survivor."""
    source = (Path(reference_solution.__path__[0]) / "slam1d.py").read_text("utf-8")
    found = list(mutants(source))
    stages = tuple(all_stages())
    examined = examine(
        [Source("module", [mutant.text], f"mutant {number}") for number, mutant in enumerate(found)],
        stages,
        draw_exam(0, EXAMPLES),
        Course(),
        lambda done, total, _: print(f"\r{done} of {total} mutants", end="", file=sys.stderr, flush=True),
    )
    print(file=sys.stderr)
    names = {stage.name for stage in stages}
    first = [
        next((verdict.name for verdict in verdicts if verdict.name in names and verdict.status != "passed"), "")
        for verdicts in examined.verdicts
    ]
    return table(found, first)


def table(found: list[Mutant], first: list[str]) -> int:
    """Print the operators with their counts, the stages that notice first, and every survivor."""
    print(f"{'operator':34} {'mutants':>7} {'caught':>6} {'survived':>8}")
    kinds = [_kind(mutant) for mutant in found]
    for operator, count in sorted(Counter(kinds).items()):
        caught = sum(bool(stage) for kind, stage in zip(kinds, first, strict=True) if kind == operator)
        print(f"{operator:34} {count:7} {caught:6} {count - caught:8}")
    print()
    for stage, count in Counter(stage for stage in first if stage).items():
        print(f"{count:4} caught first by {stage}")
    survivors = [mutant for mutant, stage in zip(found, first, strict=True) if not stage]
    print(f"{len(survivors):4} survive")
    for mutant in survivors:
        reason = EQUIVALENT.get(mutant.new, "NOT EXPLAINED: a hole in the exam")
        print(f"\n  - {mutant.old}\n  + {mutant.new}\n    {reason}")
    stale = sorted(set(EQUIVALENT) - {mutant.new for mutant in survivors})
    for line in stale:
        print(f"\n  {line}\n    is listed as equivalent, and is caught or no longer made")
    holes = [mutant for mutant in survivors if mutant.new not in EQUIVALENT]
    print(
        f"\n{len(found)} mutants, {len(found) - len(survivors)} caught, {len(survivors)} equivalent or not caught; "
        f"{len(holes)} holes."
    )
    return 1 if holes or stale else 0


def _kind(mutant: Mutant) -> str:
    """Name an operator; those that replace the same sign by different ones are one kind."""
    return re.sub(r"(Replace(?:Binary|Unary)Operator_[A-Z][a-z]+)_.*", r"\1", mutant.operator)


if __name__ == "__main__":
    sys.exit(main())

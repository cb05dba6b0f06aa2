"""Reads the hostile specimens: what each attacks, how many attempts it makes, and the verdict it must get."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from pathlib import Path

from autograder.audit.expectation import Expected, expected
from autograder.stages.catalogue import all_stages
from tests.specimens.first_line import SPECIMENS, code, submissions

SECTIONS = ("secrets", "forging", "patching", "lying", "leaving", "exhaustion", "escape", "text")
ATTACK = re.compile(rf"# attack: ({'|'.join(SECTIONS)}); unlocked (succeeds|fails: [^;]+|left out: [^;]+)\.")
NUMBERS = re.compile(r"(\d+): ")
PREFIX = "slam1d-hostile"  # begins the name of everything that a specimen tries to leave behind

# Which limit is met first depends on the limits and on the machine.
ENDED = frozenset({"error", "timeout", "memory", "ended"})


@dataclass(frozen=True)
class Case:
    """One hostile specimen; `attempts` are the names of those that pay if they get through."""

    path: Path
    number: int
    section: str
    unlocked: str
    expected: Expected
    attempts: tuple[str, ...]

    @property
    def name(self) -> str:
        """What its submission is called."""
        return self.path.stem

    @property
    def escapes(self) -> bool:
        """Whether it must succeed where no lock is on."""
        return self.unlocked == "succeeds"

    @property
    def destructive(self) -> bool:
        """Whether it must not run without the locks."""
        return self.unlocked.startswith("left out")

    def honest(self) -> float:
        """Return the most points that its honest part earns: what is stated as right, also by itself, or a quarter."""
        share = {"passed": 1.0, "partial": 0.25}
        alone = {name for name, (_, _, by_itself) in self.expected.stages.items() if by_itself}
        return sum(
            stage.points * (1.0 if stage.name in alone else share.get(self.expected.status(stage.name), 0.0))
            for stage in all_stages()
            if not stage.bonus or stage.name in self.expected.stages
        )


def cases() -> list[Case]:
    """Read all hostile specimens, by number."""
    return sorted(map(_read, submissions("hostile")), key=lambda case: (case.number, case.name))


def _read(path: Path) -> Case:
    cells = code(path)
    first, second = cells[0].splitlines()[:2]
    verdict, attack = expected(first), ATTACK.fullmatch(second)
    number = NUMBERS.match(verdict.sentence)
    if attack is None or number is None:
        raise ValueError(f"{path.name}: got {second!r} and {verdict.sentence!r}, expected the form of the README")
    return Case(path, int(number[1]), attack[1], attack[2].partition(":")[0], verdict, _attempts(cells))


def _attempts(cells: list[str]) -> tuple[str, ...]:
    """List the functions that are marked as attempts; a notebook has none."""
    if len(cells) > 1:
        return ()
    return tuple(
        node.name
        for node in ast.parse(cells[0]).body
        if isinstance(node, ast.FunctionDef)
        and any(isinstance(mark, ast.Name) and mark.id == "attempt" for mark in node.decorator_list)
    )


def folder() -> Path:
    """Return where the hostile specimens lie."""
    return SPECIMENS / "hostile"

"""variants.csv, the ledger: which student got which numbers. Lines are added, never changed.

It holds everything that grading needs, without the secret; a released variant stays what it was,
whatever happens to the roster, the families or this program.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

from autograder.errors import UsageError
from autograder.problems.exact import ExactGraph, decimal
from autograder.problems.family import Family
from autograder.problems.replacing import replace_file
from autograder.problems.roster import normal_id
from autograder.problems.secret import Secret
from autograder.problems.variants import Variant, data_fields, draw_variant, published

__all__ = ["COLUMNS", "Ledger", "ledger_text", "read_ledger", "write_ledger"]

COLUMNS = ("student_id", "family", "variant", "data")
_NUMBER = re.compile(r"-?\d{1,9}(\.\d{1,9})?", re.ASCII)


@dataclass
class Ledger:
    """Variants by student id, in the order in which they were released.

    Examples
    --------
    >>> from autograder.problems.families import family
    >>> ledger = Ledger()
    >>> new = ledger.extend(Secret(b"0123456789abcdef"), "2026", {"s2": family("A"), "s1": family("W")})
    >>> [variant.student_id for variant in new], len(ledger), "s1" in ledger
    (['s1', 's2'], 2, True)
    """

    _variants: dict[str, Variant] = field(default_factory=dict)
    _taken: set[str] = field(default_factory=set)

    def __len__(self) -> int:
        return len(self._variants)

    def __iter__(self) -> Iterator[Variant]:
        return iter(self._variants.values())

    def __contains__(self, student_id: object) -> bool:
        return isinstance(student_id, str) and _key(student_id) in self._variants

    def get(self, student_id: str) -> Variant | None:
        """Return a student's variant, or None; capital letters do not count."""
        return self._variants.get(_key(student_id))

    def add(self, variant: Variant) -> None:
        """Enter one more variant.

        Raises
        ------
        ValueError
            Where the student has one already, or the numbers are somebody else's.
        """
        if variant.student_id in self:
            raise ValueError(f"a student gets one variant, got a second one for {variant.student_id!r}")
        if variant.fingerprint != published().fingerprint:
            if variant.marks & self._taken:
                raise ValueError(f"no two students may get the same numbers, got {variant.fingerprint} twice")
            self._taken |= variant.marks
        self._variants[_key(variant.student_id)] = variant

    def extend(
        self,
        secret: Secret,
        term: str,
        wanted: Mapping[str, Family],
        *,
        accept: Callable[[Variant], bool] | None = None,
        tally: Counter[str] | None = None,
    ) -> list[Variant]:
        """Draw and enter a variant for everybody who has none; return the new ones.

        The order is that of the ids, so that the order of the roster does not matter.

        Parameters
        ----------
        secret, term
            What the streams depend on.
        wanted : mapping
            Student id -> family.
        accept, tally
            As for `draw_variant`.
        """
        new = []
        for student_id, family in sorted(wanted.items()):
            if student_id not in self:
                taken = self._taken
                variant = draw_variant(secret, term, student_id, family, taken=taken, accept=accept, tally=tally)
                self.add(variant)
                new.append(variant)
        return new


def read_ledger(path: Path) -> Ledger:
    """Read a ledger and check every line of it: fingerprint, exact answer, no numbers twice.

    Raises
    ------
    UsageError
        Where the file cannot be read or a line is damaged; with the line.
    """
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise UsageError(f"Ledger {path} cannot be read ({reason}); expected the variants.csv of a release.") from None
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    ledger = Ledger()
    try:
        if next(reader, None) != list(COLUMNS):
            raise UsageError(f"Ledger {path}, line 1: expected the headings {','.join(COLUMNS)}.")
        for row in reader:
            try:
                ledger.add(_variant(row))
            except (ValueError, KeyError, TypeError, IndexError, RecursionError) as error:
                raise UsageError(
                    f"Ledger {path}, line {reader.line_num}: it is damaged ({error}); restore it from a copy."
                ) from None
    except csv.Error as error:
        raise UsageError(f"Ledger {path}, line {reader.line_num}: it is no proper CSV ({error}).") from None
    return ledger


def ledger_text(ledger: Ledger) -> bytes:
    """Return a ledger as it stands in its file."""
    return "".join(_lines(ledger)).encode("utf-8")


def write_ledger(path: Path, ledger: Ledger) -> bool:
    """Write a ledger in one stroke; return whether anything was new.

    Raises
    ------
    UsageError
        Where the file holds a line that the ledger does not begin with: nothing is ever taken back.
    """
    text = ledger_text(ledger)
    old = path.read_bytes() if path.exists() else b""
    if old == text:
        return False
    if not text.startswith(old):
        raise UsageError(f"Ledger {path} holds lines that would be lost; nothing was written.")
    replace_file(path, text, lasting=True)
    return True


def _lines(variants: Iterable[Variant]) -> Iterator[str]:
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(COLUMNS)
    for variant in variants:
        fields = data_fields(variant.exact) | {
            "x1": [decimal(value) for value in variant.x1],
            "truth": [decimal(value) for value in variant.truth],
            "landmarks": list(variant.landmarks),
        }
        data = json.dumps(fields, separators=(",", ":"))
        writer.writerow([variant.student_id, variant.family, variant.identifier, data])
    yield buffer.getvalue()


def _variant(row: list[str]) -> Variant:
    """Rebuild one variant from its line, and check it."""
    student_id, family, identifier, data = row
    fields = json.loads(data)
    if normal_id(student_id) != student_id or not student_id:
        raise ValueError(f"{student_id!r} is no student id")
    exact = ExactGraph(
        n_poses=_integer(fields["n"]),
        edges=tuple((_integer(i), _integer(j)) for i, j in fields["edges"]),
        measurements=_fractions(fields["u"]),
        edge_variances=_fractions(fields["v"]),
        priors=tuple(map(_integer, fields["priors"])),
        prior_means=_fractions(fields["means"]),
        prior_variances=_fractions(fields["prior_v"]),
    )
    x1, truth = _fractions(fields["x1"]), _fractions(fields["truth"])
    landmarks = tuple(map(_integer, fields["landmarks"]))
    exact.posegraph()  # holds every rule of the model
    variant = Variant(family, student_id, exact, x1, truth, landmarks)
    if variant.identifier != identifier:
        raise ValueError(f"the data are those of {variant.identifier}, not of {identifier}")
    if len(x1) != exact.n_poses or len(truth) != exact.n_poses or any(exact.gradient(x1)):
        raise ValueError("x1 does not solve the normal equations")
    return variant


def _fractions(texts: list[Any]) -> tuple[Fraction, ...]:
    for text in texts:
        if not isinstance(text, str) or not _NUMBER.fullmatch(text):
            raise ValueError(f"{text!r} is no decimal number")
    return tuple(map(Fraction, texts))


def _integer(value: Any) -> int:
    if type(value) is not int:
        raise ValueError(f"{value!r} is no whole number")
    return value


def _key(student_id: str) -> str:
    return normal_id(student_id).casefold()

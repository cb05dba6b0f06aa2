"""What the grader gets back: numbers and bounded words, rebuilt from a child's bytes and checked."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from autograder.sandbox.frames import (
    MAX_DIMENSIONS,
    MAX_REASON,
    AnswerData,
    Batch,
    BatchReport,
    Kind,
    Outcome,
    Source,
    Status,
    reply_bound,
)

_LAST_OUTCOME = max(Outcome)
_LAST_KIND = max(Kind)


_PLACE = re.compile(r"(.*) \[([0-9]{1,6}):([0-9]{1,7})\]", re.DOTALL)
_LINE_END = re.compile(r"\r\n|\r|\n")  # as Python counts lines
MOST_SHOWN, _MOST_SCANNED = 100, 1000  # characters of a line

Table = tuple[list[tuple[int, ...]], np.ndarray]
"""Shapes and offsets."""


@dataclass(frozen=True)
class Expected:
    """What of a batch its outputs are checked against; it remembers the table of shapes that was checked last.

    Most submissions return the same shapes for the same calls, so most tables are known, byte for byte.
    """

    cases: int
    parts: int
    most: int
    bound: int
    _checked: dict[tuple[bytes, ...], Table] = field(default_factory=dict, repr=False, compare=False)

    def table(self, report: BatchReport) -> Table:
        """Check outcome, kinds and shapes of a report; raises Violation where they do not fit."""
        said = report.outcome, report.kinds, report.dimensions, report.sizes
        found = self._checked.get(said)
        if found is None:
            found = _table(report, self)
            self._checked.clear()
            self._checked[said] = found
        return found

    @classmethod
    def of(cls, batch: Batch) -> Expected:
        """Read it off a batch."""
        return cls(len(batch.cases), batch.parts, batch.max_elements, reply_bound(batch))


class Violation(Exception):  # noqa: N818  # an outcome of a run, caught by the session
    """A child sent what no honest child sends."""


@dataclass(frozen=True)
class Note:
    """A statement of a submission that was skipped; `where` is "line 12" or "cell 3, line 2"."""

    where: str
    status: Status
    message: str


@dataclass(frozen=True)
class Answers:
    """The student's answers for the own variant; None is unfinished, `bad` says what could not be used."""

    iterates: np.ndarray | None = None
    conclusion: str | None = None
    written_2: str | None = None
    written_3: str | None = None
    bad: str = ""

    def said_of(self, name: str) -> str:
        """Return what is said of an answer that could not be used; "" where it is there, or nobody wrote one.

        Examples
        --------
        >>> Answers(bad="iterates: got a dict; conclusion: got an int").said_of("conclusion")
        'got an int'
        """
        parts = self.bad.split("; ")
        return next((part.removeprefix(f"{name}: ") for part in parts if part.startswith(f"{name}: ")), "")


@dataclass(frozen=True)
class Fate:
    """Why a function is not there, or is not the one that was meant.

    `tried` says that somebody tried to write it: then it is an error, and else it is missing.
    `written` says that something was written that may have been meant: then staff hear of it.
    """

    message: str
    tried: bool
    written: bool


@dataclass(frozen=True)
class Loaded:
    """What a submission defines once it is executed; `fates` says what became of functions that are asked for."""

    functions: frozenset[str] = frozenset()
    notes: tuple[Note, ...] = ()
    answers: Answers = Answers()
    fates: Mapping[str, Fate] = field(default_factory=dict)


@dataclass(frozen=True)
class Failure:
    """Why a batch gave no values at all; the message is for the student and holds no measured time.

    `sure` is False where time ran out by the clock alone, and computing time was left.
    """

    reason: Literal["timeout", "memory", "died", "output", "violation", "budget"]
    message: str
    sure: bool = True


@dataclass(frozen=True)
class Outputs:
    """The values of a batch, as views over one buffer.

    Parameters
    ----------
    outcome : (cases,) uint8 array
        An `Outcome` for every case.
    kinds : (cases * parts,) uint8 array
        A `Kind` for every value; advisory.
    shapes : list of tuple of int
        The shape of every value; () where the outcome is not OK.
    offsets : (cases * parts + 1,) int64 array
        Where in `data` each value begins; a value without elements begins where the next one does.
    data : (total,) float64 array
        All elements, each value in C order. They may be infinite or NaN.
    reasons : dict of int to str
        Words for the cases that are not OK; a batch has a bounded number of different ones.
    mutated : int
        The first case whose input array the call changed in place, -1 if none.
    reshaped : "", "column" or "row"
        What was read as the vector that it stands for, if anything; set when the engine normalises.
    """

    outcome: np.ndarray
    kinds: np.ndarray
    shapes: list[tuple[int, ...]]
    offsets: np.ndarray
    data: np.ndarray
    reasons: dict[int, str]
    mutated: int
    reshaped: Literal["", "column", "row"] = ""


def read_outputs(report: BatchReport, expected: Expected, source: Source | None = None) -> Outputs:
    """Check a report against what was asked for; raises Violation where it does not fit.

    With the source, words that name one of its lines show that line.
    """
    shapes, offsets = expected.table(report)
    if report.mutated >= expected.cases:
        raise Violation("a table is not of the length that it says")
    if int(offsets[-1]) * 8 != len(report.data):
        raise Violation("the data are not as long as the shapes say")
    outcome, kinds = np.frombuffer(report.outcome, np.uint8), np.frombuffer(report.kinds, np.uint8)
    reasons = {call: with_line(words, source) for call, words in _reasons(report.reasons, expected.cases).items()}
    return Outputs(outcome, kinds, shapes, offsets, np.frombuffer(report.data, "<f8"), reasons, report.mutated)


def _reasons(said: dict[str, bytes], cases: int) -> dict[int, str]:
    if sum(map(len, said.values())) > 4 * cases or any(len(calls) % 4 for calls in said.values()):
        raise Violation("there are more reasons than calls")
    found = {call: words for text, calls in said.items() for words in [printable(text)] for call in _numbers(calls)}
    if found and not 0 <= min(found) <= max(found) < cases:
        raise Violation("a reason is given for a call that was not asked for")
    return dict(sorted(found.items()))


def _numbers(calls: bytes) -> list[int]:
    found: list[int] = np.frombuffer(calls, "<i4").tolist()
    return found


def _table(report: BatchReport, expected: Expected) -> Table:
    cases, parts = expected.cases, expected.parts
    values = cases * parts
    if not len(report.outcome) == cases or not len(report.kinds) == len(report.dimensions) == values:
        raise Violation("the number of values is not that of the calls")
    if len(report.sizes) % 8:
        raise Violation("a table is not of the length that it says")
    outcome, kinds = np.frombuffer(report.outcome, np.uint8), np.frombuffer(report.kinds, np.uint8)
    if (cases and outcome.max() > _LAST_OUTCOME) or (values and kinds.max() > _LAST_KIND):
        raise Violation("an outcome or a kind does not exist")
    shapes = _shapes(report.dimensions, np.frombuffer(report.sizes, "<i8").tolist(), expected.most)
    fine = np.repeat(outcome == Outcome.OK, parts)
    products = list(map(math.prod, shapes))
    if max(products, default=0) > max(expected.most, 1) or any(shapes[at] for at in np.flatnonzero(~fine).tolist()):
        raise Violation("a shape is not one that may be reported")
    offsets = np.zeros(values + 1, np.int64)
    np.cumsum(np.array(products, np.int64) * fine, out=offsets[1:])
    return shapes, offsets


def _shapes(dimensions: bytes, sizes: list[int], most: int) -> list[tuple[int, ...]]:
    if sum(dimensions) != len(sizes) or max(dimensions, default=0) > MAX_DIMENSIONS:
        raise Violation("the shapes do not fit their dimensions")
    if min(sizes, default=0) < 0 or max(sizes, default=0) > most:
        raise Violation("a shape has a side of impossible length")
    first = dimensions[0] if dimensions else 0
    if first and dimensions == bytes([first]) * len(dimensions):  # as nearly always
        return list(zip(*[iter(sizes)] * first, strict=True))
    shapes, at = [], 0
    for count in dimensions:
        shapes.append(tuple(sizes[at : at + count]))
        at += count
    return shapes


def read_answers(data: AnswerData) -> Answers:
    """Rebuild the answers; raises Violation where shape and data do not fit."""
    iterates = None
    if data.iterates_shape is not None:
        if math.prod(data.iterates_shape) * 8 != len(data.iterates):
            raise Violation("the iterates are not as long as their shape says")
        iterates = np.frombuffer(data.iterates, "<f8").reshape(data.iterates_shape)
    return Answers(iterates, data.conclusion, data.written_2, data.written_3, printable(data.bad, 4 * MAX_REASON))


def printable(text: str, most: int = MAX_REASON) -> str:
    """Keep of a stranger's words what can be printed, on one line, up to a bound.

    Examples
    --------
    >>> printable("ValueError: " + chr(27) + "[31mbad" + chr(10) + "luck")
    'ValueError: [31mbad luck'
    """
    shown = "".join(letter if letter.isprintable() else " " for letter in text[: 2 * most])
    return " ".join(shown.split())[:most]


def with_line(words: str, source: Source | None) -> str:
    r"""Put the line of the submission's own text in the place of the numbers by which a child names it.

    Examples
    --------
    >>> with_line("IndexError: too far [0:2]", Source("module", ["def f(x):\n    return x[4]"], "a.py"))
    'IndexError: too far, in line 2: `return x[4]`'
    >>> with_line("IndexError: too far [7:2]", None)
    'IndexError: too far'
    """
    found = _PLACE.fullmatch(words)
    if not found:
        return words
    cell, line = int(found[2]), int(found[3])
    lines = _LINE_END.split(source.cells[cell]) if source is not None and cell < len(source.cells) else []
    if source is None or not 0 < line <= len(lines):
        return found[1]
    text = printable(lines[line - 1][:_MOST_SCANNED]).replace("`", "'")
    shown = text if len(text) <= MOST_SHOWN else text[: MOST_SHOWN - 4] + " ..."
    return f"{found[1]}, in {place(source, cell, line)}" + (f": `{shown}`" if shown else "")


def place(source: Source, cell: int, line: int) -> str:
    """Say where a statement stands, as a student counts."""
    if source.kind == "module":
        return f"line {line}"
    label = source.labels[cell] if cell < len(source.labels) else f"cell {cell + 1}"
    return f"{label}, line {line}"

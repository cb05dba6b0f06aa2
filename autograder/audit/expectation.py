"""What a case of the audit should get: the verdict in the first line of a specimen, read and compared."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from autograder.verdicts import StageVerdict

CLAUSE = re.compile(r"(?P<key>[a-z0-9_]+)=(?P<value>[a-z0-9_]+)(?::(?P<slip>[a-z0-9_]+))?(?P<share>\+follow_through)?")
LINE = re.compile(r"# expect: (?P<clauses>[^;]+); (?P<sentence>[^;]+\.)")

REPORTED = ("answers", "written")  # stages that judge no function: `others` does not speak of them
CAUGHT = "caught"  # stands for any of these: the slips say what is wrong, not how much of it shows
ENDED = "ended"  # as well: what recursion without a bound runs into, time or the stack, is the Python version's matter
_ANY_OF = {CAUGHT: ("failed", "partial", "error"), ENDED: ("timeout", "memory", "error")}
KEPT = "kept"  # passed, or right by itself in every check: a mistake elsewhere has cost nothing here

# Words by which a remark is known, and its kinds; a column and a row are read by one remark.
REMARKS: Mapping[str, tuple[str, ...]] = {
    "in another order": ("row_order",),
    "have the opposite sign": ("row_sign",),
    "a column or a row": ("columns", "rows"),
    "returns a list": ("lists",),
    "np.matrix": ("np_matrix",),
    "returns integers": ("integers",),
    "returns truth values": ("truth_values",),
    "reduced precision": ("reduced_precision",),
    "in place": ("changes_input",),
}
KINDS = frozenset(kind for kinds in REMARKS.values() for kind in kinds)


@dataclass(frozen=True)
class Expected:
    """The verdict in a first line.

    Parameters
    ----------
    stages : dict
        Stage to status, slip ("" for none) and whether the follow-through share is paid.
    others : str
        Status of every other stage that judges a function and is no bonus; "" where nothing is said of them.
    remarks : tuple of str
        Kinds of remarks.
    sentence : str
        For a reader.
    """

    stages: dict[str, tuple[str, str, bool]] = field(default_factory=dict)
    others: str = ""
    remarks: tuple[str, ...] = ()
    sentence: str = ""

    def status(self, stage: str) -> str:
        """Return the expected status of a stage."""
        return self.stages.get(stage, (self.others, "", False))[0]


@dataclass(frozen=True)
class Cell:
    """One stage of one case: what was expected, what came. Equal texts are right."""

    stage: str
    expected: str
    got: str

    @property
    def right(self) -> bool:
        """Whether the stage got what was expected."""
        return self.expected == self.got

    @property
    def fault(self) -> str:
        """Name what went wrong: a right answer refused, a wrong one accepted, or another verdict than expected."""
        if self.right:
            return ""
        passed = [text.split(":")[0] in ("passed", KEPT) for text in (self.expected, self.got)]
        if passed[0] == passed[1]:
            return "misjudged"
        return "false alarm" if passed[0] else "miss"


def expected(line: str) -> Expected:
    """Read a first line.

    Parameters
    ----------
    line : str
        In the form that autograder/specimens/README.md gives.

    Returns
    -------
    Expected
        The verdict.

    Raises
    ------
    ValueError
        Where the line breaks that form.

    Examples
    --------
    >>> found = expected("# expect: jacobian=failed:jacobian_transposed others=passed; J is turned.")
    >>> found.status("jacobian"), found.status("residual"), found.sentence
    ('failed', 'passed', 'J is turned.')
    """
    match = LINE.fullmatch(line)
    clauses = [CLAUSE.fullmatch(text) for text in match["clauses"].split(" ")] if match else []
    if match is None or None in clauses:
        raise ValueError(f"got {line!r}, expected '# expect: <clause> [<clause> ...]; <sentence>.'")
    found = [
        (clause["key"], clause["value"], clause["slip"] or "", bool(clause["share"])) for clause in clauses if clause
    ]
    others = [value for key, value, _, _ in found if key == "others"]
    if len(others) != 1:
        raise ValueError(f"got {line!r}, expected exactly one clause 'others=<status>'")
    return Expected(
        stages={key: (value, slip, share) for key, value, slip, share in found if key not in ("others", "remark")},
        others=others[0],
        remarks=tuple(value for key, value, _, _ in found if key == "remark"),
        sentence=match["sentence"],
    )


def compare(wanted: Expected, verdicts: Sequence[StageVerdict], *, follow_through: bool = True) -> list[Cell]:
    """Lay what came beside what was expected, a stage a cell, and the remarks of all stages in one more.

    What a course cannot show is not asked of it: a stage that is worth nothing is never partly
    right, and with `follow_through` False no share is paid for following through.
    """
    cells = []
    for verdict in verdicts:
        if verdict.name in wanted.stages or (wanted.others and not verdict.bonus and verdict.name not in REPORTED):
            status, slip, share = wanted.stages.get(verdict.name, (wanted.others, "", False))
            if status == KEPT:
                kept = _is_kept(verdict) or verdict.max_score == 0 or not follow_through
                cells.append(Cell(verdict.name, KEPT, KEPT if kept else verdict.status))
                continue
            followed = any(not check.passed and check.points > 0 for check in verdict.checks)
            if share and not follow_through and {status, verdict.status} <= {*_ANY_OF[CAUGHT]}:
                status, share = verdict.status, False
            if verdict.max_score == 0:
                status, share = status.replace("partial", "failed"), False
            came = status if verdict.status in _ANY_OF.get(status, ()) else verdict.status
            got = _text(came, verdict.slip or "", followed)
            cells.append(Cell(verdict.name, _text(status, slip, share), got))
    if wanted.others:
        cells.append(_remarks(wanted, verdicts))
    return cells


def _is_kept(verdict: StageVerdict) -> bool:
    return verdict.status == "passed" or all(check.passed or check.points > 0 for check in verdict.checks)


def _text(status: str, slip: str, share: bool) -> str:
    return status + (f":{slip}" if slip else "") + ("+follow_through" if share else "")


def _remarks(wanted: Expected, verdicts: Sequence[StageVerdict]) -> Cell:
    """Compare the kinds of remarks, each once however many stages make it."""
    came: set[str] = set()
    for text in (remark for verdict in verdicts for remark in verdict.remarks):
        kinds = [kinds for words, kinds in REMARKS.items() if words in text] or [(text,)]
        for alternatives in kinds:
            came |= set(alternatives) & set(wanted.remarks) or {alternatives[0]}
    return Cell("remarks", " ".join(sorted(wanted.remarks)) or "none", " ".join(sorted(came)) or "none")

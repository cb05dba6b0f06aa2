"""The columns of Moodle's grading worksheet, whose headings are in the language of the site."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from autograder.errors import UsageError
from autograder.exports.marks import value
from autograder.exports.pairing import listing
from autograder.exports.sheet import Row, Sheet

# Column -> headings in English, German, French, Spanish, Italian, Portuguese, Dutch, as the language packs have them.
KNOWN: Mapping[str, tuple[str, ...]] = {
    "identifier": ("Identifier", "ID", "Identifiant", "Identificador", "Identificativo"),
    "name": (
        "Full name", "Name", "Vollständiger Name", "Nom complet", "Nombre completo", "Nome completo", "Cognome/Nome",
        "Volledige naam",
    ),
    "email": (
        "Email address", "E-Mail-Adresse", "Adresse de courriel", "Dirección de correo", "Indirizzo email",
        "Endereço de e-mail", "E-mailadres",
    ),
    "grade": ("Grade", "Bewertung", "Note", "Calificación", "Valutazione", "Nota", "Cijfer"),
    "maximum": (
        "Maximum grade", "Maximum Grade", "Bestwertung", "Note maximale", "Calificación máxima", "Valutazione massima",
        "Nota máxima", "Maximumcijfer",
    ),
    "scale": ("Scale", "Skala", "Barème", "Escala", "Scala", "Schaal"),
    "comments": (
        "Feedback comments", "Feedback als Kommentar", "Feedback par commentaires", "Comentarios de retroalimentación",
        "Commenti",
    ),
    "changeable": (  # no Dutch one is known for sure; --changeable-column names it
        "Grade can be changed", "Bewertung kann geändert werden", "La note peut être modifiée",
        "La calificación puede ser cambiada", "La valutazione può essere cambiata", "Nota pode ser alterada",
        "A nota pode ser alterada.",
    ),
}  # fmt: skip
_NO = {"no", "nein", "non", "não", "nee"}
IDENTIFIER = re.compile(r"\D*(\d+)")
_EXPORT = "download it again in Moodle: Assignment, View all submissions, Download grading worksheet"


@dataclass(frozen=True)
class Columns:
    """Where the columns stand; -1 for one that is not there. `guessed` says which were found by their content."""

    identifier: int
    grade: int
    maximum: int = -1
    name: int = -1
    email: int = -1
    comments: int = -1
    changeable: int = -1
    guessed: tuple[str, ...] = ()


def columns(sheet: Sheet, given: Mapping[str, str]) -> Columns:
    """Find the columns: as given, by known headings, or else by what stands in them.

    The identifier is the first column of distinct entries that end in a number; the maximum is a column
    with the same number in every line, and the grade the column before it.

    Raises
    ------
    UsageError
        Where identifier or grade cannot be told.
    """
    headings = [heading.strip() for heading in sheet.rows[0].values]
    rows = [row for row in sheet.rows[1:] if not row.blank]
    found = {name: _named(sheet, headings, name, given.get(name, "")) for name in KNOWN}
    guessed = []
    if found["identifier"] < 0 and rows and _identifies([row[0] for row in rows]):
        found["identifier"] = 0
        guessed.append("identifier")
    if found["grade"] < 0:
        before = [index - 1 for index in range(2, len(headings)) if _is_maximum(rows, index)]
        if len(before) == 1:
            found["grade"], found["maximum"] = before[0], before[0] + 1
            guessed.append("grade")
    for name in ("identifier", "grade"):
        if found[name] < 0:
            raise UsageError(
                f"{sheet.name} has no column that is known as the {name} ({listing(headings)}); is it a grading "
                f"worksheet? Name the column with --{name}-column, or {_EXPORT}."
            )
    if found.pop("scale") >= 0 and found["maximum"] < 0:
        raise UsageError(f"{sheet.name} is graded on a scale, not by points; set the assignment to points in Moodle.")
    return Columns(**found, guessed=tuple(guessed))


def number_of(sheet: Sheet, row: Row, column: int) -> str:
    """Return the participant's number, which also stands in the names of the student's folders."""
    match = IDENTIFIER.fullmatch(row[column].strip())
    if match is None:
        raise sheet.wrong(row.line, f"{row[column]!r} is no identifier of a participant; {_EXPORT}")
    return match[1]


def may_change(row: Row, column: int) -> bool:
    """Say whether Moodle takes a new mark in this line; it skips one that is locked or overridden in its gradebook."""
    return column < 0 or row[column].strip().casefold() not in _NO


def _named(sheet: Sheet, headings: Sequence[str], name: str, given: str) -> int:
    wanted = (given,) if given else KNOWN[name]
    fitting = [index for index, heading in enumerate(headings) if heading in wanted]
    if given and len(fitting) != 1:
        raise UsageError(
            f"{sheet.name} has {len(fitting)} columns {given!r}; expected one for --{name}-column "
            f"({listing(headings)})."
        )
    if len(fitting) > 1:
        raise UsageError(f"{sheet.name} has {len(fitting)} columns that could be the {name}; name it: --{name}-column.")
    return fitting[0] if fitting else -1


def _identifies(cells: Sequence[str]) -> bool:
    return len(set(cells)) == len(cells) and all(IDENTIFIER.fullmatch(cell.strip()) for cell in cells)


def _is_maximum(rows: Sequence[Row], index: int) -> bool:
    numbers = {value(row[index]) for row in rows}
    return len(numbers) == 1 and None not in numbers and all(_may_be_grade(row[index - 1]) for row in rows)


def _may_be_grade(cell: str) -> bool:
    return not cell.strip() or cell.strip() == "-" or value(cell) is not None

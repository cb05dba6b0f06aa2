"""Prints an audit: wrong rows in full, right ones counted, then the kill matrix and what each check is good for."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

from autograder.audit.cases import KINDS
from autograder.audit.report import Audit
from autograder.audit.words import meaning


def text(audit: Audit, *, verbose: bool = False) -> str:
    """Write the whole audit as text; `verbose` shows the right rows too."""
    parts = [_cells(audit, verbose), _blames(audit), _counts(audit), _matrix(audit), _powers(audit), [_verdict(audit)]]
    return "\n\n".join("\n".join(part) for part in parts if part)


def _cells(audit: Audit, verbose: bool) -> list[str]:
    found = [
        (
            row.kind,
            row.name,
            cell.stage,
            cell.expected,
            cell.got,
            f"{cell.fault}: {meaning(cell)}" if cell.fault else "right",
        )
        for row in audit.rows
        for cell in (row.cells if verbose else row.wrong)
    ]
    return _aligned([("kind", "case", "stage", "expected", "got", ""), *found]) if found else []


def _blames(audit: Audit) -> list[str]:
    """Say what is to blame, and for which cases."""
    named: dict[str, list[str]] = {}
    for row in audit.wrong:
        named.setdefault("Not tried again, for others were" if row.blame is None else row.blame.why, []).append(
            row.name
        )
    found = []
    for why, names in named.items():
        found += textwrap.wrap(f"{why.rstrip('.')}: {', '.join(names)}.", 100, subsequent_indent="  ")
    return ["What is to blame", *found] if found else []


def _counts(audit: Audit) -> list[str]:
    lines = [("kind", "cases", "right", "wrong")]
    kinds = [kind for kind in KINDS if any(row.kind == kind for row in audit.rows)]
    for kind in kinds:
        rows = [row for row in audit.rows if row.kind == kind]
        wrong = sum(bool(row.wrong) for row in rows)
        lines.append((kind, str(len(rows)), str(len(rows) - wrong), str(wrong)))
    lines.append(("all", str(len(audit.rows)), str(len(audit.rows) - len(audit.wrong)), str(len(audit.wrong))))
    return _aligned(lines)


def _matrix(audit: Audit) -> list[str]:
    """Draw a row for each slip: X where the check of the column catches it."""
    lines: list[str] = []
    for stage, rows in audit.matrix.items():
        checks = [power.check for power in audit.powers if power.stage == stage]
        lines += (
            ["", f"{stage}: which check catches which slip"] if lines else [f"{stage}: which check catches which slip"]
        )
        lines += [f"  {'| ' * at}{check}" for at, check in enumerate(checks)]
        lines += [f"  {' '.join('X' if caught else '.' for caught in row)}  {slip}" for slip, row in rows.items()]
    return lines


def _powers(audit: Audit) -> list[str]:
    table = [("stage", "check", "catches", "first", "alone")]
    table += [
        (power.stage, power.check, str(power.caught), str(power.first), str(len(power.only))) for power in audit.powers
    ]
    return [*_aligned(table), *_reasons(audit)] if audit.powers else []


def _reasons(audit: Audit) -> Iterator[str]:
    """Name what a check catches alone, and why a check that catches nothing alone is kept."""
    for power in audit.powers:
        if power.only:
            yield f"{power.stage}, {power.check}: alone it catches {', '.join(power.only)}."
    kept = {(power.ladder, power.check): power.reason for power in audit.powers if not power.only and power.reason}
    if kept:
        yield "Checks that catch nothing alone are kept for these reasons:"
        yield from (f"  {ladder}, {check}: {reason}" for (ladder, check), reason in kept.items())
    for power in audit.idle:
        yield f"{power.stage}, {power.check}: catches nothing alone, and nobody says why it is kept."


def _verdict(audit: Audit) -> str:
    faults = audit.faults()
    counted = f"{faults['false alarm']} false alarms, {faults['miss']} misses, {faults['misjudged']} misjudged"
    exam = f"seed {audit.seed}, {audit.examples} drawn examples, confinement {audit.confinement}"
    verdict = "The exam is sharp" if audit.clean else "The exam is not sharp"
    return f"{verdict}: {len(audit.rows)} cases, {counted} ({exam})."


def _aligned(rows: Sequence[tuple[str, ...]]) -> list[str]:
    """Put columns of text under each other; numbers to the right."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return [
        "  ".join(
            cell.rjust(width) if cell.isdigit() else cell.ljust(width) for cell, width in zip(row, widths, strict=True)
        ).rstrip()
        for row in rows
    ]

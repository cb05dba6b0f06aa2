"""What the exports of marks have in common: options, the stored results, and the notes on stderr."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from autograder.reports.feedback import Policy
    from autograder.verdicts import Result

Function = TypeVar("Function", bound=Callable[..., Any])


@dataclass(frozen=True)
class Graded:
    """The results of a run as people left them, and how its feedback is to be shown."""

    out: Path
    results: tuple[Result, ...]
    policy: Policy
    course: str
    later: str = ""

    def texts(self) -> dict[str, str]:
        """Return everybody's feedback as text."""
        from autograder.exports.words import feedback_text

        return {one.submission: feedback_text(one, self.policy, self.course, self.later) for one in self.results}

    def pages(self) -> dict[str, bytes]:
        """Return everybody's page, with the marks that are exported."""
        from autograder.reports.drawable import drawable

        return {one.submission: drawable(one, self.policy, self.course, self.later)[1].encode() for one in self.results}


def graded_options(function: Function) -> Function:
    """Add what every export of marks takes."""
    for option in (
        click.option(
            "--is",
            "given",
            multiple=True,
            metavar="UPLOAD=ID",
            help="Whose row in that file a submission belongs to, where it does not say; may be given again. "
            "`autograder grade --is` says it once and for all.",
        ),
        click.option(
            "--feedback", type=click.Choice(("full", "hint", "score")), help="[default: the course's, at this time]"
        ),
        click.option(
            "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
        ),
        click.argument("out", type=click.Path(path_type=Path), metavar="OUT"),
    ):
        function = option(function)
    return function


def stored(out: Path, course_file: Path | None, feedback: str | None) -> Graded:
    """Read the results of a run with everything that people decided, and how much of them students may see now."""
    from datetime import UTC, datetime

    from autograder.commands._reporting import say as note
    from autograder.commands.report import course_of, stored_results
    from autograder.marking.folder import decided
    from autograder.marking.showing import shown_at

    course = course_of(out, course_file)
    found = decided(out, stored_results(out), course)
    for each in found.notes:
        note(each)
    asked: Any = feedback
    shown = shown_at(course, datetime.now(UTC), asked)
    return Graded(out, found.results, shown.policy, course.title, shown.later)


def read(path: Path, what: str) -> bytes:
    """Read a file that somebody named, or say in one sentence why not."""
    from autograder.errors import UsageError

    try:
        return path.read_bytes()
    except OSError as error:
        raise UsageError(f"{path} cannot be read ({error.strerror}); expected {what}.") from None


def write(folder: Path, files: dict[str, bytes], notes: Iterable[str]) -> None:
    """Write files into a folder, each in one stroke; say what was written and what to know."""
    from autograder.writing import make_folder, write_whole

    make_folder(folder)
    for name, data in files.items():
        write_whole(folder / name, data)
    say(notes, [folder / name for name in files])


def write_new(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write a tree of files of which none may be there already."""
    from autograder.errors import UsageError

    there = [folder / name for name in files if (folder / name).exists()]
    if there:
        raise UsageError(f"{there[0]} is there already and was not changed; choose another folder with -o.")
    write_tree(folder, files)
    say([], [folder / name for name in files])


def write_tree(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write a tree of files, each in one stroke."""
    from autograder.writing import make_folder, write_whole

    for name, data in files.items():
        make_folder((folder / name).parent)
        write_whole(folder / name, data)


def say(notes: Iterable[str], written: Iterable[Path]) -> None:
    """Put notes and names of files on stderr."""
    from autograder.reports.wording import visible

    for note in notes:
        click.echo(f"autograder: {visible(note)}", err=True)
    click.echo(f"Wrote {', '.join(map(str, written))}.", err=True)

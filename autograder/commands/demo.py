"""`autograder demo`: the whole story on a small class, in a folder to look around in."""

from __future__ import annotations

import shlex
import shutil
import sys
import textwrap
from importlib.resources import as_file, files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from collections.abc import Sequence

    from autograder.verdicts import Result

# Time for an honest submission many times over, and the infinite loop of the class ends soon.
_TIME_LIMIT = 0.5
_EXAMPLES = 60
_OURS = ".demo"  # marks a folder that the demo wrote and may write again


@click.command()
@click.option(
    "-o",
    "--output",
    "out",
    type=click.Path(path_type=Path),
    default=Path("slam1d-demo"),
    metavar="DIR",
    show_default=True,
    help="Folder to write into; a second run goes on with it.",
)
@click.option(
    "--workers", type=click.IntRange(1), metavar="N", help="Submissions graded at a time. [default: one a core]"
)
@click.option(
    "--allow-unconfined",
    is_flag=True,
    help="Go on where `autograder doctor` finds no lock; one of the class tries to read and write files.",
)
def command(out: Path, workers: int | None, allow_unconfined: bool) -> int:
    """Show the homework and grade a small class.

    Copies the homework and a made-up class into DIR, grades the class, explains one mistake, and
    says where to look. It needs nothing and changes nothing else.

    \b
    autograder demo
    autograder demo -o somewhere
    """
    from autograder.commands._grading import grade_and_report
    from autograder.commands._reporting import exit_code
    from autograder.course import load_course
    from autograder.intake.submission import collect
    from autograder.reports.terminal import console, print_class
    from autograder.writing import make_folder

    make_folder(out)
    copy_files(files("assignment"), out / "assignment")
    copy_files(files("autograder.specimens") / "sample", out / "class")
    click.echo("1. What a student receives\n")
    for path in sorted((out / "assignment").glob("[!.]*")):
        click.echo(f"   {path}")
    click.echo("\n   " + "\n   ".join(_worked_example().splitlines()))
    uploads = collect([out / "class"])
    click.echo(f"\n2. A class of {len(uploads)} hands in, and is graded\n")
    run = grade_and_report(
        uploads,
        load_course(None),
        out,
        workers=workers,
        allow_unconfined=allow_unconfined,
        examples=_EXAMPLES,
        time_limit=_TIME_LIMIT,
    )
    print_class(run.results, console())
    _show_most_instructive(run.results)
    click.echo("\n4. Where to look\n")
    for name in ("report.html", "feedback", "grades.csv", "results", "class"):
        click.echo(f"   {out / name}")
    click.echo("\n   Your own class goes the same way; type this, with your folder in the place of the demo's:\n")
    click.echo(f"   {_program()} grade {shlex.quote(str(out / 'class'))} -o {shlex.quote(str(out.parent / 'graded'))}")
    return exit_code(run)


def _program() -> str:
    """Return what starts this program when it is typed here: its name where a shell finds it, else its path."""
    script = Path(sys.executable).parent / "autograder"
    if not script.exists():
        return f"{shlex.quote(sys.executable)} -I -m autograder"
    found = shutil.which("autograder")
    if found is not None and Path(found).absolute() == script.absolute():
        return "autograder"
    here = Path.cwd()
    return shlex.quote(str(script.relative_to(here) if script.is_relative_to(here) else script))


def copy_files(source: Traversable, target: Path) -> None:
    """Copy the files of a packaged folder; what the target holds from an earlier run goes away."""
    from autograder.errors import UsageError

    if target.exists() and not (target / _OURS).exists() and any(target.iterdir()):
        raise UsageError(f"{target} holds files that are not the demo's; choose another folder with -o.")
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    (target / _OURS).touch()
    for item in source.iterdir():
        if item.is_file() and not item.name.startswith(("__", ".")):
            with as_file(item) as path:
                shutil.copyfile(path, target / item.name)


def _worked_example() -> str:
    from autograder.problems.families.worked_example import worked_example
    from autograder.reports.picture import picture

    graph = worked_example()
    return picture(
        {
            "n_poses": graph.n_poses,
            "edges": graph.edges.tolist(),
            "measurements": graph.measurements.tolist(),
            "priors": graph.priors.tolist(),
            "prior_means": graph.prior_means.tolist(),
        }
    )


def _show_most_instructive(results: Sequence[Result]) -> None:
    from autograder.reports.counterexample import counterexample_text
    from autograder.reports.summary import most_instructive, reason
    from autograder.reports.wording import visible

    picked = most_instructive(results)
    if picked is None:
        return
    result, stage, example = picked
    click.echo(f"\n3. A wrong answer gets the smallest case that shows it: {result.submission}, {stage.name}\n")
    for said in dict.fromkeys([reason(stage), stage.message, stage.hint]):
        if said:
            click.echo("   " + "\n   ".join(textwrap.wrap(visible(said), 76)))
    click.echo("\n" + counterexample_text(example, indent="   "))

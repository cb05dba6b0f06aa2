"""`autograder diff`: whose mark moved between two runs, by which check and why."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from autograder.marking.comparing import Moved


@click.command()
@click.argument("before", type=click.Path(path_type=Path), metavar="OUT1")
@click.argument("after", type=click.Path(path_type=Path), metavar="OUT2")
@click.option("--json", "as_json", is_flag=True, help="One object a line to stdout.")
def command(before: Path, after: Path, as_json: bool) -> None:
    """Compare two runs: whose mark moved, by which check and why.

    OUT1 and OUT2 are folders of `autograder grade`, each with its own marks, overrides and settings. Nobody's code
    is run.

    \b
    autograder diff graded graded-again
    autograder diff graded graded-again --json
    """
    from autograder.commands.report import stored_results
    from autograder.marking.comparing import moved
    from autograder.marking.folder import decided

    old, new = (decided(out, stored_results(out), strict=False).results for out in (before, after))
    found = moved(old, new)
    if as_json:
        import msgspec

        for one in found:
            click.echo(msgspec.json.encode(one))
        return
    same = len({one.submission for one in old} & {one.submission for one in new}) - sum(
        one.before is not None and one.after is not None for one in found
    )
    for one in found:
        _show(one)
    click.echo(f"{len(found)} differ, {max(same, 0)} are the same.")


def _show(one: Moved) -> None:
    from autograder.reports.wording import points, visible

    totals = " -> ".join("--" if score is None else points(score) for score in (one.before, one.after))
    by = f" ({one.by:+.6g})" if one.by else ""
    click.echo(f"{visible(one.submission)}  {totals}{by}")
    for reason in one.reasons:
        click.echo(f"    {visible(reason)}")

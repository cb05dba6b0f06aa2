"""`autograder mark`: marking written answers in a page of this machine, by keyboard."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("out", type=click.Path(path_type=Path), metavar="OUT")
@click.option(
    "--course", "course_file", type=click.Path(path_type=Path), metavar="FILE", help="Settings of the course."
)
@click.option("--anonymous", is_flag=True, help="Replace the names.")
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port of 127.0.0.1. [default: one that is free]")
@click.option("--no-browser", is_flag=True, help="Print the address only.")
def command(out: Path, course_file: Path | None, anonymous: bool, port: int, no_browser: bool) -> None:
    """Mark the written answers of a run in the browser.

    OUT is the folder of an earlier `autograder grade`. The page is served to this machine only, to whoever has its
    address. Every mark is stored at once in OUT/marks.csv. Ctrl-C ends it and writes all reports.

    \b
    autograder mark graded
    autograder mark graded --anonymous
    autograder mark graded --no-browser --port 8000
    """
    import webbrowser

    from autograder.commands._reporting import say, show_changes, write_all
    from autograder.commands.report import course_of, stored_record, stored_results
    from autograder.desk.pile import Pile
    from autograder.desk.server import Desk
    from autograder.errors import UsageError
    from autograder.marking.anonymous import anonymous_names
    from autograder.marking.folder import decided

    stored, course = stored_results(out), course_of(out, course_file)
    found = decided(out, stored, course)
    names = anonymous_names(out, [one.submission for one in stored]) if anonymous else None
    pile = Pile(out, found.answers(names))
    try:
        desk = Desk(pile, course.title, course.guide, port)
    except OSError as error:
        raise UsageError(
            f"--port {port}: cannot be used ({error.strerror}); leave it out, and a free one is."
        ) from None
    with desk:
        click.echo(desk.address)
        say(f"{pile.waiting} of {len(pile)} answers wait. Ctrl-C ends the desk.")
        if not no_browser:
            webbrowser.open(desk.address)
        try:
            desk.serve_forever()
        except KeyboardInterrupt:
            say(f"{pile.waiting} of {len(pile)} answers wait.")
    _, moved = write_all(out, stored, stored_record(out), course, anonymous=anonymous)
    show_changes(moved, quiet=True)

"""`autograder export`: files that other systems import; one file here is one system, found by its name."""

from __future__ import annotations

import importlib
import pkgutil

import click


class Systems(click.Group):
    """The files of this folder, as commands."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 (click asks for this signature)
        """Name every system."""
        return sorted(found.name for found in pkgutil.iter_modules(__path__) if not found.name.startswith("_"))

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import one command by its name."""
        if cmd_name not in self.list_commands(ctx):
            return None
        command: click.Command = importlib.import_module(f"{__name__}.{cmd_name}").command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Say which systems there are where an unknown one is typed."""
        if args and args[0] not in self.list_commands(ctx):
            known = ", ".join(self.list_commands(ctx))
            raise click.UsageError(f"There is no export {args[0]!r}; there are {known}.", ctx)
        return super().resolve_command(ctx, args)


@click.group(cls=Systems, no_args_is_help=True)
def command() -> None:
    """Write files that other systems import.

    \b
    autograder export canvas graded --gradebook grades.csv -o canvas
    autograder export moodle graded --worksheet sheet.csv -o moodle
    autograder export mailmerge graded --roster class.csv -o mail.csv
    autograder export handout release --roster class.csv --worksheet sheet.csv -o handout
    autograder export gradescope -o autograder.zip
    autograder export nbgrader -o slam-course
    autograder export otter -o slam-otter

    docs/interop.md says where each file goes.
    """

"""The command line: finds the commands, and turns every outcome into one line and an exit code.

A command is one file in autograder/commands with a `command` in it; nothing else names it. Heavy
modules are imported inside the commands' functions, so that `--help` answers at once.
"""

from __future__ import annotations

import errno
import importlib
import os
import pkgutil
import signal
import sys
import traceback
from collections.abc import Sequence
from typing import NoReturn

import click

from autograder import __version__, commands
from autograder.commands._limits import too_little
from autograder.commands._streams import are_ours, make_safe
from autograder.errors import AutograderError
from autograder.lifeline import ENDING

DONE, DEFECT, USAGE, OUR_FAULT, INTERRUPTED = 0, 1, 2, 3, 130

# In the order of a course, from a first look to the exported marks. Others follow by name.
_FIRST = ("demo", "doctor", "init", "release", "variant", "grade", "mark", "report", "diff", "export", "audit")

_NO_ROOM = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS}
_KEPT = "Results so far are kept; make room, or choose another folder, and the same command goes on from there."


class Commands(click.Group):
    """The files of autograder/commands, as commands."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 (click asks for this signature)
        """Name every command, the everyday ones first."""
        found = {module.name for module in pkgutil.iter_modules(commands.__path__) if not module.name.startswith("_")}
        return [name for name in _FIRST if name in found] + sorted(found.difference(_FIRST))

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List every command with its whole first sentence; click would cut it off."""
        commands = [(name, self.get_command(ctx, name)) for name in self.list_commands(ctx)]
        with formatter.section("Commands"):
            formatter.write_dl([(name, found.get_short_help_str(500)) for name, found in commands if found])

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import one command by its name."""
        if cmd_name not in self.list_commands(ctx):
            return None
        command: click.Command = importlib.import_module(f"autograder.commands.{cmd_name}").command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Say which commands there are where an unknown one is typed."""
        if args and args[0] not in self.list_commands(ctx):
            known = ", ".join(self.list_commands(ctx))
            raise click.UsageError(f"There is no command {args[0]!r}; the commands are {known}.", ctx)
        return super().resolve_command(ctx, args)


@click.group(cls=Commands, no_args_is_help=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="autograder")
@click.option("--debug", is_flag=True, help="Before the command: show the traceback of an unexpected error.")
@click.pass_context
def cli(ctx: click.Context, debug: bool) -> None:
    """Grade a class of 1D SLAM homework: safely, fast, and with reasons.

    \b
    autograder demo                      the whole story on a small class
    autograder doctor                    is this machine ready?
    autograder init course.toml          a settings file to edit
    autograder grade uploads/ -o graded  grade a folder of .py and .ipynb files

    Each command shows its options and examples with --help: autograder grade --help.
    """
    ctx.obj = debug


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and leave with the contract's exit code; bad input never ends in a traceback."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    alone = are_ours()  # a test that calls this has streams of its own, and goes on when this has ended
    if alone:
        os.environ["PYTHONSAFEPATH"] = "1"  # no Python that this one starts looks for modules among the uploads
        make_safe()
    try:
        if alone:
            _hear_signals()  # from here on an interruption is caught below
        code = _run(arguments)
    except (KeyboardInterrupt, click.Abort):
        code = _say("Interrupted. Results so far are kept; the same command goes on from there.", INTERRUPTED)
    except BaseException as error:  # the last resort: the user gets a sentence, the file gets the rest
        if isinstance(error, SystemExit) or not alone:
            raise
        code = _say(f"An error of the grader itself ({type(error).__name__}), no fault of a student.", OUR_FAULT)
    if alone:
        for number in ENDING:
            signal.signal(number, signal.SIG_IGN)  # all is done: there is nothing left to interrupt
        _end_tracker()
    sys.exit(code)


def _run(arguments: Sequence[str]) -> int:
    """Run one command; every outcome but an interruption is an exit code and at most one line."""
    if sys.flags.optimize > 1:
        return _say("Python runs with -OO, which drops the texts that students are shown; run it without.", USAGE)
    try:
        with cli.make_context("autograder", list(arguments)) as context:  # click's own main ends with 1 on many ways
            code = cli.invoke(context)
    except click.exceptions.Exit as end:
        return end.exit_code
    except click.exceptions.NoArgsIsHelpError as help_wanted:
        click.echo(help_wanted.format_message())
        return DONE
    except click.ClickException as error:
        return _say(_usage(error), USAGE)
    except AutograderError as error:
        return _say(str(error), error.exit_code)
    except (KeyboardInterrupt, click.Abort):
        raise
    except Exception as error:  # noqa: BLE001  # whatever it is, the user gets a sentence and the file the rest
        if "--debug" in arguments:
            traceback.print_exception(error)
        if isinstance(error, OSError) and error.errno in _NO_ROOM:
            return _say(f"{error.filename or 'A file'} could not be written ({error.strerror}). {_KEPT}", USAGE)
        return _say(too_little(error) or _unexpected(error), OUR_FAULT)
    return code if isinstance(code, int) else DONE


def _hear_signals() -> None:
    """Let a request to end, or a terminal that closes, be what Ctrl-C is: all processes end, what is done is kept."""
    for number in ENDING:
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, signal.default_int_handler)


def _end_tracker() -> None:
    """End the process that multiprocessing starts beside its workers; left alone, it ends a moment after this one."""
    module = sys.modules.get("multiprocessing.resource_tracker")
    tracker = getattr(module, "_resource_tracker", None)
    if tracker is not None and tracker._pid is not None:
        tracker._stop()


def _say(sentence: str, code: int) -> int:
    click.echo("autograder: " + " ".join(sentence.split()), err=True)
    return code


def _usage(error: click.ClickException) -> str:
    """Put what came, what was expected and what to try on one line."""
    ctx = getattr(error, "ctx", None)
    message = error.format_message()
    if ctx is None:
        return message
    return f"{message.rstrip('.')}. Try: {ctx.command_path} --help"


def _unexpected(error: Exception) -> str:
    import tempfile

    with tempfile.NamedTemporaryFile(
        "w", prefix="autograder-", suffix=".traceback.txt", delete=False, encoding="utf-8"
    ) as file:
        traceback.print_exception(error, file=file)
    return (
        f"An error of the grader itself ({type(error).__name__}), no fault of a student; "
        f"please report it with the traceback in {file.name}."
    )

"""`autograder doctor`: what confinement this machine gives, and what to do about what is missing."""

from __future__ import annotations

import click

from autograder import __version__

_REMEDY = {
    "full": "Nothing is missing.",
    "seccomp": "Landlock is missing: it needs Linux 5.13 or newer, and Docker 23 or newer. Grading works without it.",
    "none": "Grade on Linux (x86_64 or aarch64), in Docker, or under WSL2; here `grade` refuses without "
    "--allow-unconfined, and then only time-outs protect you.",
}


@click.command()
def command() -> int:
    """Say how safely this machine can grade.

    It locks a child process exactly as grading does and lets it try to break out, and says what to
    do about what is missing.

    \b
    autograder doctor

    Exit code: 0 ready to grade, 3 not.
    """
    import os
    import platform

    click.echo(f"autograder   {__version__}")
    click.echo(f"python       {platform.python_version()} ({platform.python_implementation()})")
    click.echo(f"packages     {', '.join(_versions())}")
    click.echo(f"system       {platform.system()} {platform.release()} {platform.machine()}")
    click.echo(f"cores        {len(os.sched_getaffinity(0)) if hasattr(os, 'sched_getaffinity') else os.cpu_count()}")
    return _confinement()


def _confinement() -> int:
    from autograder.errors import AutograderError
    from autograder.sandbox.frames import Inputs, encode_inputs
    from autograder.sandbox.host import Sandbox

    try:
        with Sandbox(encode_inputs(Inputs(objects=[], batches=[])), allow_unconfined=True) as sandbox:
            found = sandbox.confinement
    except AutograderError as error:
        click.echo("confinement  BROKEN")
        click.echo(f"what to do   {error}")
        return 3
    click.echo(f"confinement  {found.wording}")
    click.echo(f"what to do   {_REMEDY[found.level]}")
    return 3 if found.level == "none" else 0


def _versions() -> list[str]:
    from importlib.metadata import PackageNotFoundError, version

    found = []
    for name in ("numpy", "hypothesis", "msgspec", "nbformat", "rich", "click", "jinja2"):
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            found.append(f"{name} MISSING")
    return found

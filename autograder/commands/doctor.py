"""`autograder doctor`: what confinement this machine gives, whether its limits hold, and what to do."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from autograder import __version__
from autograder.commands._remedy import missing, what_to_do
from autograder.commands.grade import LEVELS

if TYPE_CHECKING:
    from autograder.sandbox.host import Limits

_PACKAGES = ("numpy", "hypothesis", "msgspec", "nbformat", "rich", "click", "jinja2")
Say = Callable[[str], None]


@click.command()
@click.option(
    "--course",
    "course_file",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Course whose limits are tried and whose demands count. [default: what `autograder init` writes]",
)
@click.option(
    "--time-limit",
    type=click.FloatRange(0, 600, min_open=True),
    metavar="SECONDS",
    help="Computing time to try. [default: the course's, or 2]",
)
@click.option(
    "--memory", type=click.IntRange(64, 65_536), metavar="MIB", help="Memory to try. [default: the course's, or 512]"
)
@click.option(
    "--output-limit", type=click.IntRange(1, 1024), metavar="MIB", help="Output to try. [default: the course's, or 16]"
)
@click.option(
    "--trace", is_flag=True, help="Also run much of numpy in the lock, and name every system call that is refused."
)
@click.option("--json", "as_json", is_flag=True, help="One object to stdout, and no text.")
def command(
    course_file: Path | None,
    time_limit: float | None,
    memory: int | None,
    output_limit: int | None,
    trace: bool,
    as_json: bool,
) -> int:
    """Say how safely this machine can grade.

    It locks a process exactly as grading does, lets it try to break out, lets a submission run into
    every limit, and says what to do about what is missing. That takes about ten seconds.

    \b
    autograder doctor
    autograder doctor --course course.toml     with the limits of a course
    autograder doctor --trace                  after an update of Python, numpy or the kernel

    Exit code: 0 ready to grade, 3 not.
    """
    from autograder.course import load_course
    from autograder.sandbox.host import Limits

    course = load_course(course_file)
    limits = Limits(
        cpu_seconds=time_limit or course.time_limit,
        memory_mib=memory or course.memory_mib,
        output_bytes=(output_limit or course.output_mib) << 20,
    )

    def say(text: str) -> None:
        if not as_json:
            click.echo(text)

    found = _system(say)
    found |= _confinement(limits, course.min_confinement, say)
    if trace:
        found |= _trace(say)
    ready = found["ready"] and found.get("trace", {}).get("passed", True)
    if as_json:
        import json

        click.echo(json.dumps({**found, "ready": ready}, indent=2))
    return 0 if ready else 3


def _system(say: Say) -> dict[str, Any]:
    import os
    import platform
    from importlib.metadata import PackageNotFoundError, version

    packages = {}
    for name in _PACKAGES:
        try:
            packages[name] = version(name)
        except PackageNotFoundError:
            packages[name] = "MISSING"
    found = {
        "autograder": __version__,
        "python": f"{platform.python_version()} ({platform.python_implementation()})",
        "packages": packages,
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
    }
    for name, value in found.items():
        shown = ", ".join(" ".join(pair) for pair in packages.items()) if name == "packages" else value
        say(f"{name:<12} {shown}")
    return found


def _confinement(limits: Limits, minimum: str, say: Say) -> dict[str, Any]:
    import platform

    from autograder.errors import AutograderError
    from autograder.sandbox.frames import Inputs, encode_inputs
    from autograder.sandbox.host import Sandbox

    system, machine = platform.system(), platform.machine()
    found: dict[str, Any] = {"limits": [], "ready": False}
    try:
        with Sandbox(encode_inputs(Inputs(objects=[], batches=[])), limits, allow_unconfined=True) as sandbox:
            level, wording = sandbox.confinement.level, sandbox.confinement.wording
            say(f"confinement  {wording}")
            say(f"missing      {missing(level)}")
            if level == "none":
                say("limits       not tried: without the lock, the attempts could harm this machine")
            else:
                say("canary       a locked process tried to break out, and could not")
                found["limits"] = _limits(sandbox, say)
    except AutograderError as error:
        if system != "Windows":
            say(f"confinement  BROKEN\nwhat to do   {error}")
            return found | {"confinement": {"level": "broken", "wording": str(error)}, "what_to_do": [str(error)]}
        level, wording = "none", f"none: {error}"
        say(f"confinement  {wording}\nmissing      {missing(level)}")
    found["ready"] = level != "none" and LEVELS.index(level) <= LEVELS.index(minimum)
    lines = what_to_do(level, minimum, system, machine)
    if not all(check["held"] for check in found["limits"]):
        found["ready"] = False
        lines = ["A limit did not hold. Run this again on a quiet machine; if it stays so, do not grade here and"]
        lines += ["report it as SECURITY.md says."]
    say("what to do   " + "\n             ".join(lines))
    return found | {
        "confinement": {"level": level, "wording": wording, "demanded": minimum},
        "missing": missing(level),
        "what_to_do": lines,
    }


def _limits(sandbox: Any, say: Say) -> list[dict[str, Any]]:
    from dataclasses import asdict

    from autograder.sandbox.selftest import check_limits

    say("limits       each is tried now, as a submission would run into it")
    checks = []
    for check in check_limits(sandbox):
        if not check.held:
            end = f": DID NOT HOLD: {check.message}"
        elif check.limit == "none":
            end = ": refused"
        else:
            end = f" ended after {check.seconds:.1f} s: {check.message}"
        say(f"  {check.name:<14} {check.limit:>8}   {check.attempt}{end}")
        checks.append(asdict(check))
    return checks


def _trace(say: Say) -> dict[str, Any]:
    from dataclasses import asdict

    from autograder.errors import SandboxError
    from autograder.sandbox.refusals import line_to_review, trace

    try:
        parts = trace()  # with the default limits: the filter is tried, not they
    except SandboxError as error:
        say(f"trace        not possible here: {error}")
        return {"trace": {"passed": False, "error": str(error)}}
    passed = all(part.passed for part in parts)
    refused = [part for part in parts if part.refused]
    say(f"trace        {sum(part.passed for part in parts)} of {len(parts)} parts of the torture set work in the lock")
    for part in parts:
        if not part.passed or part.refused:
            calls = ", ".join(f"{name} ({count} times)" for name, count in part.refused.items())
            state = "works" if part.passed else "FAILS"
            say(f"  {part.name:<20} {state}; refused: {calls or 'nothing, so the filter is not to blame'}")
    if refused:
        say(f"             the line to review: {line_to_review()}; how: .github/MAINTAINING.md")
    elif passed:
        say("             the filter refused no system call")
    return {"trace": {"passed": passed, "review": line_to_review(), "parts": [asdict(part) for part in parts]}}

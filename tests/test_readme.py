"""The front door tells the truth: its picture, its commands, its points and its links are those of the code."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

import click
import pytest

from assignment.posegraph import PoseGraph
from autograder.cli import cli
from autograder.course import DEFAULT_POINTS, Course

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
COMMANDS = re.findall(r"^(autograder .*?)(?: +#.*)?$", README, flags=re.MULTILINE)


def test_the_picture_is_the_one_that_students_see() -> None:
    """The worked example is drawn as in the docstring of PoseGraph, and on the first screen."""
    picture = README.split("```text\n")[1].split("```")[0]
    drawn = textwrap.dedent((PoseGraph.__doc__ or "").split("::\n\n", 1)[1].split("\n\n", 1)[0])
    assert textwrap.dedent(picture).strip("\n") == drawn.strip("\n")
    assert README.index(picture) < 200


def test_the_two_commands_stand_on_the_first_screen() -> None:
    """`make demo` and `make test` come within the first 25 lines."""
    first = README.splitlines()[:25]
    assert sum(line.startswith(("make demo", "make test")) for line in first) == 2


def test_three_people_are_answered_on_the_first_screen() -> None:
    """Student, grader and instructor have three lines each, before line 45, and a command that is shown exists."""
    lines = README.splitlines()[:45]
    for person in ("Student", "Grader", "Instructor"):
        at = lines.index(f"**{person}?**")
        assert all(lines[at + 1 : at + 4])
        assert lines[at + 4] == ""
        assert "[More](#for-" in lines[at + 3]
        for name in re.findall(r"`autograder (\w+)", "\n".join(lines[at : at + 4])):
            assert cli.get_command(click.Context(cli), name) is not None


def test_what_is_said_of_follow_through_is_the_default() -> None:
    """All of the points by default, and no mistake spoils the next one, as long as that is the course's default."""
    assert Course().follow_through == 1.0
    assert "earns the follow-through share, all of the points by default" in README
    assert "a mistake in one function does not spoil the next" in README


@pytest.mark.parametrize("line", COMMANDS)
def test_a_command_that_is_shown_exists(line: str) -> None:
    """Its name and every option of it are known."""
    name, *arguments = line.split()[1:]
    command = cli.get_command(click.Context(cli), name)
    assert command is not None
    known = {option for parameter in command.params for option in parameter.opts}
    assert {argument for argument in arguments if argument.startswith("-")} <= known


def test_every_link_leads_somewhere() -> None:
    """A link is a file of ours or a heading of this page."""
    headings = {f"#{title.lower().replace(' ', '-')}" for title in re.findall(r"^#+ (.*)$", README, flags=re.MULTILINE)}
    links = re.findall(r"\]\(([^)]+)\)", README)
    assert len(links) > 5
    assert [link for link in links if link not in headings and not (ROOT / link).exists()] == []


def test_the_points_are_those_of_the_course() -> None:
    """Each function's points, and the maximum, are the defaults."""
    shown = {
        name: float(points) for name, points in re.findall(r"^\| `(\w+)\(.*\| (\d+) \|$", README, flags=re.MULTILINE)
    }
    assert len(shown) >= 5
    assert shown.items() <= DEFAULT_POINTS.items()
    assert f"the maximum is {Course().max_score:g}" in README
    assert "gives 10 more points (`second_step`)" in README

"""The page about variants tells the truth: its commands, its families and its counts are those of the code."""

from __future__ import annotations

import re
from pathlib import Path

import click
import pytest

from autograder.cli import cli
from autograder.problems.families import names
from tests.problems.counting import HEADINGS

PAGE = (Path(__file__).resolve().parent.parent / "docs" / "variants.md").read_text(encoding="utf-8")
COMMANDS = re.findall(r"(autograder (?:release|grade|variant) [^`\n]*)", PAGE)


@pytest.mark.parametrize("line", COMMANDS)
def test_a_command_that_is_shown_exists(line: str) -> None:
    """Its name and every option of it are known."""
    name, *arguments = line.split()[1:]
    command = cli.get_command(click.Context(cli), name)
    assert command is not None
    known = {option for parameter in command.params for option in parameter.opts}
    assert {argument for argument in arguments if argument.startswith("-")} <= known


def test_the_commands_of_the_page_are_found() -> None:
    """There are commands on the page, so the test above tests something."""
    assert len(COMMANDS) >= 3


def test_every_family_is_listed() -> None:
    """Letter and name of each, and none besides."""
    listed = dict(re.findall(r"^\| ([A-Z]) \| ([a-z-]+) \|", PAGE, flags=re.MULTILINE))
    assert listed == names()


def test_the_table_of_counts_is_that_of_the_script() -> None:
    """Its headings are those of the script, a row stands for every personal family, and nobody shares numbers."""
    assert "| " + " | ".join(HEADINGS) + " |" in PAGE
    rows = re.findall(r"^\| ([A-Z]) \| (\d+) \| (\d+) \| (\d+) \| (\d+) \| ", PAGE, flags=re.MULTILINE)
    assert {row[0] for row in rows} == set(names()) - {"E"}
    assert all((data, x1, good) == ("1000", "1000", "1000") for _, data, x1, _, good in rows)

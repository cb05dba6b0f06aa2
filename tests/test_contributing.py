"""The lists of CONTRIBUTING.md are followed to the letter, in a copy: what they tell to write is found and works."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import pytest

from tests.test_architecture import broken_arrows

ROOT = Path(__file__).resolve().parent.parent
GUIDE = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
SECTIONS = dict(re.findall(r"^## (.*)\n((?:(?!## ).*\n)*)", GUIDE, flags=re.MULTILINE))


def code_of(section: str) -> dict[str, str]:
    """Read the code of a section: the file that its first line names -> the lines below."""
    blocks = re.findall(r"^ +```python\n(.*?)^ +```$", SECTIONS[section], flags=re.MULTILINE | re.DOTALL)
    named = [textwrap.dedent(block).partition("\n") for block in blocks]
    return {first.removeprefix("# "): rest for first, _, rest in named}


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Copy the packages to where they can be added to."""
    for package in ("assignment", "autograder", "reference_solution"):
        shutil.copytree(ROOT / package, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


def follow(section: str, copy: Path) -> None:
    """Write what a section tells to write: a new file, or lines in one that exists."""
    for place, code in code_of(section).items():
        name, _, mark = place.partition(", above ")
        text = (copy / name).read_text(encoding="utf-8") if (copy / name).exists() else ""
        at = text.rindex(f"\n{mark} =") + 1 if mark else len(text)
        (copy / name).write_text(f"{text[:at]}{code}\n\n{text[at:]}".rstrip() + "\n", encoding="utf-8")
    assert set(broken_arrows(copy)) <= set(broken_arrows(ROOT))


def ask(copy: Path, code: str) -> Any:
    """Run code in the copy; what it prints as JSON is the answer."""
    code = f"import json, autograder\nassert autograder.__file__.startswith({str(copy)!r})\n{textwrap.dedent(code)}"
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], cwd=copy, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


def test_every_list_is_short_and_numbered() -> None:
    """What can be added has a list of its own, counted from 1 without a gap."""
    for kind in ("stage", "slip", "family", "layout", "report"):
        steps = [int(step) for step in re.findall(r"^(\d+)\. ", SECTIONS[f"Add a {kind}"], flags=re.MULTILINE)]
        assert steps == list(range(1, len(steps) + 1))
        assert 1 < len(steps) < 8


def test_every_path_that_is_named_exists(copy: Path) -> None:
    """A file or folder of ours that the guide names is there, or is made by following it."""
    for section in SECTIONS:
        for name in code_of(section):
            (copy / name.partition(",")[0]).touch()
    named = set(re.findall(r"`((?:autograder|reference_solution|tests)/[\w/.]+)`", GUIDE))
    promised = {"tests/stages/test_whitened_residual.py"}
    assert not [name for name in named - promised if not (copy / name).exists() and not (ROOT / name).exists()]


def test_adding_a_stage(copy: Path) -> None:
    """The stage is found, and its rungs are those of its ladder."""
    follow("Add a stage", copy)
    found = ask(
        copy,
        """
        from autograder.stages.catalogue import all_stages
        stage = next(stage for stage in all_stages() if stage.name == "whitened_residual")
        rungs = {rung.name: rung.core[0] for rung in stage.ladder.rungs}
        case = rungs["variances"]
        wrong = tuple(array + 1 for array in stage.expected(*case))
        print(json.dumps([stage.name, sorted(set(stage.shares) - set(rungs)), stage.explain(case, wrong)]))
        """,
    )
    assert found[:2] == ["whitened_residual", []]
    assert "expected" in found[2]


def test_adding_a_slip(copy: Path) -> None:
    """The slip is found with its name and its hint, is wrong on a case, and is told apart from all others."""
    follow("Add a slip", copy)
    found = ask(
        copy,
        """
        import numpy
        from autograder.stages.catalogue import slips, stage
        slip = next(slip for slip in slips("residual") if slip.identifier == "residual_halved")
        cases = [case for rung in stage("residual").ladder.rungs for case in rung.core]
        wrong = [not numpy.allclose(slip.function(*case), stage("residual").expected(*case)[0]) for case in cases]
        alike = [
            other.identifier for other in slips("residual") if all(
                numpy.array_equal(slip.function(*case), other.function(*case)) for case in cases
            )
        ]
        print(json.dumps([slip.name, slip.hint, any(wrong), alike]))
        """,
    )
    assert found[0] == "Every row of f is half of what it should be."
    assert found[1].startswith("Some texts have a factor 1/2")
    assert found[2:] == [True, ["residual_halved"]]


def test_adding_a_family(copy: Path) -> None:
    """The family is found by letter and by name."""
    follow("Add a family", copy)
    code = "from autograder.problems.families import family, names"
    code += "\nprint(json.dumps([names()['Z'], family('two-doors').label]))"
    assert ask(copy, code) == ["two-doors", "Z"]


def test_adding_a_layout(copy: Path) -> None:
    """The layout is found, and recognises a tree of its own."""
    follow("Add a layout", copy)
    found = ask(
        copy,
        """
        from autograder.intake.layouts import detect
        from autograder.intake.tree import Entry, Tree
        tree = Tree("hall", tuple(Entry((f"seat-{seat}.py",), f"{seat}") for seat in (3, 12)))
        layout, chosen = detect(tree)
        print(json.dumps([layout.name, layout.title, [upload.name for upload in layout.gather(chosen)]]))
        """,
    )
    assert found == ["by_seat", "a file a seat", ["seat-3", "seat-12"]]

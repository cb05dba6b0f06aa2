"""The picture of the rooms is a table, and the table is a test: a picture that nobody runs goes stale."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("assignment", "autograder", "reference_solution")

# A room may import itself, the version in autograder/__init__.py, and what its line names: rooms of lines above.
ARROWS = """
errors             -> nothing
owner              -> nothing
verdicts           -> nothing
posegraph          -> nothing
writing            -> errors
lifeline           -> nothing
attempts           -> errors, verdicts
reference_solution -> nothing
assignment         -> posegraph
problems           -> posegraph, lifeline, owner, writing, errors
sandbox            -> errors
intake             -> errors, owner, sandbox
stages             -> problems, reference_solution, verdicts, posegraph
course             -> stages, errors
diagnosis          -> posegraph, stages, problems, verdicts
render             -> stages, problems, posegraph, errors
engine             -> posegraph, stages, diagnosis, problems, sandbox, intake, course, verdicts, writing, lifeline,
                      attempts, errors
marking            -> course, verdicts, writing, errors
reports            -> verdicts, attempts, marking, render.figure, render.formula, writing, errors
exports            -> render, stages, problems, posegraph, reports, verdicts, writing, errors
desk               -> reports, marking, course, verdicts, errors
audit              -> errors, verdicts, course, assignment, reference_solution, sandbox.frames, intake, engine,
                      stages, specimens
commands           -> everything above
cli                -> everything above
__main__           -> cli
"""

# Imports under `if TYPE_CHECKING` exist for readers only; they follow the table, but for these.
TYPE_ONLY = {("reference_solution", "posegraph")}  # it must run as a submission, where `assignment` is unknown

# What this module loads runs beside a student's code, in a process that has nothing else of ours to import.
FORK_SERVER = "autograder.sandbox.forkserver"


def table() -> dict[str, frozenset[str]]:
    """Read ARROWS: room -> what it may import."""
    lines = [line.split("->") for line in ARROWS.strip().replace(",\n", ",").splitlines()]
    may: dict[str, frozenset[str]] = {}
    for room, names in lines:
        named = frozenset(name.strip() for name in names.split(",")) - {"nothing"}
        may[room.strip()] = frozenset(may) if named == {"everything above"} else named
    return may


@dataclass(frozen=True)
class Import:
    """One import of ours by ours."""

    source: str
    line: int
    target: str
    type_only: bool


def modules(root: Path) -> dict[str, Path]:
    """Find every module of the packages below root, by its dotted name."""
    found = {}
    for package in PACKAGES:
        for path in sorted((root / package).rglob("*.py")):
            parts = path.relative_to(root).with_suffix("").parts
            if parts[:2] != ("autograder", "specimens"):  # submissions: what they import is what they are judged for
                found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def room_of(module: str) -> str:
    """Name the room of a module: the second part of its name, but for the small packages."""
    first, _, rest = module.partition(".")
    if module in {"posegraph", "assignment.posegraph"}:
        return "posegraph"
    return rest.split(".")[0] if first == "autograder" else first


def imports(root: Path) -> Iterator[Import]:
    """Read every import statement, wherever in the file it stands."""
    known = modules(root)
    for module, path in known.items():
        tree = ast.parse(path.read_text(encoding="utf-8"), filename=str(path))
        readers_only = {
            id(inner)
            for node in ast.walk(tree)
            if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING")
            for statement in node.body
            for inner in ast.walk(statement)
        }
        package = module if path.stem == "__init__" else module.rpartition(".")[0]
        for node in ast.walk(tree):
            for target in _targets(node, package, known):
                if target.split(".")[0] in (*PACKAGES, "posegraph"):
                    yield Import(module, getattr(node, "lineno", 0), target, id(node) in readers_only)


def _targets(node: ast.AST, package: str, known: dict[str, Path]) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        base = node.module or ""
        if node.level:
            above = package.split(".")[: len(package.split(".")) - node.level + 1]
            base = ".".join([*above, *([base] if base else [])])
        for alias in node.names:  # `from autograder import engine` imports a module, not a name
            full = f"{base}.{alias.name}"
            yield full if full in known else base
    elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith(("import_module", "__import__")):
        yield from (arg.value for arg in node.args if isinstance(arg, ast.Constant) and isinstance(arg.value, str))


def broken_arrows(root: Path) -> list[str]:
    """Say in a sentence each what the packages below root import against the table."""
    may = table()
    strange = sorted({room_of(module) for module in modules(root)} - {"", *may})
    sentences = [f"There is a room `{room}`, which the table does not know." for room in strange]
    found = list(dict.fromkeys(imports(root)))
    beside_a_student = reached(found, FORK_SERVER)
    for each in found:
        here, there = room_of(each.source), room_of(each.target)
        allowed = may.get(here, frozenset())
        if each.source in beside_a_student:
            fine = there == "sandbox"
            words = f"{FORK_SERVER} loads it, and nothing of ours is beside a student's code but the sandbox"
        else:
            fine = (
                there in {here, ""}
                or not allowed.isdisjoint({there, each.target.removeprefix("autograder.")})
                or (each.type_only and (here, there) in TYPE_ONLY)
            )
            words = f"{here or 'autograder/__init__.py'} may import {', '.join(sorted(allowed)) or 'nothing of ours'}"
        if not fine:
            sentences.append(f"{each.source}, line {each.line}, imports {each.target}, but {words}.")
    return sentences


def reached(found: list[Import], start: str) -> set[str]:
    """Follow the imports from a module on, as far as they lead."""
    seen, queue = set(), [start]
    while queue:
        module = queue.pop()
        if module not in seen:
            seen.add(module)
            queue += [each.target for each in found if each.source == module]
    return seen


def test_every_import_follows_an_arrow() -> None:
    """A part imports only what its line of the table names."""
    assert not broken_arrows(ROOT), "\n".join(broken_arrows(ROOT))


def test_every_arrow_points_up() -> None:
    """A line names rooms of lines above it, so there is no circle; specimens are data, not a room."""
    above = {"specimens"}
    for room, names in table().items():
        assert {name.split(".")[0] for name in names} <= above, room
        above.add(room)


def _write(root: Path, module: str, text: str) -> None:
    path = root.joinpath(*module.split(".")).with_suffix(".py")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


WAYS = {
    "at the top": "import autograder.cli",
    "from": "from autograder.cli import main",
    "a module from its package": "from autograder import cli",
    "relative": "from ..cli import main",
    "inside a function": "def f():\n    from autograder import cli",
    "for types only": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import autograder.cli",
    "by its name as text": "import importlib\nimportlib.import_module('autograder.cli')",
}


@pytest.mark.parametrize("text", WAYS.values(), ids=WAYS.keys())
@pytest.mark.parametrize("room", sorted(set(table()) - {"cli", "__main__", "posegraph", "reference_solution"}))
def test_a_broken_arrow_is_seen(tmp_path: Path, room: str, text: str) -> None:
    """An import of cli breaks the arrow of every other room, however it is written."""
    _write(tmp_path, "autograder.cli", "main = None\n")
    _write(tmp_path, f"autograder.{room}.part", text)
    (sentence,) = broken_arrows(tmp_path)
    assert sentence.startswith(f"autograder.{room}.part, line ")
    assert "imports autograder.cli, but " in sentence


@pytest.mark.parametrize(
    ("module", "text", "words"),
    [
        (
            "reference_solution.slam1d",
            "from posegraph import PoseGraph",
            "reference_solution may import nothing of ours",
        ),
        ("assignment.posegraph", "import autograder.errors", "posegraph may import nothing of ours"),
        (FORK_SERVER, "from autograder.errors import SandboxError", "nothing of ours is beside a student's code"),
        (FORK_SERVER, "from . import host", "nothing of ours is beside a student's code"),
        (
            "autograder.reports.html",
            "import autograder.render.stub",
            "reports may import attempts, errors, marking, render.figure, render.formula, verdicts, writing",
        ),
        ("autograder.__init__", "import autograder.errors", "autograder/__init__.py may import nothing of ours"),
        ("autograder.attic.old", "", "There is a room `attic`, which the table does not know"),
    ],
)
def test_a_special_rule_is_seen(tmp_path: Path, module: str, text: str, words: str) -> None:
    """The rules beside the table are held like the table."""
    _write(tmp_path, "autograder.sandbox.host", "import autograder.errors")
    _write(tmp_path, module, text)
    (sentence,) = broken_arrows(tmp_path)
    assert words in sentence


@pytest.mark.parametrize(
    ("module", "text"),
    [
        ("autograder.reports.html", "import autograder.render.figure"),
        ("autograder.cli", "import autograder.engine.grade"),
        (
            "autograder.sandbox.host",
            "from autograder.errors import SandboxError\nfrom autograder.sandbox import frames",
        ),
        ("autograder.stages.jacobian", "from autograder import __version__\nfrom . import base"),
        ("reference_solution.slam1d", "if TYPE_CHECKING:\n    from assignment.posegraph import PoseGraph"),
    ],
)
def test_an_arrow_of_the_table_may_be_used(tmp_path: Path, module: str, text: str) -> None:
    """What the table allows is allowed."""
    _write(tmp_path, module, text)
    assert not broken_arrows(tmp_path)

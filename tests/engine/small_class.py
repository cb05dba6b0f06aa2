"""A tiny class and two stages, graded by the command line: what the tests of crashes and of the cluster compare."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path

from tests.engine.conftest import REFERENCE

CONSTANT = "\n\ndef residual(x, graph):\n    return {} * np.ones(len(graph.edges) + len(graph.priors)) + x[0]\n"
CLASS = {
    "ada": REFERENCE,
    "bob": REFERENCE.replace("-1.0", "1.0"),
    "cleo": REFERENCE + CONSTANT.format("1.7"),
    "dan": REFERENCE + "\n# the same mistake as another\n" + CONSTANT.format("1.7"),
    "eve": REFERENCE + "\n\ndef jacobian(x, graph):\n    return np.eye(graph.n_factors, graph.n_poses) * 3.5\n",
    "finn": "def residual(x, graph):\n    raise RuntimeError('not today')\n",
}
COURSE = '[grading]\nstages = ["residual", "jacobian"]\n'
OURS = {"seconds", "graded_now", "reused"}  # accounts of one run, not of the work


def make(folder: Path, texts: Mapping[str, str] = CLASS) -> Path:
    """Write the uploads and the course file."""
    (folder / "uploads").mkdir(parents=True)
    for name, text in texts.items():
        (folder / "uploads" / f"{name}.py").write_text(text)
    (folder / "course.toml").write_text(COURSE)
    return folder


def command(folder: Path, out: Path, *options: str) -> list[str]:
    """Return the command that grades the class of a folder."""
    words = ["grade", str(folder / "uploads"), "-o", str(out), "--course", str(folder / "course.toml")]
    return [sys.executable, "-m", "autograder", *words, "--examples", "1", "--time-limit", "10", *options]


def agreed(out: Path) -> dict[str, bytes]:
    """Return every file of a run without what two runs may differ in."""
    found = {}
    for path in sorted(path for path in out.rglob("*") if path.is_file()):
        data = path.read_bytes()
        if path.suffix == ".json":
            data = json.dumps({key: value for key, value in json.loads(data).items() if key not in OURS}).encode()
        found[path.relative_to(out).as_posix()] = data
    return found

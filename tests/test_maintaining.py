"""What the page for maintainers names is there: files, names in them, and targets of make."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
GUIDE = (ROOT / ".github" / "MAINTAINING.md").read_text(encoding="utf-8")
QUOTED = sorted(set(re.findall(r"`([^`\n]+)`", GUIDE)))
MADE = ("slam1d-demo/",)  # by the commands of the page


def test_every_file_that_is_named_is_there() -> None:
    """A path in the text is one of the repository; a bare name of a file is one of the sandbox."""
    paths = [text for text in QUOTED if re.fullmatch(r"[\w./-]+\.(py|toml|md|lock|yml)", text)]
    assert len(paths) >= 10
    for path in paths:
        if not path.startswith(MADE):
            assert (ROOT / path).exists() or (ROOT / "autograder" / "sandbox" / path).exists(), path


@pytest.mark.parametrize(
    ("path", "names"),
    {
        "autograder/sandbox/seccomp.py": ["POLICY", "Equal", "Masked", "Architecture"],
        "autograder/sandbox/policy.py": ["_PRELOADED", "_warm_up"],
        "autograder/sandbox/refusals.py": ["_NAMES"],
        "tests/sandbox/test_seccomp.py": ["ALLOWED"],
        "Makefile": ["FRAMES", "GUIDED_SECONDS"],
        "autograder/commands/doctor.py": ["--trace"],
    }.items(),
)
def test_every_name_that_is_given_exists(path: str, names: list[str]) -> None:
    """The names that the page tells to change stand in the files where it says they do."""
    text = (ROOT / path).read_text(encoding="utf-8")
    for name in names:
        assert name in GUIDE
        assert name in text, (path, name)


def test_every_target_of_make_exists() -> None:
    """`make X` in the page is a target of the Makefile."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for target in set(re.findall(r"make (\w+)(?: PYTHON=\S+)?`", GUIDE)):
        assert f"\n{target}:" in makefile, target

"""Gradescope's machine in a folder: /autograder remapped, the environment made of what is installed here."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path
from typing import Any


def unpack(archive: Path, root: Path) -> Path:
    """Lay the archive out as Gradescope does when it builds the image."""
    source = root / "source"
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(source)
    shutil.copy(source / "run_autograder", root / "run_autograder")
    (root / "run_autograder").chmod(0o755)
    (root / "submission").mkdir()
    return root


def make_environment(root: Path) -> None:
    """Stand in for setup.sh without a network: the packages of this environment, and the grader of the archive."""
    source = root / "source"
    venv.create(source / "environment", symlinks=True)
    (site,) = (source / "environment").glob("lib/python*/site-packages")
    (site / "here.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    shutil.copytree(source / "packages", site, dirs_exist_ok=True)


def hand_in(root: Path, files: dict[str, bytes], metadata: Any = None) -> None:
    """Put a student's files, and what Gradescope says about them, in their places."""
    shutil.rmtree(root / "submission")
    shutil.rmtree(root / "results", ignore_errors=True)
    for name, data in files.items():
        path = root / "submission" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    (root / "submission").mkdir(exist_ok=True)
    path = root / "submission_metadata.json"
    path.write_text(metadata if isinstance(metadata, str) else json.dumps(metadata or {}), encoding="utf-8")


def run_autograder(root: Path, before: str = "", **environment: str) -> tuple[dict[str, Any], str]:
    """Run the script as Gradescope does; return results.json and what was said on the side.

    `before` is Python that runs in the process first: a filter that stands for a container's.
    """
    script = str(root / "run_autograder")
    start = f"{before}\nimport os; os.execv({script!r}, [{script!r}])"
    run = subprocess.run(
        [sys.executable, "-c", start],
        cwd=root,
        env={"PATH": os.defpath + ":/usr/bin:/bin", "HOME": str(root), "AUTOGRADER_ROOT": str(root), **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout == ""
    return json.loads((root / "results" / "results.json").read_text(encoding="utf-8")), run.stderr

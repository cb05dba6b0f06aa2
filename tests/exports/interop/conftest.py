"""Other graders in environments of their own, made once and kept where INTEROP_ENVIRONMENTS says."""

from __future__ import annotations

import os
import subprocess
import sys
import venv
from collections.abc import Callable
from pathlib import Path

import pytest

WANTED = "INTEROP"


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave these tests out unless they are asked for: they install other systems from the network."""
    here = Path(__file__).parent
    skip = pytest.mark.skip(reason="installs another grader from the network: make interop")
    for item in items:
        if item.path.is_relative_to(here):
            item.add_marker(pytest.mark.slow)
            if not os.environ.get(WANTED):
                item.add_marker(skip)


@pytest.fixture(scope="session")
def environment(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Make an environment with a system in it, or take the one of an earlier run; return its bin folder."""

    def make(system: str, *more: str) -> Path:
        kept = os.environ.get("INTEROP_ENVIRONMENTS")
        folder = (Path(kept) if kept else tmp_path_factory.mktemp("environments")) / system.replace("==", "-")
        if not (folder / "ready").exists():
            venv.create(folder, with_pip=True, clear=True)
            pip = (folder / "bin" / "python", "-m", "pip", "--disable-pip-version-check", "--no-input", "-q")
            run([*pip, "install", system, *more], cwd=folder)
            (folder / "ready").touch()
        return folder / "bin"

    return make


def run(command: list[object], cwd: Path, timeout: float = 1200) -> str:
    """Run a command of another system in a folder; return what it printed, or fail with it."""
    first = Path(str(command[0])).parent
    done = subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        env={"PATH": f"{first}:/usr/bin:/bin", "HOME": str(cwd), "LANG": "C.UTF-8", **_network()},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=timeout,
    )
    assert done.returncode == 0, (
        f"{command} ended with {done.returncode}:\n{done.stdout[-3000:]}\n{done.stderr[-6000:]}"
    )
    return done.stdout


def _network() -> dict[str, str]:
    """Pass on what pip needs to find its index."""
    wanted = ("PIP_", "SSL_", "REQUESTS_", "http_proxy", "https_proxy", "HTTP_PROXY", "HTTPS_PROXY", "no_proxy")
    found = {name: value for name, value in os.environ.items() if name.startswith(wanted)}
    config = Path.home() / ".config" / "pip" / "pip.conf"
    return {"PIP_CONFIG_FILE": str(config), **found} if config.exists() else found


@pytest.fixture(scope="session")
def grader() -> Callable[..., None]:
    """Run our own command line as a process of its own."""

    def grade(*arguments: object) -> None:
        root = Path(__file__).resolve().parents[3]
        done = subprocess.run(
            [sys.executable, "-m", "autograder", *map(str, arguments)],
            cwd=root,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr

    return grade

"""`autograder doctor`: the level in its words, every limit tried, and what to do where something is missing."""

from __future__ import annotations

import functools
import json
import platform
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from autograder.commands._remedy import CONTAINER, what_to_do
from autograder.errors import SandboxError
from autograder.sandbox import host, refusals, selftest
from autograder.sandbox.refusals import Part
from autograder.sandbox.selftest import Check

Ended = tuple[int, str, str]
linux = pytest.mark.skipif(sys.platform != "linux", reason="the locks are Linux's own")
SMALL = ("--time-limit", 0.1, "--memory", 64, "--output-limit", 1)
WORDS = {
    "computing time": ["0.1 s", "an endless loop ended after", "it took longer than 0.1 s of computing"],
    "waiting time": ["0.3 s", "an endless sleep ended after", "0.3 s of waiting"],
    "memory": ["64 MiB", "a memory bomb ended after", "it needed more than 64 MiB of memory"],
    "output": ["1 MiB", "an output flood ended after", "it printed more than 1 MiB"],
    "processes": ["none", "starting a process: refused"],
    "files": ["none", "opening a file: refused"],
}


@pytest.fixture
def untried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the limits out: they have a test of their own."""
    monkeypatch.setattr(selftest, "check_limits", lambda _: iter(()))


@pytest.fixture
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Allow for a machine that does much else beside these tests."""
    monkeypatch.setattr(selftest, "_SLACK", 30.0)


def without(monkeypatch: pytest.MonkeyPatch, lock: str) -> None:
    """Take a lock away from this machine."""
    monkeypatch.setattr(host, "Sandbox", functools.partial(host.Sandbox, without=[lock]))


@linux
def test_the_level_and_every_limit_are_shown(run: Callable[..., Ended], patient: None) -> None:
    """The level stands there once, in the words of the reports; each limit says how it ended, and exit 0 ready."""
    code, text, _ = run("doctor", *SMALL)
    level = next(line for line in text.splitlines() if line.startswith("confinement"))
    assert level.split()[1] in {"full:", "seccomp:"}
    assert level.count(level.split()[1]) == 1
    for name, words in WORDS.items():
        line = next(line for line in text.splitlines() if line.startswith(f"  {name}"))
        assert all(word in line for word in words), line
    assert "numpy" in text
    assert "\nmissing      " in text
    assert "\nwhat to do   " in text
    assert code == 0, text


@linux
def test_json_holds_the_same(run: Callable[..., Ended], patient: None) -> None:
    """One object, with each limit, what was tried, whether it held, and how long that took."""
    code, text, _ = run("doctor", *SMALL, "--json")
    found = json.loads(text)
    assert (code, found["ready"]) == (0, True)
    assert found["confinement"]["wording"].startswith(found["confinement"]["level"] + ": ")
    assert {check["name"]: check["held"] for check in found["limits"]} == dict.fromkeys(WORDS, True)
    seconds = {check["name"]: check["seconds"] for check in found["limits"]}
    assert 0 < seconds["computing time"] < 1.1
    assert seconds["waiting time"] > 0.29


@linux
def test_an_end_that_comes_late_is_not_held(run: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch) -> None:
    """A limit that ends an attempt, but too late, has not held; exit 3."""
    monkeypatch.setattr(selftest, "_SLACK", -100.0)
    code, text, _ = run("doctor", *SMALL)
    assert code == 3
    assert "an endless sleep: DID NOT HOLD: it ended only after " in text


@linux
def test_without_a_lock_it_gives_the_command(run: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch) -> None:
    """Exit 3, no memory bomb on an open machine, and the exact command for a container."""
    without(monkeypatch, "seccomp")
    code, text, _ = run("doctor", *SMALL)
    assert code == 3
    assert "confinement  none: NOT CONFINED" in text
    assert "not tried" in text
    assert "  docker build -t " in text
    assert "  docker run --rm --network none --user " in text


@linux
@pytest.mark.parametrize(("demanded", "end"), [("full", 3), ("seccomp", 0)])
def test_a_course_may_demand_more(
    run: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, untried: None, demanded: str, end: int
) -> None:
    """Ready means that `grade` would not refuse: what a course demands counts, and what is missing is named."""
    without(monkeypatch, "landlock")
    course = tmp_path / "course.toml"
    course.write_text(f'[confinement]\nminimum = "{demanded}"\n')
    code, text, _ = run("doctor", "--course", course)
    assert code == end
    assert "seccomp: Landlock unavailable (switched off)" in text
    assert "Linux 5.13" in text
    assert ("The course demands full" in text) == (demanded == "full")


@pytest.mark.parametrize(
    ("system", "machine", "words"),
    [
        ("Windows", "AMD64", ["wsl --install", "autograder grade uploads -o graded", "docker run", "${PWD}"]),
        ("Darwin", "arm64", ["docker build", "docker run", '"$PWD:/course"']),
        ("Linux", "riscv64", ["x86_64 or aarch64", "riscv64"]),
        ("Linux", "x86_64", ["seccomp", "docker run"]),
    ],
)
def test_every_system_has_its_command(system: str, machine: str, words: list[str]) -> None:
    """Where there is no lock, each system is told what to type, and what `grade` does here."""
    text = "\n".join(what_to_do("none", "seccomp", system, machine))
    assert all(word in text for word in [*words, "--allow-unconfined"]), text
    assert "{" not in text.replace("${PWD}", "")


def test_the_container_is_what_the_dockerfile_makes() -> None:
    """The printed command gives the image what its entry point and its folder expect."""
    made = (Path(__file__).resolve().parents[2] / "Dockerfile").read_text()
    build, run = CONTAINER
    assert 'ENTRYPOINT ["autograder"]' in made
    assert "WORKDIR /course" in made
    assert ':/course"' in run
    assert f"{build.split()[3]} grade uploads -o graded" in run


@pytest.mark.parametrize(("system", "word"), [("Windows", "wsl --install"), ("Linux", "BROKEN")])
def test_a_sandbox_that_does_not_start(
    run: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch, system: str, word: str
) -> None:
    """Windows has none by nature and is told where to grade; anywhere else it is broken, and says why."""

    def refuse(*_: Any, **__: Any) -> None:
        raise SandboxError("It does not start here.")

    monkeypatch.setattr(host, "Sandbox", refuse)
    monkeypatch.setattr(platform, "system", lambda: system)
    code, text, _ = run("doctor")
    assert code == 3
    assert word in text
    assert "It does not start here." in text
    assert json.loads(run("doctor", "--json")[1])["ready"] is False


@linux
def test_a_limit_that_does_not_hold_is_not_ready(run: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch) -> None:
    """Exit 3, and the limit that failed is marked."""
    check = Check("memory", held=False, message="it went through", limit="64 MiB", attempt="a memory bomb", seconds=0.1)
    monkeypatch.setattr(selftest, "check_limits", lambda _: iter([check]))
    code, text, _ = run("doctor")
    assert code == 3
    assert "a memory bomb: DID NOT HOLD: it went through" in text


@linux
def test_trace_names_the_refused_call(
    run: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, untried: None
) -> None:
    """A part that fails on a refused call is named with the call and the line that decides; exit 3."""
    part = "import os\ndef part_reading():\n    os.open('/etc/passwd', 0)\n    return 1.0\n"
    (tmp_path / "torture.py").write_text(part)
    monkeypatch.setattr(refusals, "TORTURE", tmp_path / "torture.py")
    code, text, _ = run("doctor", "--trace")
    if "not possible here" in text:
        pytest.skip("this kernel cannot trace")
    assert code == 3
    assert "1 of 2 parts" in text
    assert "reading              FAILS; refused: openat (1 times)" in text
    assert "autograder/sandbox/seccomp.py, line " in text


@linux
@pytest.mark.parametrize(
    ("parts", "end", "words"),
    [
        ([Part("fft", passed=True, refused={})], 0, "refused no system call"),
        ([Part("fft", passed=True, refused={"uname": 2})], 0, "works; refused: uname (2 times)"),
        ([Part("fft", passed=False, refused={})], 3, "the filter is not to blame"),
        (SandboxError("There is no filter."), 3, "not possible here: There is no filter."),
    ],
)
def test_trace_tells_harmless_from_broken(
    run: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch, untried: None, parts: Any, end: int, words: str
) -> None:
    """A refusal that a part survives is shown and is no failure."""

    def trace() -> list[Part]:
        if isinstance(parts, SandboxError):
            raise parts
        return list(parts)

    monkeypatch.setattr(refusals, "trace", trace)
    code, text, _ = run("doctor", "--trace")
    assert (code, words in text) == (end, True), text

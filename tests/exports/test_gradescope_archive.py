"""autograder.zip: the scripts at its root, the locked versions, the rules, and nothing that is secret."""

from __future__ import annotations

import json
import os
import re
import subprocess
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from autograder.errors import UsageError
from autograder.exports.gradescope.requirements import installed_lock, locked, runtime_lock
from autograder.exports.gradescope.submitter import student_id, submitters
from autograder.problems.families import family
from autograder.problems.ledger import Ledger, write_ledger
from autograder.problems.roster import Student
from autograder.problems.secret import Secret

ROOT = Path(__file__).resolve().parents[2]
SECRET = Secret(b"not in any file!!")
Run = Callable[..., tuple[int, str, str]]
MOST = 2_000_000  # bytes: an upload of a moment


@pytest.fixture
def ledger() -> Ledger:
    """Draw a class of two."""
    drawn = Ledger()
    drawn.extend(SECRET, "2026", {"s1": family("A"), "ann@uni.edu": family("A")})
    return drawn


def test_the_archive_is_laid_out_as_gradescope_wants_it(run: Run, tmp_path: Path) -> None:
    """Both scripts stand at the root and may be run; the packages and the rules are there."""
    code, _, err = run("export", "gradescope", "-o", tmp_path / "a.zip", "--seed", 7, "--feedback", "hint")
    assert code == 0, err
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        modes = {info.filename: info.external_attr >> 16 for info in archive.infolist()}
        rules = json.loads(archive.read("rules.json"))
    assert modes["setup.sh"] == modes["run_autograder"] == 0o100755
    assert {name.split("/")[0] for name in modes} == {
        "setup.sh", "run_autograder", "requirements.txt", "rules.json", "fallback.json", "packages", "exam",
    }  # fmt: skip
    assert "packages/reference_solution/slam1d.py" in modes
    assert not [name for name in modes if "specimens" in name or name.endswith(".pyc")]
    assert (rules["seed"], rules["feedback"], rules["visibility"]) == (7, "hint", "visible")
    assert (tmp_path / "a.zip").stat().st_size < MOST
    assert re.search(r"\d+ kB", err)


def test_the_same_export_is_the_same_bytes(run: Run, tmp_path: Path) -> None:
    """Nothing in the archive depends on when it was made."""
    for name in ("a.zip", "b.zip"):
        run("export", "gradescope", "-o", tmp_path / name)
    assert (tmp_path / "a.zip").read_bytes() == (tmp_path / "b.zip").read_bytes()


def test_names_and_secrets_stay_at_home(run: Run, tmp_path: Path, ledger: Ledger) -> None:
    """The archive has ids, addresses and variants; no names, and not the secret of the term."""
    write_ledger(tmp_path / "variants.csv", ledger)
    roster = tmp_path / "class.csv"
    roster.write_text("student_id,name,email\ns1,Ann Lee,ann@uni.edu\ns9,Bo Li,bo@uni.edu\n", encoding="utf-8")
    code, _, err = run(
        "export", "gradescope", "--ledger", tmp_path / "variants.csv", "--roster", roster, "-o", tmp_path / "a.zip"
    )
    assert code == 0
    assert "1 students of the roster have no variant: s9" in err
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        held = {name: archive.read(name) for name in archive.namelist()}
    assert held["roster.csv"] == b"student_id,email\ns1,ann@uni.edu\ns9,bo@uni.edu\n"
    assert not [name for name, data in held.items() if SECRET.key in data or b"Ann Lee" in data and "csv" in name]


def test_term_and_secret_draw_what_the_release_drew(run: Run, tmp_path: Path) -> None:
    """Without a ledger the archive holds the one of the release and the seed of the term, and no secret."""
    roster, secret = tmp_path / "class.csv", tmp_path / "secret.txt"
    roster.write_text("student_id,name,email\ns1,Ann Lee,ann@uni.edu\n", encoding="utf-8")
    secret.write_bytes(SECRET.key)
    drawn = ("--roster", roster, "--term", "2026S", "--secret-file", secret)
    assert run("release", *drawn, "-o", tmp_path / "release")[0] == 0
    code, _, err = run("export", "gradescope", *drawn, "-o", tmp_path / "a.zip")
    assert code == 0, err
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        held = {name: archive.read(name) for name in archive.namelist()}
    assert (tmp_path / "release" / "staff" / "variants.csv").read_bytes() in held.values()
    assert json.loads(held["rules.json"])["seed"] == SECRET.seed("2026S")
    assert not [name for name, data in held.items() if SECRET.key in data]


def test_the_lock_keeps_what_grading_needs() -> None:
    """What the program needs are locked with hashes; what only development needs is not installed."""
    text, origin = locked(None)
    names = set(re.findall(r"^([a-z0-9-]+)==", text, re.MULTILINE))
    assert origin == "requirements.lock"
    assert {"numpy", "msgspec", "nbformat", "jinja2", "rich", "click", "markupsafe"} <= names
    assert not {"hypothesis", "sortedcontainers"} & names
    assert not names & {"pytest", "ruff", "mypy", "ipykernel", "coverage"}
    assert all("--hash=sha256:" in block for block in re.split(r"\n(?=[a-z])", text))


def test_without_a_lock_file_the_installed_versions_count() -> None:
    """An installed wheel has no lock file beside it; what runs here runs there."""
    names = set(re.findall(r"^([a-z0-9-]+)==\S+$", installed_lock().lower(), re.MULTILINE))
    assert {"numpy", "msgspec", "markupsafe"} <= names
    assert not {"hypothesis", "sortedcontainers"} & names
    assert "pytest" not in names


def test_a_bad_lock_is_named(tmp_path: Path) -> None:
    """A lock file that is none ends in a sentence."""
    with pytest.raises(UsageError, match="make lock"):
        runtime_lock("numpy==2.4\n", "requirements.lock")
    with pytest.raises(UsageError, match="cannot be read"):
        locked(tmp_path / "missing.lock")


@pytest.mark.parametrize("script", ["setup.sh", "run_autograder"])
def test_the_scripts_are_proper_bash(script: str) -> None:
    """Bash parses them."""
    path = ROOT / "autograder" / "exports" / "gradescope" / script
    assert os.access(path, os.X_OK)
    subprocess.run(["bash", "-n", path], check=True)


def test_a_student_is_known_by_address_or_id(ledger: Ledger) -> None:
    """The roster's address, the roster's id, or an id of the ledger; nothing else."""
    roster = [Student("s1", "Ann", "Ann@Uni.edu"), Student("s2", "Bo", "bo@uni.edu")]
    assert student_id([("ann@uni.edu", "9")], roster, ledger) == "s1"
    assert student_id([("x@y.z", "S2")], roster, ledger) == "s2"
    assert student_id([("ann@uni.edu", "9")], [], ledger) == "ann@uni.edu"
    assert student_id([("x@y.z", "9"), ("bo@uni.edu", "8")], roster, ledger) == "s2"
    assert student_id([("s@uni.edu", "1")], roster, ledger) is None
    assert student_id([], roster, None) is None


def test_gradescopes_own_number_names_nobody(tmp_path: Path) -> None:
    """The number of a user is not that of a student: only the address says who it is."""
    path = tmp_path / "submission_metadata.json"
    path.write_text('{"users": [{"email": "ann@uni.edu", "id": 4711, "name": "Ann Lee"}]}')
    assert submitters(path) == [("ann@uni.edu",)]


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"users": 3}', '{"users": [3, {"email": null}]}', "[" * 100_000, '{"users": null}']
)
def test_odd_metadata_cost_nothing(tmp_path: Path, text: str) -> None:
    """Whatever stands in the file, nobody is named and nothing is raised."""
    path = tmp_path / "submission_metadata.json"
    path.write_text(text, encoding="utf-8")
    assert [name for names in submitters(path) for name in names] == []
    assert submitters(tmp_path / "missing.json") == []

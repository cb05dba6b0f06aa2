"""The archive at work, in Gradescope's layout: the marks of `grade`, and a readable result whatever happens."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from ctypes.util import find_library
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from autograder import cli
from autograder.problems.families import family
from autograder.problems.ledger import Ledger, write_ledger
from autograder.problems.secret import Secret
from autograder.stages.slips.residual import SLIPS
from autograder.stages.slips.submission import submission_text
from reference_solution import slam1d
from tests.exports.gradescope_layout import hand_in, make_environment, run_autograder, unpack
from tests.exports.test_gradescope_results import SCHEMA
from tests.sandbox.test_escapes import IN_A_CONTAINER

pytestmark = pytest.mark.slow

REFERENCE = Path(slam1d.__file__).read_bytes()
HOSTILE = Path(cli.__file__).parent / "specimens" / "hostile"
EXAMPLES = 5
ANN = {"id": 1, "users": [{"email": "Ann@uni.edu", "id": 4711, "name": "Ann Lee"}], "created_at": "2026-03-02"}


def ours(*arguments: object) -> int:
    """Run the command line in this process."""
    with pytest.raises(SystemExit) as end:
        cli.main([str(argument) for argument in arguments])
    return int(end.value.code or 0)


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Export, with a ledger, and lay out the machine."""
    place = tmp_path_factory.mktemp("gradescope")
    ledger = Ledger()
    ledger.extend(Secret(b"not in any file!!"), "2026", {"s1": family("A")})
    write_ledger(place / "variants.csv", ledger)
    (place / "class.csv").write_text("student_id,email\ns1,ann@uni.edu\n", encoding="utf-8")
    code = ours(
        "export", "gradescope", "--seed", 3, "--examples", EXAMPLES, "--ledger", place / "variants.csv",
        "--roster", place / "class.csv", "-o", place / "autograder.zip",
    )  # fmt: skip
    assert code == 0
    root = unpack(place / "autograder.zip", place / "autograder")
    make_environment(root)
    return root


@pytest.fixture
def handed_in(machine: Path) -> Callable[..., dict[str, Any]]:
    """Hand files in, run the script, and read a results.json that fits the documentation."""

    def go(files: dict[str, bytes], metadata: Any = None, before: str = "", **environment: str) -> dict[str, Any]:
        hand_in(machine, files, metadata)
        found, _ = run_autograder(machine, before, **environment)
        jsonschema.validate(found, SCHEMA)
        assert {test["visibility"] for test in found["tests"]} <= {"visible"}
        return found

    return go


def test_the_marks_are_those_of_grade(handed_in: Callable[..., dict[str, Any]], tmp_path: Path) -> None:
    """A file gets, check by check, what `autograder grade` gives it, with posegraph.py beside it or not."""
    text = submission_text(
        next(slip for slip in SLIPS if slip.identifier == "loop_residual_without_measurement"), "residual"
    )
    (tmp_path / "slam1d.py").write_text(text, encoding="utf-8")
    assert ours("grade", tmp_path / "slam1d.py", "-o", tmp_path / "out", "--seed", 3, "--examples", EXAMPLES) == 0
    expected = json.loads((tmp_path / "out" / "results" / "slam1d.json").read_text(encoding="utf-8"))
    found = handed_in({"slam1d.py": text.encode(), "posegraph.py": b"x = 1\n", "notes.txt": b"hello"})
    assert found["score"] == expected["score"] > 0
    checks = [check for stage in expected["stages"] if stage["status"] != "awaiting_mark" for check in stage["checks"]]
    counted = [(test["score"], test["max_score"]) for test in found["tests"] if not test["name"].startswith("written")]
    assert counted == [(check["points"], check["max_points"]) for check in checks]
    assert "leaves its measurement out" in json.dumps(found)


def test_the_variant_on_record_is_that_of_the_address(handed_in: Callable[..., dict[str, Any]]) -> None:
    """Who is in the ledger is judged on the own variant; who is not is told so."""
    assert handed_in({"slam1d.py": REFERENCE}, ANN)["extra_data"]["variant"].startswith("A-")
    found = handed_in({"slam1d.py": REFERENCE}, {"users": [{"email": "bo@uni.edu", "id": 1}]})
    assert found["extra_data"]["variant"] == "worked-example"
    assert "No variant is on record for your address" in found["output"]


@pytest.mark.skipif(find_library("seccomp") is None, reason="libseccomp, which makes the profile, is not installed")
@pytest.mark.skipif(not HOSTILE.is_dir(), reason="the hostile specimens are not in this checkout")
@pytest.mark.parametrize("name", ["case_15_write_results", "case_16_print_a_report"])
def test_a_submission_cannot_write_its_result(handed_in: Callable[..., dict[str, Any]], name: str) -> None:
    """As root, in what a container allows, an attempt to forge the result earns nothing."""
    text = (HOSTILE / f"{name}.py").read_text(encoding="utf-8")
    root = str(Path("results") / "results.json")
    text += (
        "\n\nimport os\nfor at in ('.', '/autograder', os.environ.get('AUTOGRADER_ROOT', '.')):\n"
        f"    open(at + '/{root}', 'w').write('{{\"score\": 100}}')\n"
    )
    found = handed_in({"slam1d.py": text.encode()}, before=IN_A_CONTAINER)
    assert found["extra_data"]["confinement"] in {"full", "seccomp"}
    assert found["score"] <= 15


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({}, "holds no submission (found nothing)"),
        ({"a.py": b"x = 1", "b.py": b"x = 2"}, "holds 2 submissions (a.py, b.py)"),
        ({"slam1d.zip": b"PK\x03\x04"}, "zip"),
    ],
    ids=["nothing", "two", "truncated"],
)
def test_an_upload_that_cannot_be_read_is_told_why(
    handed_in: Callable[..., dict[str, Any]], files: dict[str, bytes], words: str
) -> None:
    """The sentence of intake is the student's, and the score is 0."""
    found = handed_in(files, "this is no JSON")
    assert (found["score"], found["tests"]) == (0.0, [])
    assert words in found["output"]


def test_whatever_breaks_leaves_a_readable_result(machine: Path, tmp_path: Path) -> None:
    """Killed, broken or without room: the file says that it is no fault of the student."""
    broken = shutil.copytree(machine, tmp_path / "broken", symlinks=True)
    hand_in(broken, {"slam1d.py": REFERENCE})
    for spoil, environment in (
        (lambda: None, {"AUTOGRADER_SECONDS": "0.2"}),
        (lambda: (broken / "source" / "rules.json").write_text("{"), {}),
        (lambda: shutil.rmtree(broken / "source" / "environment"), {}),
    ):
        spoil()
        found, said = run_autograder(broken, **environment)  # type: ignore[arg-type]  # a table of two kinds of rows
        jsonschema.validate(found, SCHEMA)
        assert found["score"] == 0
        assert "no fault of yours" in found["output"]
        assert "The grader ended with" in said


def test_a_result_of_an_earlier_run_is_not_left(handed_in: Callable[..., dict[str, Any]], machine: Path) -> None:
    """What stands in results before the run is replaced."""
    hand_in(machine, {"slam1d.py": b"def residual(x, graph):\n    return None\n"})
    (machine / "results").mkdir()
    (machine / "results" / "results.json").write_text('{"score": 100}', encoding="utf-8")
    found, _ = run_autograder(machine)
    assert found["score"] == 0
    assert os.access(machine / "results" / "results.json", os.R_OK)

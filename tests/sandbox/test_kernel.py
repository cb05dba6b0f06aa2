"""How numpy computes is the same in the grader, its workers and the locked processes, however a machine is set."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.engine.exam import exam_of
from autograder.sandbox.host import Server
from autograder.sandbox.kernel import ONE_THREAD, kernel_settings
from tests.engine import small_class

# A grader whose own numpy is loaded by one setting, and whose workers are started by another.
TWO_KERNELS = """
import os, sys
import numpy
os.environ["OPENBLAS_CORETYPE"] = sys.argv.pop(1)
from autograder.cli import main
main(sys.argv[1:])
"""
# Its products of matrices are wrong by what single precision and rounding take away.
ROUGH = """

def jacobian(x, graph):
    J = np.zeros((graph.n_factors, graph.n_poses), dtype=np.float32)
    for row, (i, j) in enumerate(graph.edges):
        J[row, i], J[row, j] = 1.0, -1.0
    for row, k in enumerate(graph.priors, len(graph.edges)):
        J[row, k] = 1.0
    return J


def information_matrix(graph):
    return np.diag(1 / np.r_[graph.edge_variances, graph.prior_variances]).astype(np.float32)


def normal_equations(J, omega, f):
    return np.round(J.T @ omega @ J, 3), np.round(J.T @ omega @ f, 3)
"""


def test_a_fork_server_gets_the_settings_of_the_grader(monkeypatch: pytest.MonkeyPatch) -> None:
    """What chooses the kernel is handed on; what else stands in the environment is not, nor a value that is no word."""
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Nehalem")
    monkeypatch.setenv("NPY_DISABLE_CPU_FEATURES", "AVX2 FMA3")
    monkeypatch.setenv("MKL_CBWR", "AVX2;reboot")
    monkeypatch.setenv("LD_PRELOAD", "")
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "7")
    server = Server()
    try:
        words = Path(f"/proc/{server.pid}/environ").read_text(encoding="utf-8").strip("\0").split("\0")
    finally:
        server.close()
    found = dict(word.split("=", 1) for word in words)
    assert found["OPENBLAS_CORETYPE"] == "Nehalem"
    assert found["NPY_DISABLE_CPU_FEATURES"] == "AVX2 FMA3"
    assert found["OPENBLAS_NUM_THREADS"] == "1"
    ours = {"PYTHONHASHSEED", "LC_ALL", "OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES", *ONE_THREAD}
    assert set(found) - set(kernel_settings(os.environ)) <= ours
    assert not {"MKL_CBWR", "LD_PRELOAD", "PATH", "HOME"} & set(found)


@given(st.dictionaries(st.sampled_from(["OPENBLAS_CORETYPE", "MKL_CBWR", "NPY_DISABLE_CPU_FEATURES"]), st.text()))
def test_whatever_is_set_only_short_words_get_through(environment: dict[str, str]) -> None:
    """A value is a few words of letters and digits, and bounded, or it is left out."""
    for name, value in kernel_settings(environment).items():
        assert environment[name] == value
        assert len(value) < 5000
        assert all(letter.isascii() and (letter.isalnum() or letter in "_, \t") for letter in value)


@pytest.fixture(scope="module")
def marks(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, bytes]]:
    """Grade a small class with slips of precision and rounding, under the setting of this machine."""
    texts = {**small_class.CLASS, "rough": small_class.REFERENCE + ROUGH}
    folder = small_class.make(tmp_path_factory.mktemp("kernels"), texts)
    (folder / "course.toml").unlink()
    return folder, _graded(folder, "here", [sys.executable, "-m", "autograder"], None)


def _graded(folder: Path, name: str, program: list[str], kernel: str | None) -> dict[str, bytes]:
    environment = {key: value for key, value in os.environ.items() if key != "OPENBLAS_CORETYPE"}
    if kernel:
        environment["OPENBLAS_CORETYPE"] = kernel
    words = ["grade", str(folder / "uploads"), "-o", str(folder / name), "--examples", "5", "--time-limit", "10"]
    subprocess.run([*program, *words], env=environment, check=True, capture_output=True)
    run = small_class.agreed(folder / name)
    asked = exam_of(run.pop("exam"), "exam").digest.encode()  # its answers have the last bits of who worked them out
    return {path: data for path, data in {**run, "exam": asked}.items() if path != "run.json"}


@pytest.mark.slow
@pytest.mark.parametrize(("grader", "workers"), [("Haswell", "Prescott"), ("Prescott", "Haswell"), (None, "Nehalem")])
def test_marks_and_words_are_the_same_under_every_kernel(
    marks: tuple[Path, dict[str, bytes]], grader: str | None, workers: str
) -> None:
    """Every file of a run is the same byte for byte, also where the workers compute otherwise than the grader."""
    folder, expected = marks
    found = _graded(folder, f"{grader}-{workers}", [sys.executable, "-c", TWO_KERNELS, workers], grader)
    assert found.keys() == expected.keys()
    assert [path for path in found if found[path] != expected[path]] == []

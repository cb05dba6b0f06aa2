"""No number of the handout is typed in: whole or decimal, in figures or in words, all come from code."""

import json
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from autograder.problems.conclusion import CHOICES
from autograder.problems.families.worked_example import worked_example
from autograder.problems.problem import worked_problem
from autograder.render.handout import render_assignment
from autograder.render.stub import CORE
from autograder.render.template import source
from autograder.render.values import PLAN, WORDS, values
from reference_solution import slam1d, solve_times
from tests.render.prose import STUDENTS, prose

# Figures that number things, and tell no fact about the subject.
NUMBERING = re.compile(r"^## (?:Part )?\d[.:]|[Qq]uestions? \d(?: \(\) and \d)?|Parts 1 to|\b1D\b|\(\d\)", re.MULTILINE)
FORMULA = re.compile(r"\$\$.*?\$\$|\$.*?\$", re.DOTALL)


def typed_figures(text):
    """Numbers in figures that somebody typed: outside of formulas any, inside of them above 3 or with a point."""
    text = re.sub(r"`[^`]*`", "", NUMBERING.sub("", text))
    outside = re.findall(r"(?<![\w.^])\d+(?:[.,]\d+)*", FORMULA.sub("", text))
    inside = re.findall(r"\d+(?:\.\d+)?", " ".join(FORMULA.findall(text)))
    return [number for number in outside if number not in ALLOWED] + [n for n in inside if n not in SMALL]


SMALL = ("0", "1", "2", "3")  # indices, exponents, the factor of a derivative, the number of an iterate
ALLOWED = {
    "0": "what an entry or a residual is where nothing is",
    "1": "the numerator of a weight",
    "2": "the example of the notation: pose 2 and iterate 2",
}


@pytest.mark.parametrize("name", STUDENTS)
def test_no_number_is_typed_in(name):
    """The prose that students read holds no number of its own in figures."""
    assert typed_figures(prose(name)) == []


def test_typed_numbers_are_seen():
    """Whole and decimal numbers are found in sentences, tables and formulas; names and indices are not."""
    text = "a walk of 100 poses | 0.25 m | $x = 4$, $\\sigma = 0.1$ ($n = 15$)"
    assert typed_figures(text) == ["100", "0.25", "4", "0.1", "15"]
    assert (
        typed_figures("## Part 1: f\n## 2. More\nquestion 3, `x[5]`, 1D, $\\mathbf x^{(3)}$, $2\\mathbf b$, slam1d")
        == []
    )


# Words for numbers that tell no fact, or one that a test below holds to code.
PHRASES = re.compile(
    r"two or three sentences|powers of ten|a loop closure about every ten poses"
    r"|Three orders: [^;.]*; [^;.]*; [^;.]*\.|three hours"
)


@pytest.mark.parametrize("name", STUDENTS)
def test_no_count_is_typed_in_words(name):
    """From three upwards, things are counted by code, in words as well."""
    words = PHRASES.sub("", prose(name))
    assert re.findall(rf"\b(?:{'|'.join(WORDS[3:])}|hundreds?|thousands?)\b", words, re.IGNORECASE) == []


def test_what_is_counted_in_words_is_there():
    """Functions, steps, states and experiments are as many as the handout says."""
    told = values(worked_problem())
    assert told["functions_word"] == WORDS[len(CORE)] == "five"
    assert told["functions"] == sum(bool(re.match(r"^\d: ", part)) for part, _minutes in PLAN)
    notebook = source("slam1d.ipynb.j2")
    assert len(re.findall(r"^## Part \d: ", notebook, re.MULTILINE)) == told["functions"]
    asked = re.search(r"put \$(.*)\$ in the rows", notebook)
    assert asked is not None
    assert told["states_word"] == WORDS[asked.group(1).count("mathbf x")]
    assert WORDS.index(told["steps_word"]) == WORDS.index(told["states_word"]) - 1
    experiments = re.findall(r"^## \d\. (?!.*bonus).*$", source("explore.ipynb.j2"), re.MULTILINE)
    assert told["experiments_word"] == WORDS[len(experiments)]
    assert source("explore.ipynb.j2").count("fill_in(pairs, ") == WORDS.index("three")  # orders


def test_every_tenth_pose_closes_a_loop():
    """The systems whose solution was timed have the loops that the handout tells, and can be solved."""
    for n in (30, 300):
        rows, columns, values_of_H, b = solve_times.system(n)
        H = np.zeros((n, n))
        np.add.at(H, (rows, columns), values_of_H)
        loops = np.count_nonzero(np.triu(H, 1)) - (n - 1)
        assert 0.08 <= loops / n <= 0.1
        assert np.all(np.linalg.eigvalsh(H) > 0)
        assert b.shape == (n,)


class Dense:
    """What the script asks of scipy, done by numpy: the script runs where scipy is not."""

    def __init__(self, entries, shape):
        self.full = np.zeros(shape)
        np.add.at(self.full, entries[1], entries[0])

    def tocsc(self):
        return self

    def toarray(self):
        return self.full


def test_the_script_of_the_timing_writes_what_the_handout_draws(tmp_path, monkeypatch):
    """It measures every size, dense and sparse, in the form of the committed figures."""
    scipy = {
        "scipy.sparse": SimpleNamespace(coo_matrix=Dense),
        "scipy.sparse.linalg": SimpleNamespace(spsolve=lambda H, b: np.linalg.solve(H.full, b)),
    }
    monkeypatch.setattr(solve_times.importlib, "import_module", scipy.__getitem__)
    committed = json.loads(Path(solve_times.__file__).with_name("solve_times.json").read_text(encoding="utf-8"))
    assert [n for n, _seconds in committed["dense"]] == list(solve_times.SIZES)
    monkeypatch.setattr(solve_times, "SIZES", (30, 60))
    monkeypatch.setattr(solve_times, "__file__", str(tmp_path / "solve_times.py"))
    solve_times.main()
    measured = json.loads((tmp_path / "solve_times.json").read_text(encoding="utf-8"))
    assert measured.keys() == committed.keys()
    assert [n for n, _seconds in measured["sparse"]] == [30, 60]
    assert all(seconds > 0 for curve in measured.values() for _n, seconds in curve)


def test_the_choices_count_nothing_that_is_a_fact():
    """The choices of question 3 hold no figure."""
    assert [text for text in CHOICES.values() if re.search(r"\d", text)] == []


def test_the_minutes_fit_into_three_hours():
    """The parts together, and the optional notebook by itself, keep to the time that the course gives."""
    assert sum(minutes for _part, minutes in PLAN) <= 180
    assert values(worked_problem())["explore_minutes"] <= 60


def test_the_numbers_of_the_handout_are_right():
    """Counts and weights in the rendered text agree with numpy, which shares no code with the templates."""
    text = render_assignment(worked_problem())["README.md"]
    graph = worked_example()
    H, _b = slam1d.normal_equations(
        slam1d.jacobian(np.zeros(5), graph), slam1d.information_matrix(graph), np.zeros(graph.n_factors)
    )
    entries = np.count_nonzero(H)
    assert f"$5 + 2 \\times 5 = {entries}$ of {H.size} entries" in text
    sums = ", ".join(f"{round(value)}" for value in H.sum(axis=1))
    assert f"add up to the prior weights: ({sums}) here" in text
    assert "a walk of 100 poses past 20 landmarks, with some 400 observations" in text
    assert "has 99 edges out of 4950 possible pairs" in text

"""The reported answers: judged on the variant on record, with follow-through; words await a human reader."""

import json
from pathlib import Path

import numpy as np
import pytest

from autograder.course import Course
from autograder.engine.grade import Assigned, Settings, grade
from autograder.intake.submission import collect
from autograder.intake.written import written_answers
from autograder.problems.conclusion import RIGHT, choices
from autograder.problems.copied import Numbers
from autograder.problems.families import family
from autograder.problems.secret import Secret
from autograder.problems.variants import draw_variant, published
from reference_solution import slam1d
from tests.engine.conftest import REFERENCE

SETTINGS = Settings(examples=5, time_limit=0.5, workers=1)
HALF = "\n\n_whole = gauss_newton_step\n\ndef gauss_newton_step(x, graph):\n    return 0.5 * _whole(x, graph)\n"


def letter(variant, identifier=RIGHT):
    """Return the letter of a choice in the order of a variant."""
    return next(choice.letter for choice in choices(variant) if choice.identifier == identifier)


def answered(iterates, conclusion):
    """Write the lines of a submission that report answers."""
    return f"\niterates = np.array({np.asarray(iterates).tolist()})\nconclusion = {conclusion!r}\n"


@pytest.fixture
def graded(tmp_path):
    """A function that grades one text for one variant, and returns its verdicts and the result."""

    def run(text, assigned=None):
        (tmp_path / "ada.py").write_text(text)
        made = grade(
            collect([tmp_path / "ada.py"]),
            Course(),
            SETTINGS,
            tmp_path / "out",
            assigned=None if assigned is None else {"ada": assigned},
        )
        result = made.results[0]
        return {stage.name: stage for stage in result.stages}, result

    return run


EXAMPLE = published()


def test_right_answers_pass(graded):
    """The right iterates and the right letter earn all points of the stage."""
    stages, _ = graded(REFERENCE + answered(EXAMPLE.iterates, letter("worked-example")))
    assert (stages["answers"].status, stages["answers"].score) == ("passed", 5.0)


def test_unset_answers_are_missing_and_no_error(graded):
    """None is unfinished."""
    stages, result = graded(REFERENCE + "\niterates = None\nconclusion = None\n")
    assert (stages["answers"].status, stages["answers"].score) == ("missing", 0.0)
    assert stages["written"].status == "missing"
    assert not result.provisional


@pytest.mark.parametrize("belief", ["reached_truth", "few_poses", "good_start", "loop_closed", "float_noise"])
def test_a_wrong_belief_is_named_with_something_to_think_about(graded, belief):
    """Only the conclusion's points are lost; the right letter is not given away."""
    stages, _ = graded(REFERENCE + answered(EXAMPLE.iterates, letter("worked-example", belief)))
    assert (stages["answers"].status, stages["answers"].score) == ("partial", 3.0)
    assert stages["answers"].slip == belief
    assert stages["answers"].hint.endswith("?") or stages["answers"].hint.endswith(".")
    assert f"choice {letter('worked-example')}".lower() not in stages["answers"].message.lower()


def own_iterates(step):
    """Take three steps from the start of the worked example."""
    x = [EXAMPLE.start]
    for _ in range(3):
        x.append(x[-1] + step(x[-1]))
    return np.array(x)


def test_iterates_follow_from_a_step_that_is_right_by_itself(graded):
    """A wrong Omega makes the step wrong, and the iterates; both are right by themselves."""
    text = REFERENCE.replace("1.0 / variances", "np.append(2.0, 1.0 / variances[1:])")
    assert text != REFERENCE
    omega = np.diag([2.0, 100.0, 100.0, 100.0, 100.0, 1000.0])

    def step(x):
        J, f = slam1d.jacobian(x, EXAMPLE.graph), slam1d.residual(x, EXAMPLE.graph)
        return np.linalg.solve(J.T @ omega @ J, -J.T @ omega @ f)

    stages, _ = graded(text + answered(own_iterates(step), letter("worked-example")))
    assert stages["answers"].score == 5.0
    assert "your own step" in stages["answers"].message


def test_iterates_of_a_step_that_earns_nothing_earn_nothing(graded):
    """Half a step has no points in any stage, so there are none for where it leads."""
    halves = own_iterates(lambda x: 0.5 * (EXAMPLE.iterates[1] - x))
    stages, _ = graded(REFERENCE + HALF + answered(halves, letter("worked-example")))
    assert (stages["gauss_newton_step"].score, stages["second_step"].score, stages["answers"].score) == (0, 0, 2)


TRIVIAL = {
    "zero": (
        "\n\ndef residual(x, graph):\n    return np.zeros(graph.n_factors)\n",
        np.tile(EXAMPLE.start, (4, 1)),
    ),
    "minus x": (
        "\n\ndef residual(x, graph):\n    return jacobian(x, graph) @ x\n",
        np.vstack([EXAMPLE.start, np.zeros((3, 5))]),
    ),
}


@pytest.mark.parametrize("name", TRIVIAL)
def test_iterates_that_follow_from_nothing_earn_nothing(graded, name):
    """A nonsense residual makes a right step zero, or minus x: such iterates show no work."""
    text, iterates = TRIVIAL[name]
    stages, _ = graded(REFERENCE + text + answered(iterates, letter("worked-example")))
    assert stages["gauss_newton_step"].score == 20
    assert stages["answers"].score == 2.0


FORGED = {
    "zero": ("np.zeros(graph.n_poses)", np.tile(EXAMPLE.start, (4, 1))),
    "the sum minus x": (
        "graph.measurements.sum() - x",
        np.vstack([EXAMPLE.start, np.full((3, 5), EXAMPLE.graph.measurements.sum())]),
    ),
}


@pytest.mark.parametrize("name", FORGED)
def test_a_forged_step_pays_for_no_iterates(graded, name):
    """Four equal iterates, or three that are the sum of the measurements, follow from a step that has no points."""
    step, iterates = FORGED[name]
    text = f"\n\ndef gauss_newton_step(x, graph):\n    return {step}\n"
    stages, _ = graded(REFERENCE + text + answered(iterates, letter("worked-example")))
    assert (stages["gauss_newton_step"].score, stages["second_step"].score, stages["answers"].score) == (0, 0, 2)


def test_wrong_iterates_of_a_right_step_earn_nothing(graded):
    """Where the step is right there is nothing to follow."""
    stages, _ = graded(REFERENCE + answered(EXAMPLE.iterates + 0.1, letter("worked-example")))
    assert stages["answers"].score == 2.0


@pytest.mark.parametrize("value", ["'A'", "[1, 2]", "np.full((4, 5), np.nan)", "{}", "lambda: 0", "np.zeros((4, 6))"])
def test_odd_iterates_are_refused_with_a_sentence(graded, value):
    """Whatever iterates is, the stage says what came."""
    stages, _ = graded(REFERENCE + f"\niterates = {value}\nconclusion = 'Z'\n")
    assert stages["answers"].score == 0.0
    assert stages["answers"].message


def test_the_variant_on_record_decides(graded):
    """The answers of the worked example are wrong for a student with numbers of their own, and right ones are right."""
    secret = Secret(b"a secret of this test, long enough")
    mine, theirs = (draw_variant(secret, "autumn", student, family("A")) for student in ("s1", "s2"))
    assigned = Assigned(mine, "s1", Numbers([mine, theirs]))
    right, result = graded(REFERENCE + answered(mine.iterates, letter(mine.identifier)), assigned)
    assert right["answers"].status == "passed"
    assert (result.student_id, result.variant, result.flags) == ("s1", mine.identifier, ())
    wrong, result = graded(REFERENCE + answered(theirs.iterates, letter(theirs.identifier)), assigned)
    assert wrong["answers"].score < 5
    assert any("s2" in flag for flag in result.flags)


def test_written_answers_await_a_reader(graded):
    """Strings and markdown cells count alike; the score is provisional until somebody has read them."""
    stages, result = graded(REFERENCE + "\nwritten_2 = 'zero'\nwritten_3 = 'linear'\n")
    assert stages["written"].status == "awaiting_mark"
    assert (result.provisional, result.awaiting) == (True, 5.0)
    assert result.written == {"2": "zero", "3": "linear"}


def test_each_answer_that_cannot_be_used_is_named_for_itself(graded):
    """What came stands with its own name; nothing that was written is called None, or no answer."""
    stages, _ = graded(REFERENCE + "\nconclusion = 3\niterates = {}\nwritten_3 = [1]\n")
    assert "iterates: got a dict, expected an array of shape (4, 5)." in stages["answers"].message
    assert "conclusion: got an int, expected a string." in stages["answers"].message
    assert stages["written"].message == "question 2: no answer. written_3: got a list of 1, expected a string."
    assert "None" not in stages["answers"].message


def test_the_notebook_as_it_is_handed_out_holds_no_written_answer() -> None:
    """Nothing that we print below a question is taken for what a student wrote."""
    handed_out = json.loads((Path(__file__).parents[2] / "assignment/slam1d.ipynb").read_text("utf-8"))
    cells = ["".join(each["source"]) for each in handed_out["cells"] if each["cell_type"] == "markdown"]
    assert written_answers(cells) == {}
    answered = [f"{cell} Zero." if cell.startswith("**Your answer to question 2**") else cell for cell in cells]
    assert written_answers(answered) == {"2": "Zero."}

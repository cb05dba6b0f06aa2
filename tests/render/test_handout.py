"""The handout tells numbers that code worked out, for any problem, and keeps notation apart."""

import json
import re

import pytest

from autograder.commands._class import grading_of
from autograder.course import Course
from autograder.problems.families import family
from autograder.problems.problem import worked_problem
from autograder.problems.secret import Secret
from autograder.problems.variants import draw_variant
from autograder.render import values as values_module
from autograder.render.facts import solve
from autograder.render.grading import Grading
from autograder.render.handout import provided, render_assignment, render_folder
from autograder.render.solution import render_solution
from autograder.render.stub import reference_source, stubs
from autograder.stages.slips.residual import SLIPS as RESIDUAL_SLIPS
from tests.render.another import another_problem
from tests.render.prose import NAMES, STUDENTS, TEMPLATES, prose

GRADED = render_assignment(worked_problem())["README.md"].partition("## What is graded")[2].partition("\n## ")[0]


def answers(problem):
    """Patterns of the iterates after the start, dx, b and a row of H, in any usual way of writing."""
    solution = solve(problem)
    for rows in (solution.x1, solution.dx, solution.b, solution.H[0]):
        numbers = [re.escape(f"{round(float(value), 4) + 0.0:g}") for value in rows]
        yield re.compile(r"(?<![\d.])" + r"\.?0*[,;\s&\\]+".join(numbers) + r"\.?0*(?![\d.])")


def test_the_points_are_those_of_the_course():
    """Points in the handout agree with the defaults of the course file, for every stage that it has."""
    told = grading_of(Course()).words()
    assert told == Grading().words()
    answers = {"iterates": "3", "conclusion": "2", "written_2": "2", "written_3": "3"}
    assert told["answer_points"] == answers
    functions = {**told["points"], **told["bonus_points"], "answers": "5", "written": "5"}
    assert {name: float(points) for name, points in functions.items()} == dict(Course().points)
    rows = re.findall(r"^\| (.*?) \| (\S+) \| (.*?) \|$", GRADED, re.MULTILINE)
    earned = [int(row[1]) for row in rows if row[1].isdigit()]
    assert sum(earned) == 100
    assert "| **together** | **100** | |" in GRADED
    assert {row[2] for row in rows if row[0].startswith("your words")} == {"a reader"}


def test_what_is_kept_after_an_earlier_mistake_is_the_courses_share():
    """The handout says what a step keeps that is right by itself, where what it calls is wrong."""
    share = Course().follow_through
    kept = "all" if share == 1 else f"{100 * share:g} %"
    assert f"it keeps {kept} of its points" in GRADED


@pytest.mark.parametrize(
    ("variance", "other", "told"),
    [(0.001, 0.01, "3.2 times smaller than"), (0.04, 0.01, "2 times larger than"), (0.01, 0.01, "the same as")],
)
def test_two_standard_deviations_are_compared_in_words(variance, other, told):
    """Smaller, larger or the same: a prior need not be the surest of all."""
    assert values_module._compared(variance, other) == told


@pytest.mark.parametrize("problem", [worked_problem(), another_problem()], ids=["worked", "another"])
def test_the_row_by_hand_says_what_is_predicted(problem):
    """The sum of place and measurement, the state, and their difference agree."""
    text = render_assignment(problem)["slam1d.ipynb"]
    told = re.search(r"= ([-\d.]+)\$ m, and the state says ([-\d.]+) m: [^=]*= [^=]*= ([-\d.]+)\$ m", text)
    predicted, state, error = (float(number) for number in told.groups())
    assert predicted == pytest.approx(state + problem.graph.measurements[0])
    assert error == pytest.approx(predicted - state)


def test_the_glossary_explains_words_that_are_used():
    """In the order of the alphabet; each word occurs somewhere else in what students read."""
    handout, _, glossary = render_assignment(worked_problem())["README.md"].partition("## Glossary")
    words = re.findall(r"^\| ([A-Za-z -]+) \|", glossary, re.MULTILINE)[1:]
    assert len(words) > 12
    assert words == sorted(words, key=str.lower)
    read = " ".join([handout, *(prose(name) for name in STUDENTS if name != "README.md.j2")]).lower()
    assert [word for word in words if word.lower().removesuffix(" of the state") not in read] == []


def test_iterates_and_poses_never_share_notation():
    """A lower index is a pose, an upper index in brackets an iterate: no bold x with a lower index, no x^2."""
    for name in NAMES:
        text = (TEMPLATES / name).read_text(encoding="utf-8")
        assert re.findall(r"\\mathbf\{? ?x\}?_", text) == []
        assert re.findall(r"x\^\d|x\^\{\d|[^\w]x[01]\b(?! >>)", text) == []


@pytest.mark.parametrize("name", NAMES)
def test_every_formula_shows_on_github(name):
    r"""GitHub refuses \operatorname; the formulas make do without it, and without macros of their own."""
    text = (TEMPLATES / name).read_text(encoding="utf-8")
    assert re.findall(r"\\(?:operatorname|newcommand|def|require)\b", text) == []


def test_every_letter_has_one_meaning():
    """In the handout k and p are numbers of edges and priors: never a pose, a mean or a step."""
    for name in STUDENTS:
        text = prose(name)
        assert re.findall(r"[_^]\{?\(?[kp]\b|pose \$?k\b|mean \$?p\b|\(k, k\)", text) == [], name
    assert re.findall(r"_[kp]\b|pose k\b|mean p\b", "\n".join(stubs(reference_source()).values())) == []


@pytest.mark.parametrize("problem", [worked_problem(), another_problem()], ids=["worked", "another"])
def test_no_answer_is_handed_out(problem):
    """No file of a student's folder holds an answer to the problem, the provided ones included."""
    for name, text in render_folder(problem).items():
        assert not any(answer.search(text) for answer in answers(problem)), name


def test_the_search_for_answers_finds_them():
    """In the worked solution, which is for staff, every one of them is found."""
    text = render_solution(worked_problem())["SOLUTION.md"]
    assert all(answer.search(text) for answer in answers(worked_problem()))


def test_everything_follows_the_problem():
    """Another problem gives other numbers in every file that speaks of it, and none of the worked example's data."""
    files = render_assignment(another_problem())
    for name in ("README.md", "slam1d.ipynb", "slam1d.py", "pose_graph.svg"):
        assert "1.95" in files[name]
    assert "`s1001`" in files["README.md"]
    assert "-2.7" not in files["slam1d.py"]
    assert "edge 1 to 4 measured 1.5 m" in files["pose_graph.svg"]


def test_every_picture_of_the_handout_exists_and_has_words():
    """Each picture is rendered with the handout, and its alternative text says what it shows."""
    files = render_assignment(worked_problem())
    pictures = re.findall(r"!\[([^\]]*)\]\(([^)]*)\)", files["README.md"])
    assert {target for _words, target in pictures} == {name for name in files if name.endswith(".svg")}
    assert all(len(words) > 30 for words, _target in pictures)


def test_the_whole_is_short_enough():
    """Reading the words of the notebook as rendered takes ten minutes: 2000 words at 200 a minute."""
    cells = json.loads(render_assignment(worked_problem())["slam1d.ipynb"])["cells"]
    words = "".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    read = [word for word in words.split() if re.search(r"\w", word)]  # the bars of a table are no words
    assert 1000 < len(read) < 2000


def test_no_private_name_of_the_reference_is_public():
    """The reference has no private function whose text a stub would have to hide."""
    assert not re.search(r"^def _", reference_source(), flags=re.MULTILINE)


def test_only_what_closes_a_loop_is_called_a_loop():
    """The first sight of a landmark is an edge; the second one closes a loop."""
    problem = draw_variant(Secret(b"0123456789abcdef"), "2026S", "s1", family("L")).problem
    handout = render_assignment(problem)["README.md"]
    kinds = re.findall(r"^\| \d+ \| (odometry|loop|edge) (\d+) → (\d+) ", handout, re.MULTILINE)
    assert [(int(i), int(j)) for _kind, i, j in kinds] == [tuple(edge) for edge in problem.graph.edges.tolist()]
    closing = [int(row) for row, (kind, _i, _j) in enumerate(kinds) if kind == "loop"]
    assert len(closing) == len(kinds) - problem.graph.n_poses + 1
    assert {"odometry", "edge", "loop"} == {kind for kind, _i, _j in kinds}


def test_the_contents_lead_to_every_section():
    """Each heading has its link at the top, in order, and the page to print has the name that the link goes to."""
    files = render_assignment(worked_problem())
    headings = re.findall(r"^## (.*)$", files["README.md"], re.MULTILINE)
    links = re.findall(r"\[([^\]]+)\]\(#([^)]+)\)", files["README.md"])
    assert [words for words, _name in links] == headings
    assert [name for _words, name in links] == re.findall(r'<h2 id="([^"]+)"', files["handout.html"])


def test_the_rule_of_the_signs_is_told_in_the_same_words():
    """Handout, glossary, docstring and hints say what is subtracted from what in one sentence, with the formula."""
    edge = "row of an edge is where the edge puts pose j, minus where the state puts it"
    prior = "row of a prior is where the state puts pose i, minus the mean"
    handout = render_assignment(worked_problem())["README.md"].replace("$", "")
    stub = " ".join(stubs(reference_source())["residual"].split())
    hints = " ".join(provided("self_check.py").split())
    for sentence in (edge, prior):
        assert handout.count(sentence) == 2
        assert sentence in stub
        assert sentence in hints
    for text in (handout, stub):
        assert f"{edge}: x_" in text
        assert f"{prior}: x_i - " in text
    everything = [handout, stub, hints, *(slip.hint for slip in RESIDUAL_SLIPS)]
    assert not [text for text in everything if re.search(r"(?i)predicted minus", text)]


def test_landmarks_are_called_and_drawn_as_such():
    """In family L the two landmarks are named in handout and notebook, and are boxes in both pictures."""
    problem = draw_variant(Secret(b"0123456789abcdef"), "2026S", "s1", family("L")).problem
    files = render_assignment(problem)
    assert problem.landmarks == (4, 5)
    assert "4 poses, 2 landmarks," in files["README.md"]
    assert "$x_{4}$ and $x_{5}$ are landmarks" in files["README.md"]
    assert "$x_{4}$ and $x_{5}$ are landmarks" in files["slam1d.ipynb"]
    assert "| $x_{5}$, landmark |" in files["README.md"]
    assert files["pose_graph.svg"].count('rx="3"') == 2
    assert "show(pose_graph(my_graph.n_poses, arrows, beliefs, (4, 5)))" in files["slam1d.ipynb"]
    assert "landmarks, drawn as boxes" not in render_assignment(worked_problem())["README.md"]


def test_the_word_is_found_and_not_told():
    """The notebook does not say what kind of function f is; question 3 asks for it, the model answer names it."""
    notebook = json.loads(render_assignment(worked_problem())["slam1d.ipynb"])
    words = "".join("".join(c["source"]) for c in notebook["cells"] if c["cell_type"] == "markdown")
    assert not re.search(r"(?i)linear|affine|constant J|same at every x", words)
    assert "which property of $\\mathbf f$ is it, and what is it called?" in words
    solution = render_solution(worked_problem())["SOLUTION.md"]
    assert "The property is called **linear**" in solution
    assert "names the property: $\\mathbf f$ is linear" in solution

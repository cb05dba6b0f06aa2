"""The notebooks run in a real kernel, alone in an empty folder: unfinished, finished, and with mistakes."""

import re
from copy import deepcopy
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

import nbformat
import numpy as np
import pytest
from nbformat.v4 import new_code_cell, new_notebook

from assignment.posegraph import PoseGraph
from autograder.problems.problem import worked_problem
from autograder.render.facts import solve
from autograder.render.handout import render_assignment
from autograder.render.stub import reference_source
from autograder.render.template import source
from autograder.stages.slips import information_matrix
from tests.assignment.running import reference_functions, run, sentences, text_of

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.slow

ITERATES = """
states = [my_start]
for _ in range(3):
    states.append(states[-1] + gauss_newton_step(states[-1], my_graph))
iterates = np.array(states)
"""


@pytest.fixture(scope="module")
def notebooks():
    """The notebooks as rendered for the worked example."""
    rendered = render_assignment(worked_problem())
    return {name: nbformat.reads(rendered[name], as_version=4) for name in ("slam1d.ipynb", "explore.ipynb")}


@pytest.fixture(scope="module")
def finished(notebooks, tmp_path_factory):
    """The core notebook with the reference pasted in, executed from top to bottom; then explore beside it."""
    folder = tmp_path_factory.mktemp("finished")
    core = notebooks["slam1d.ipynb"]
    next(cell for cell in core.cells if cell.id == "iterates").source = ITERATES
    next(cell for cell in core.cells if cell.id == "conclusion").source = 'conclusion = "A"'
    ran, stopped = run(core, reference_functions(), folder)
    nbformat.write(ran, folder / "slam1d.ipynb")
    explored, explore_stopped = run(notebooks["explore.ipynb"], reference_functions(), folder)
    return ran, stopped, explored, explore_stopped


def test_the_unfinished_notebook_stops_with_a_sentence(notebooks, tmp_path):
    """Run all reaches the first check, which says what to do; there is no traceback."""
    ran, stopped = run(notebooks["slam1d.ipynb"], {}, tmp_path)
    assert stopped == "check-residual"
    (error,) = next(cell for cell in ran.cells if cell.id == stopped).outputs
    assert error.traceback == ["residual is not finished yet: write it, run its cell, then run this one again."]


def test_the_finished_notebook_runs_to_its_end(finished):
    """With the reference pasted in, every check passes and nothing stops."""
    ran, stopped, _explored, _stopped = finished
    assert stopped is None
    lines = [line for cell in ran.cells if cell.id.startswith("check") for line in sentences(text_of(ran, cell.id))]
    assert len(lines) > 20
    assert [line for line in lines if not line.startswith("PASS")] == [lines[-1]]
    assert lines[-1].startswith("What this check cannot see")


def test_a_loop_without_end_is_told_in_the_notebook(notebooks, tmp_path):
    """While a check runs for long, the cell says so."""
    core = notebooks["slam1d.ipynb"]
    cells = [cell for cell in core.cells if cell.id in ("provided-files", "imports")]
    slow = "import sys, time\nsys.modules['self_check'].PATIENCE = 0.1\ndef residual(x, graph):\n    time.sleep(1)"
    cells.append(new_code_cell(f"{slow}\n\n\ncheck('residual', globals())", id="slow"))
    ran, stopped = run(new_notebook(cells=cells), {}, tmp_path)
    assert stopped is None
    assert text_of(ran, "slow").startswith("...   residual still runs")


def test_the_graph_is_told_in_words(finished):
    """Before the first stub, each factor is a line: which poses, what was measured, how surely."""
    lines = text_of(finished[0], "walk").splitlines()[:6]
    assert lines[4] == "row 4: loop 0 -> 4, measured 0.00 m, variance 0.01 m^2"
    assert lines[5] == "row 5: prior on pose 0, mean 0.00 m, variance 0.001 m^2"
    assert [line.split()[2] for line in lines[:4]] == ["odometry"] * 4


def test_the_prediction_can_be_tried(finished):
    """Equal variances meet half way; a loop that is 100 times surer takes all but one part in 101."""
    lines = text_of(finished[0], "try-prediction").splitlines()
    assert lines[0] == "pose 4: odometry puts it at 0.500 m, the loop at 0.000 m"
    found = [float(line.split()[-2]) for line in lines[1:]]
    assert found == pytest.approx([0.5 / 2, 0.5 / 101], abs=0.0025)  # half the grid that the cell looks at


def test_the_start_does_not_matter(finished):
    """From dead reckoning and from elsewhere the step goes to the same state."""
    one, other = (line.partition("[")[2] for line in text_of(finished[0], "other-start").splitlines())
    assert one == other


def test_the_notebook_shows_what_was_gained(finished):
    """The table after the step ends with the RMSE that the facts know."""
    solution = solve(worked_problem())
    shown = text_of(finished[0], "compare")
    assert f"RMSE: {solution.rmse:.3f} m -> {solution.rmse1:.3f} m" in shown


def test_the_size_of_each_step_is_printed(finished):
    """Four digits of an array hide what a later step is; beside question 2 it stands with its power of ten."""
    *lines, drawn = text_of(finished[0], "step-sizes").splitlines()
    assert drawn.startswith("Size of the steps. ")
    assert [line.partition(":")[0] for line in lines] == ["step 1", "step 2", "step 3"]
    first, *later = (float(line.split()[-2]) for line in lines)
    assert first == pytest.approx(np.abs(solve(worked_problem()).dx).max(), rel=0.05)
    assert max(later) < 1e-12
    assert all(re.search(r" \d\.\de[-+]\d\d m$", line) for line in lines)


def test_the_bonus_functions_can_be_copied_in(notebooks, tmp_path):
    """Their cells, put at the end of the core notebook as the handout says, run there."""
    core, explore = notebooks["slam1d.ipynb"], notebooks["explore.ipynb"]
    bonus = [cell.id for cell in explore.cells if cell.id.startswith("stub-")]
    assert bonus == ["stub-sparsity-pattern", "stub-range-residual", "stub-range-jacobian"]
    cells = [cell for cell in core.cells if cell.id in ("provided-files", "imports")]
    cells += [cell for cell in explore.cells if cell.id in bonus]
    _ran, stopped = run(new_notebook(cells=cells), {}, tmp_path)
    assert stopped is None


SPOILT = {
    "None": "def {name}(*given):\n    pass",
    "shape": "def {name}(*given):\n    return np.zeros((2, 3))",
    "text": "def {name}(*given):\n    return 'f'",
}


@pytest.mark.parametrize("kind", SPOILT)
def test_a_wrong_function_leaves_a_sentence_where_its_picture_would_be(notebooks, tmp_path, kind):
    """After None, a wrong shape or text the cells with the pictures of J and H go on, and say what came."""
    core = notebooks["slam1d.ipynb"]
    wanted = ("provided-files", "provided-pictures", "imports", "my-problem", "spy-j", "spy-h")
    functions = reference_functions()
    right = [functions[name] for name in ("residual", "information_matrix")]
    for name in ("jacobian", "normal_equations"):
        other = "normal_equations" if name == "jacobian" else "jacobian"
        sources = [*right, functions[other], SPOILT[kind].format(name=name)]
        cells = [deepcopy(cell) for cell in core.cells if cell.id in wanted]
        cells.insert(4, new_code_cell("\n\n\n".join(sources), id="functions"))
        ran, stopped = run(new_notebook(cells=cells), {}, tmp_path)
        assert stopped is None
        shown = text_of(ran, "spy-j" if name == "jacobian" else "spy-h")
        came = {"None": "None", "shape": "shape (2, 3)", "text": "no matrix of numbers"}[kind]
        if name == "jacobian":
            assert shown == f"No picture of J yet: got {came}, expected shape (6, 5). The check above says more.\n"
        else:
            assert "No picture of H yet: got " in shown


@pytest.mark.parametrize(
    ("function", "came"),
    [
        ("def sparsity_pattern(graph):\n    pass", "None"),
        ("def sparsity_pattern(graph):\n    return np.zeros((2, 3)), np.zeros((2, 3))", "shape (2, 3)"),
    ],
    ids=["None", "shape"],
)
def test_wrong_masks_leave_sentences_too(notebooks, tmp_path, function, came):
    """In the optional notebook the pictures of J and H are missed in the same words, and the cells go on."""
    wanted = ("provided-files", "provided-pictures", "count", "corridor-code")
    cells = [deepcopy(cell) for cell in notebooks["explore.ipynb"].cells if cell.id in wanted]
    load = f"import numpy as np\nfrom posegraph import PoseGraph\nfrom self_check import WORKED\n\n{function}"
    cells.insert(2, new_code_cell(load, id="load"))
    ran, stopped = run(new_notebook(cells=cells), {}, tmp_path)
    assert stopped is None
    for name, shapes in (("count", ("(6, 5)", "(5, 5)")), ("corridor-code", ("(498, 120)", "(120, 120)"))):
        for letter, shape in zip("JH", shapes, strict=True):
            assert f"No picture of {letter} yet: got {came}, expected shape {shape}." in text_of(ran, name)


def test_the_start_cannot_be_moved_by_accident(finished):
    """`my_start += dx` raises instead of spoiling x^(0), in the notebook and in the module."""
    cell = next(cell.source for cell in finished[0].cells if cell.id == "my-problem")
    module = render_assignment(worked_problem())["slam1d.py"].replace("from posegraph", "from assignment.posegraph")
    for text in (cell, module):
        space = {"np": np, "PoseGraph": PoseGraph}
        exec(compile(text, "slam1d", "exec"), space)
        with pytest.raises(ValueError, match="read-only|output array"):
            space["my_start"] += 1.0


def test_the_pictures_are_drawn(finished):
    """Pose graph, patterns of J and H, residuals and chi-squared are images with their words beside them."""
    pictures = {
        cell.id: [output.data for output in cell.outputs if "text/html" in output.get("data", {})]
        for cell in finished[0].cells
        if cell.cell_type == "code"
    }
    assert {name: len(drawn) for name, drawn in pictures.items() if drawn} == {
        "walk": 1,
        "spy-j": 1,
        "spy-h": 1,
        "corridor": 3,
        "compare": 1,
        "pictures": 2,
        "step-sizes": 1,
        "along-a-line-code": 1,
    }
    for data in (data for drawn in pictures.values() for data in drawn):
        image = ElementTree.fromstring(data["text/html"].replace('">', '"/>'))
        kind, _, picture = unquote(image.get("src")).partition(",")
        assert kind == "data:image/svg+xml;charset=utf-8"
        assert ElementTree.fromstring(picture).tag == "{http://www.w3.org/2000/svg}svg"
        assert image.get("alt") == data["text/plain"]
        assert len(data["text/plain"]) > 30


def test_explore_runs_beside_the_finished_notebook(finished):
    """The optional notebook loads the functions from the first one, and shows the numbers of the handout."""
    _ran, _stopped, explored, stopped = finished
    assert stopped is None
    assert text_of(explored, "provided-load") == "using your functions from slam1d.ipynb\n"
    sizes = re.findall(r"without, (\S+) with", text_of(explored, "twin-code"))
    assert sizes == ["4.1e-01", "7.0e-03", "6.5e-05", "6.7e-07"]
    assert text_of(explored, "gauge-code").startswith("rank 4 of 5")
    assert "1527 new pairs" in text_of(explored, "fill-in-code")
    assert "[0.032 0.095 0.114 0.114 0.095]" in text_of(explored, "marginals-code")


@pytest.mark.parametrize("number", range(1, 7))
def test_explore_runs_from_any_section(notebooks, tmp_path, number):
    """After the provided cells each section runs by itself, whatever was run before it."""
    provided, *sections = re.split(r"(?m)^## \d+\. ", source("explore.ipynb.j2"))
    names = set(re.findall(r"(?m)^%% (?:code|provided) (\S+)", provided))
    own = names | set(re.findall(r"(?m)^%% code (\S+)", sections[number - 1]))
    cells = [
        deepcopy(c) for c in notebooks["explore.ipynb"].cells if c.id in own | {"provided-files", "provided-pictures"}
    ]
    (tmp_path / "slam1d.py").write_text(reference_source(), encoding="utf-8")
    _ran, stopped = run(new_notebook(cells=cells), reference_functions(), tmp_path)
    assert stopped is None


def test_explore_alone_stops_with_a_sentence(notebooks, tmp_path):
    """Without finished functions beside it, the optional notebook says what it needs."""
    ran, stopped = run(notebooks["explore.ipynb"], {}, tmp_path)
    assert stopped == "provided-load"
    (error,) = next(cell for cell in ran.cells if cell.id == stopped).outputs
    assert error.traceback[0].startswith("Finish the five functions")
    assert "in Colab" in error.traceback[0]


@pytest.mark.parametrize("name", ["slam1d (1).ipynb", "slam1d-mine.ipynb"])
def test_explore_finds_a_file_that_was_renamed(finished, notebooks, tmp_path, name):
    """A second download has a number in its name; an unfinished file beside it is passed over."""
    nbformat.write(notebooks["slam1d.ipynb"], tmp_path / "slam1d.ipynb")
    nbformat.write(finished[0], tmp_path / name)
    cells = [cell for cell in notebooks["explore.ipynb"].cells if cell.id in ("provided-files", "provided-load")]
    ran, stopped = run(new_notebook(cells=cells), {}, tmp_path)
    assert stopped is None
    assert text_of(ran, "provided-load") == f"using your functions from {name}\n"


def test_the_conditioning_is_best_in_between(finished):
    """Of the weights that are tried, neither the lightest nor the heaviest prior conditions H best."""
    lines = text_of(finished[2], "prior-weight-code").splitlines()
    numbers = [float(line.partition("cond(H) = ")[2].partition(",")[0]) for line in lines]
    assert min(numbers) not in (numbers[0], numbers[-1])
    assert len({line.partition("step")[2] for line in lines}) == 1


def test_two_poses_share_the_largest_uncertainty(finished):
    """Before the loop one pose is least certain, after it two are."""
    before, after = (
        [float(number) for number in line.partition("[m] [")[2].strip("]").split()]
        for line in text_of(finished[2], "marginals-code").splitlines()
    )
    assert (before.count(max(before)), after.count(max(after))) == (1, 2)


def test_every_slip_of_a_stage_fails_in_the_notebook(notebooks, tmp_path):
    """Each catalogued mistake of the information matrix, put in its place, makes the check below say FAIL."""
    core = notebooks["slam1d.ipynb"]
    cells = [cell for cell in core.cells if cell.id in ("provided-files", "imports", "my-problem")]
    load = f"import sys\nsys.path.append({str(ROOT)!r})\nfrom {information_matrix.__name__} import SLIPS"
    cells.append(new_code_cell(load, id="load"))
    for index in range(len(information_matrix.SLIPS)):
        put = f"information_matrix = SLIPS[{index}].function"
        cells.append(new_code_cell(f'{put}\ncheck("information_matrix", globals())', id=f"slip-{index}"))
    ran, stopped = run(new_notebook(cells=cells), {}, tmp_path)
    assert stopped is None
    verdicts = {slip.identifier: text_of(ran, f"slip-{k}") for k, slip in enumerate(information_matrix.SLIPS)}
    assert [name for name, text in verdicts.items() if "FAIL" not in text] == []

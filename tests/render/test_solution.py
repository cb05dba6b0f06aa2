"""The worked solution is current, executed, and right."""

import json
import re
from pathlib import Path

import nbformat
import numpy as np
import pytest

from autograder.problems.conclusion import RIGHT, choice_of
from autograder.problems.exact import decimal
from autograder.problems.families import family
from autograder.problems.problem import worked_problem
from autograder.problems.secret import Secret
from autograder.problems.variants import draw_variant
from autograder.render.facts import range_experiment, solve
from autograder.render.solution import _joined, execute, render_solution
from tests import witness
from tests.render.another import another_problem

FOLDER = Path(__file__).parents[2] / "reference_solution"


@pytest.fixture(scope="module")
def rendered():
    """The solution of the worked example, not executed."""
    return render_solution(worked_problem())


def test_printed_pieces_are_joined():
    """The same notebook comes out, in however many pieces the kernel sent what was printed."""
    pieces = [nbformat.v4.new_output("stream", name="stdout", text=text) for text in ("a", "\n", "b\n")]
    assert [output.text for output in _joined(pieces)] == ["a\nb\n"]


def test_the_page_is_current(rendered):
    """The committed page is what rendering gives."""
    assert (FOLDER / "SOLUTION.md").read_text(encoding="utf-8") == rendered["SOLUTION.md"]


@pytest.mark.slow
def test_the_notebook_is_current_and_executed(rendered):
    """Running the rendered notebook gives the committed bytes, outputs included, and no error."""
    text = execute(rendered["slam1d.ipynb"])
    assert (FOLDER / "slam1d.ipynb").read_text(encoding="utf-8") == text
    outputs = [output for cell in json.loads(text)["cells"] for output in cell.get("outputs", [])]
    assert {output["output_type"] for output in outputs} == {"stream"}


@pytest.mark.parametrize("problem", [worked_problem(), another_problem()], ids=["worked", "another"])
def test_the_facts_agree_with_exact_arithmetic(problem):
    """f, H, b and dx of the handout are those of rational numbers, which share no code with the reference."""
    f, J, weights = witness.exact_problem(problem.start, problem.graph)
    H, b = witness.exact_normal_equations(f, J, weights)
    dx = witness.exact_solve(H, [-value for value in b])
    facts = solve(problem)
    for exact, told in ((f, facts.f), (b, facts.b), (dx, facts.dx), (sum(H, []), facts.H.ravel())):
        assert told == pytest.approx([float(value) for value in exact], abs=1e-9)


def test_the_range_experiment_is_that_of_the_issue():
    """The steps of the twin shrink to 4.1e-1, 7.0e-3, 6.5e-5, 6.7e-7; on the line the second is zero."""
    line, ranged = range_experiment()
    assert [f"{size:.1e}" for size in ranged] == ["4.1e-01", "7.0e-03", "6.5e-05", "6.7e-07"]
    assert max(line[1:]) < 1e-12


def test_the_page_tells_the_printed_erratum(rendered):
    """H[3, 3] is 200, not the printed 300, which would leave 30 in row 3; all 18 errata are listed."""
    assert re.search(r"\| 1 \| .*300.* \| 200 \| .* by 30 \|", rendered["SOLUTION.md"])
    assert re.findall(r"^\| (\d+) \| .*\|$", rendered["SOLUTION.md"].partition("## Errata")[2], re.MULTILINE) == [
        str(row) for row in range(1, 19)
    ]


@pytest.mark.parametrize("problem", [worked_problem(), another_problem()], ids=["worked", "another"])
def test_the_letter_is_that_of_the_variant(problem):
    """The solution sets `conclusion` to the letter that the right choice has in this variant."""
    source = render_solution(problem)["slam1d.ipynb"]
    letter = re.search(r'conclusion = \\"([A-F])\\"', source).group(1)
    assert choice_of(problem.variant, letter).identifier == RIGHT


def two_loops():
    """Draw a variant with two loops that share an edge."""
    return draw_variant(Secret(b"0123456789abcdef"), "2026S", "s1", family("C")).problem


def test_two_loops_are_solved_together():
    """The page shows R q = e with the shared variance off the diagonal; q solves it."""
    page = render_solution(two_loops())["SOLUTION.md"]
    system = re.search(r"R = (.*?) \\text\{ m\}\^2.*\\mathbf q = (.*?)\^\\top", page)
    R, q = (
        [
            [float(entry) for entry in row.split("&")]
            for row in re.sub(r"\\(begin|end)\{pmatrix\}", "", text).split(r"\cr")
        ]
        for text in system.groups()
    )
    (e,) = [
        [float(x) for x in row.split("&")] for row in re.findall(r"mathbf e = \\begin\{pmatrix\} (.*?) \\end", page)
    ]
    assert np.array(R) @ np.array(q[0]) == pytest.approx(e)
    assert R[0][1] == R[1][0] != 0
    assert "only the edges that close a loop disagree" in page


@pytest.mark.parametrize("letter", ["W", "A", "B", "C", "D", "L"])
def test_every_family_has_a_worked_solution(letter):
    """No family is left out: the page shows the new state of the variant, the notebook its answers."""
    variant = draw_variant(Secret(b"0123456789abcdef"), "2026S", "s1", family(letter))
    rendered = render_solution(variant.problem)
    assert " & ".join(map(decimal, variant.x1)) in rendered["SOLUTION.md"]
    assert repr(variant.start.tolist()) in "".join(json.loads(json.dumps(rendered["slam1d.ipynb"])))


def test_loops_before_the_walk_are_refused():
    """Edges in another order than dead reckoning's are an error, not a wrong page."""
    problem = another_problem()
    graph = problem.graph
    fields = {name: getattr(graph, name) for name in graph.__dataclass_fields__}
    for name in ("edges", "measurements", "edge_variances"):
        fields[name] = fields[name][::-1]
    with pytest.raises(ValueError, match="must lead from pose 0"):
        render_solution(type(problem)("turned", type(graph)(**fields), problem.start, problem.truth))


def test_the_provided_file_is_found_where_python_looks_nowhere_else(monkeypatch):
    """Python is started without the current folder everywhere; a notebook finds posegraph all the same."""
    monkeypatch.setenv("PYTHONSAFEPATH", "1")
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("import posegraph\nprint('found')")])
    ran = nbformat.reads(execute(nbformat.writes(notebook)), as_version=4)
    assert ran.cells[0].outputs[0].text == "found\n"

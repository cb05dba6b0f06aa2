"""What the self-check prints: the grader's words, guesses that lead to the mistake, lines that fit a page."""

import inspect
import re
import time

import numpy as np
import pytest

from autograder.stages import answers, jacobian, residual, sparsity_pattern, wording
from reference_solution import slam1d
from tests.assignment.mistakes import by_identifier, right_work
from tests.assignment.running import sentences

WIDTH = 100  # characters that a page shows of a line before it breaks it in the middle of a word


def test_the_words_are_the_graders(self_check):
    """Rows, numbers and vectors are named in the self-check as the grader names them."""
    for graph in (self_check.WORKED, self_check.PUBLIC["two priors"][1]):
        for row in range(graph.n_factors):
            assert self_check.factor(graph, row) == wording.factor(graph, row)
    for value in (0.0, -0.0, 1200.0, 0.1 + 0.2, -2.5, 1e9, 3.55271e-17, -2e-16, 1e-12):
        assert self_check.number(value) == wording.number(value)
    for values in ([1.0, -0.0, 2.5], [1.94289e-18, 0.1, -0.1], [2e-17, 1e-17], [1e-17, 3.25], range(12)):
        assert self_check.vector(np.array(values, float)) == wording.vector(np.array(values, float))


@pytest.mark.parametrize("stage", [residual.STAGE, jacobian.STAGE], ids=["residual", "jacobian"])
def test_a_wrong_row_is_told_in_the_graders_sentence(self_check, stage):
    """Got, expected and unit stand in the self-check as the grader writes them."""
    graph, x = self_check.WORKED, self_check.WORKED.dead_reckoning()
    wrong = stage.expected(x, graph)[0] + 2.0 * (np.arange(6) == 4).reshape([-1] + [1] * (stage.name == "jacobian"))
    with pytest.raises(self_check.Wrong) as told:
        self_check._same_rows(graph, "f" if stage.name == "residual" else "J", wrong, stage.expected(x, graph)[0])
    assert str(told.value) == stage.explain((x, graph), (wrong,))


def test_a_wrong_mask_is_told_in_the_graders_words(self_check):
    """An entry too many and one too few."""
    for state in (False, True):
        work = {**right_work(), "sparsity_pattern": lambda graph, fill=state: one_entry_turned(graph, fill)}
        ((_, wrong),) = self_check.failures("sparsity_pattern", work)
        told = sparsity_pattern.STAGE.explain((None, self_check.WORKED), one_entry_turned(self_check.WORKED, state))
        assert wrong.rpartition(": this entry")[2] == told.rpartition(": this entry")[2]


def one_entry_turned(graph, fill):
    """The masks of the reference with the first entry that is not `fill` set to it."""
    J_mask, H_mask = slam1d.sparsity_pattern(graph)
    J_mask.flat[np.argmax(J_mask.ravel() != fill)] = fill
    return J_mask, H_mask


def test_values_that_print_alike_get_more_digits(self_check):
    """What came and what was expected never read the same."""

    def heavier(*given):
        H, b = slam1d.normal_equations(*given)
        return H + 1e-3 * np.eye(len(b)), b

    def single(x, graph):
        return slam1d.residual(x, graph).astype(np.float32)

    for name, function in (("normal_equations", heavier), ("residual", single)):
        pairs = [
            re.search(r"got (.+?), expected (.+?)[.,]? ", wrong + " ")
            for _, wrong in self_check.failures(name, {**right_work(), name: function})
            if wrong
        ]
        assert pairs
        assert all(pair[1] != pair[2] for pair in pairs)


def test_what_differs_in_the_middle_of_a_long_row_is_shown(self_check):
    """A row of twelve is cut where its ends tell the difference, and printed whole where they do not."""
    middle = 1.0 * (np.arange(12) == 6)
    assert self_check.unlike(middle, -middle) == "got [0 0 0 0 0 0 1 0 0 0 0 0], expected [0 0 0 0 0 0 -1 0 0 0 0 0]"
    assert self_check.unlike(middle, middle[::-1] + 1) == "got [0 0 0 0 ... 0 0], expected [1 1 1 1 ... 1 1]"


@pytest.mark.parametrize(
    ("name", "guess"),
    [("b_has_opposite_sign", "(the sign?)"), ("h_doubled", "(a factor 2?)"), ("b_doubled", "(a factor 2?)")],
)
def test_a_sign_and_a_factor_are_guessed(self_check, name, guess):
    """Where all of H or b is turned or doubled, the message asks for it, and names the system, not a graph."""
    found = self_check.failures("normal_equations", {**right_work(), "normal_equations": by_identifier(name)})
    assert all(guess in wrong for _, wrong in found)
    assert found[0][1].startswith("with J = [[1, 2], [0, 1], [3, -1]], omega = np.diag([3, 7, 11]), f = [1, -2, 5]: ")
    assert "half the " in found[0][1]


def test_a_public_graph_can_be_looked_at(self_check, capsys):
    """A failure on a public graph says how to print it, and that line works."""
    work = {**right_work(), "jacobian": by_identifier("backward_edge_read_forward")}
    self_check.check("jacobian", work)
    (line,) = [line for line in capsys.readouterr().out.splitlines() if "Its factors: " in line]
    code = line.partition("Its factors: ")[2]
    exec(code.replace("import self_check", "from assignment import self_check"), {})
    assert "row 1: edge 2 -> 1, measured -1.2 m" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["residual", "jacobian", "normal_equations", "gauss_newton_step"])
def test_lines_fit_a_page(self_check, capsys, name):
    """Long messages are broken between words, and what follows is indented."""

    def fails(*_):
        raise ValueError("a long story of what went wrong, " * 9)

    for function in (fails, lambda *given: getattr(slam1d, name)(*given[::-1]), lambda *_: None):
        self_check.check_all({**right_work(), name: function})
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= WIDTH
    assert {line[:6] for line in lines} <= {"PASS  ", "FAIL  ", "TODO  ", "NOTE  ", "      ", "What t"}


def test_a_loop_without_end_says_so(self_check, capsys, monkeypatch):
    """A check that runs long names its stage while it runs; one that is quick does not."""
    right = right_work()
    self_check.check("information_matrix", right)
    assert "still runs" not in capsys.readouterr().out
    monkeypatch.setattr(self_check, "PATIENCE", 0.05)
    calls = []

    def slow(x, graph):
        if not calls:
            time.sleep(0.5)
        calls.append(x)
        return slam1d.residual(x, graph)

    self_check.check("residual", {**right, "residual": slow})
    assert capsys.readouterr().out.startswith("...   residual still runs: does every loop end?")


def test_a_failing_check_says_what_comes_first(self_check, capsys):
    """Under a cell, a FAIL ends with the advice to mend it before going on; a PASS does not."""
    advice = "Mend this before you go on: the cells below build on it."
    self_check.check("residual", {**right_work(), "residual": lambda x, graph: -slam1d.residual(x, graph)})
    assert capsys.readouterr().out.endswith(f"\n      {advice}\n")
    self_check.check("residual", right_work())
    assert advice not in capsys.readouterr().out


def test_an_open_conclusion_is_named_and_never_judged(self_check, capsys):
    """None is open work; any letter, right or wrong, is passed over in silence."""
    for letter in "ABCDEF":
        self_check.check_all({"conclusion": letter})
    assert "conclusion" not in capsys.readouterr().out
    self_check.check_all({"conclusion": None})
    assert "TODO  conclusion: it is still None." in capsys.readouterr().out


@pytest.mark.parametrize("given", [["B"], 2, "G", ""], ids=str)
def test_a_conclusion_of_the_wrong_form_is_named(self_check, capsys, given):
    """What can be no choice fails here as it does in the grader."""
    self_check.check_all({"conclusion": given})
    assert f'FAIL  conclusion: got {given!r}, expected one letter, for example "A".' in capsys.readouterr().out
    sheet = answers.Sheet("worked-example", self_check.WORKED, np.zeros((4, 5)))
    finding = answers.conclusion_finding(sheet, given if isinstance(given, str) else None, f"got {given!r}")
    assert (finding.given, finding.right) == (True, False)


def test_hints_grow_and_none_is_the_line(self_check, capsys):
    """Three a stage, each longer than a word and all different; no hint has code of the reference in it."""
    assert set(self_check.HINTS) == set(self_check.STAGES)
    source = inspect.getsource(slam1d)
    lines = {re.sub(r"\s|return|\w+ =(?!=)", "", line) for line in source.splitlines()}
    lines = {line for line in lines if len(line) > 8 and not line.startswith(("def", "#", '"""'))}
    for stage, text in self_check.HINTS.items():
        hints = [" ".join(part.split()) for part in text.split("\n    * ")[1:]]
        assert len(set(hints)) == 3
        assert [line for line in lines if line in re.sub(r"\s", "", " ".join(hints))] == []
        shown = []
        for number in (1, 2, 3, 1):
            self_check.hint(stage)
            shown.append(" ".join(capsys.readouterr().out.split()))
            assert shown[-1] == f"Hint {number} of 3 for {stage}: {hints[number - 1]}"
    self_check.hint("residual", 3)
    assert "Hint 3 of 3" in capsys.readouterr().out
    self_check.hint("nothing")
    assert "There are hints for residual" in capsys.readouterr().out


def test_a_bonus_that_was_not_begun_is_no_failure(self_check, capsys):
    """Whatever is wrong with the core, the bonus is not spoken of before it was begun."""

    def sparsity_pattern(graph):
        raise NotImplementedError

    broken = {"jacobian": lambda *_: None, "normal_equations": lambda *_: None, "sparsity_pattern": sparsity_pattern}
    self_check.check_all({**right_work(), **broken})
    assert "sparsity_pattern" not in capsys.readouterr().out


def test_iterates_that_are_one_array_get_advice_that_helps(self_check):
    """A state that was moved in place stands in all rows: the message says why, and what does not do it."""
    graph = self_check.WORKED
    x = graph.dead_reckoning()
    moved = x.copy()
    rows = [moved]
    for _ in range(3):
        moved += slam1d.gauss_newton_step(moved, graph)
        rows.append(moved)
    work = {**right_work(), "__name__": slam1d.__name__, "my_graph": graph, "my_start": x, "iterates": np.array(rows)}
    ((_, wrong),) = self_check.failures("iterates", work)
    assert "all rows are one state: x += ... changes the array that is in the list, x = x + ... does not" in wrong


def test_the_last_sentence_says_what_is_not_seen(self_check, capsys):
    """It is printed whole; all is ASCII, for old Windows terminals; advice is given once a check, not once a list."""
    far = {**right_work(), "residual": lambda x, graph: slam1d.residual(x, graph) + 1 / 3}
    self_check.check_all(far)
    printed = capsys.readouterr().out
    assert printed.endswith(f"\n{self_check.UNSEEN}\n")
    assert sentences(printed)[-1].startswith("What this check cannot see")
    assert "got 0.333333, expected 0 [m]." in " ".join(printed.split())
    assert "Mend this" not in printed
    assert printed.isascii()

"""Mistakes, known and unknown: what is said of them is true, and the case that shows them is small."""

import pytest

from autograder.attempts import Attempts
from autograder.diagnosis.gallery import gallery
from autograder.engine.collect import collect
from autograder.engine.describe import Describer
from autograder.engine.explain import explain, wants_explanation
from autograder.engine.follow import follow
from autograder.engine.judge import Judge
from autograder.problems.plain import plain
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import slips
from autograder.stages.slips.submission import submission_text
from tests.engine.conftest import REFERENCE


@pytest.fixture(scope="module")
def explained(plan):
    """A function that grades a text and returns one stage, explained, and the case that shows it."""
    judge, describer = Judge(plan), Describer(plan)
    with Sandbox(plan.inputs, Limits(cpu_seconds=1.0)) as sandbox:

        def run(text, name):
            source = Source(kind="module", cells=[text], name="submission.py")
            with sandbox.open(source) as session:
                collected = collect(session, plan)
                follow(session, plan, collected)
                judged = describer.describe(collected, judge.judge(collected), Attempts())
                assert any(wants_explanation(verdict) for verdict in judged if verdict.name == name)
                verdicts = {each.name: each for each in explain(session, plan, judged, collected.replies, Attempts())}
            shown = next(check for check in verdicts[name].checks if not check.passed).counterexample
            return verdicts[name], shown

        yield run


WRAPPED = "\n\n_right = {name}\n\ndef {name}({arguments}):\n    value = _right({arguments})\n    {body}\n"


def wrapped(name, body, arguments="x, graph"):
    """Write the reference with one function changed after the fact."""
    return REFERENCE + WRAPPED.format(name=name, arguments=arguments, body=body)


MISTAKES = {
    "backward edges": (
        "residual",
        wrapped("residual", "i, j = graph.edges.T; value[: len(i)][j < i] *= 1.25; return value"),
        "rows of backward edges (j < i) are wrong",
    ),
    "second prior": (
        "information_matrix",
        wrapped(
            "information_matrix",
            "k = len(graph.edges) + 1; value[k:, k:] *= 1.25; return value",
            "graph",
        ),
        "rows of the second prior are wrong",
    ),
    "five poses": (
        "residual",
        wrapped("residual", "return value if graph.n_poses == 5 else 1.25 * value + 1"),
        "It is right for 5 poses only.",
    ),
    "not symmetric": (
        "normal_equations",
        wrapped("normal_equations", "return np.triu(value[0]) * 1.25, value[1]", "J, omega, f"),
        "H is not symmetric",
    ),
    "only b": (
        "normal_equations",
        wrapped("normal_equations", "return value[0], 1.25 * value[1]", "J, omega, f"),
        "only b is wrong",
    ),
    "ignores x": ("residual", wrapped("residual", "return _right(0 * x + 1.25, graph)"), "It ignores x"),
    "remembers": (
        "residual",
        REFERENCE
        + "\n\n_right, _calls = residual, []\n\ndef residual(x, graph):\n"
        + "    _calls.append(1)\n    return _right(x, graph) + 0.01 * len(_calls)\n",
        "differently when the questions come in another order",
    ),
    "order": (
        "residual",
        wrapped("residual", "value[: len(graph.edges)] += 0.125 * np.arange(len(graph.edges)); return value"),
        "depends on the order in which the edges are listed",
    ),
    "not the derivative": (
        "jacobian",
        wrapped("jacobian", "return 1.25 * value"),
        "J is not the derivative of your own residual",
    ),
    "derivative of a wrong f": (
        "jacobian",
        wrapped("residual", "return 1.25 * value")
        + "\n\n_J = jacobian\n\ndef jacobian(x, graph):\n    return 1.25 * _J(x, graph)\n",
        "J is the derivative of your own residual, so look for the mistake in residual",
    ),
}


def in_gallery(ladder, shown):
    """Whether a counterexample is one of the small cases."""
    names = ("J", "omega", "f") if ladder == "matrices" else ("x", "graph")
    case = [shown[name] for name in names]
    return case in [[plain(each) for each in known] for known in gallery(ladder)]


@pytest.mark.parametrize("name", MISTAKES)
def test_an_unknown_mistake_is_described(explained, name):
    """The sentence says what is true of it, in the subject's words, and a small witness stands beside it."""
    stage, text, words = MISTAKES[name]
    verdict, shown = explained(text, stage)
    assert verdict.slip is None
    assert words in verdict.message
    size = shown["graph"]["n_poses"] if "graph" in shown else len(shown["J"][0])
    assert size <= (3 if name != "five poses" else 4)


def test_the_witness_is_put_into_the_first_failed_check(explained):
    """Its arguments, what came and what was expected are there as plain data; numbers are whole."""
    verdict, shown = explained(wrapped("jacobian", "return 1.25 * value"), "jacobian")
    assert shown["graph"]["n_poses"] == 2
    assert all(float(value).is_integer() for value in shown["graph"]["measurements"])
    assert shown["expected"] == [[-1.0, 1.0], [1.0, 0.0]] or shown["expected"] == [[1.0, -1.0], [1.0, 0.0]]
    assert shown["got"] == [[1.25 * value for value in row] for row in shown["expected"]]
    assert verdict.message.endswith(next(check for check in verdict.checks if not check.passed).message)


@pytest.mark.parametrize(
    "slip", [slip for slip in slips("residual") if slip.catalogue][:6], ids=lambda slip: slip.identifier
)
def test_a_known_mistake_is_shown_on_a_small_graph(explained, slip):
    """The witness of a slip has at most three poses, or as many as the slip needs."""
    verdict, shown = explained(submission_text(slip, "residual"), "residual")
    assert verdict.slip == slip.identifier
    assert verdict.message.startswith(slip.name)
    assert shown["graph"]["n_poses"] <= max(3, slip.minimum_poses)


def test_the_simplest_wrong_case_is_shown(explained):
    """Of all small cases that a submission gets wrong, the first."""
    _, shown = explained(wrapped("residual", "return value + (graph.n_poses > 2) * 0.5"), "residual")
    larger = [[plain(each) for each in case] for case in gallery("graphs") if case[1].n_poses > 2]
    assert [shown["x"], shown["graph"]] == larger[0]


def test_a_mistake_from_four_poses_on_is_shown_on_four(explained):
    """The gallery goes beyond three poses."""
    _, shown = explained(wrapped("residual", "return value + (graph.n_poses > 3) * 0.5"), "residual")
    assert shown["graph"]["n_poses"] == 4
    assert in_gallery("graphs", shown)


def test_where_the_whole_gallery_is_right_the_case_of_the_exam_stands(explained):
    """Wrong only where x has tenths: the gallery has whole numbers and parts of them that double to whole ones."""
    _, shown = explained(wrapped("residual", "return value + 0.5 * ((8192 * x) % 1 > 1e-6).any()"), "residual")
    assert shown is not None
    assert not in_gallery("graphs", shown)


def test_what_remembers_the_exam_is_asked_in_a_fresh_child(explained):
    """Wrong only once a hundred poses were seen: the gallery knows none, so the case of the exam stands."""
    text = REFERENCE + (
        "\n\n_f, _J, _seen = residual, jacobian, set()\n\ndef residual(x, graph):\n    _seen.add(graph.n_poses)\n"
        "    return _f(x, graph)\n\ndef jacobian(x, graph):\n    return _J(x, graph) * (2 if 100 in _seen else 1)\n"
    )
    _, shown = explained(text, "jacobian")
    assert not in_gallery("graphs", shown)


def test_a_step_on_a_wrong_function_is_told_to_mend_that_first(explained):
    """Where residual forgets a measurement and the step halves, the step keeps its case and says what comes first."""
    text = submission_text(next(s for s in slips("residual") if s.identifier.startswith("loop_residual_w")), "residual")
    text += "\n\n_whole = gauss_newton_step\n\n\ndef gauss_newton_step(x, graph):\n    return 0.5 * _whole(x, graph)\n"
    verdict, shown = explained(text, "second_step")
    assert verdict.message.startswith("Mend residual first, which the step builds on. The step is wrong by itself, too")
    assert shown["graph"] not in [plain(graph) for _, graph in gallery("loops")]


@pytest.mark.parametrize(("on_two", "else_"), [("value[0, 0] += 1", "raise OverflowError"), ("1 / 0", "value *= 2")])
def test_status_and_words_are_of_one_kind(explained, on_two, else_):
    """What raised on the exam is shown raising, what was wrong is shown wrong, though a smaller case does the other."""
    body = f"\n    if graph.n_poses == 2: {on_two}\n    else: {else_}\n    return value"
    verdict, shown = explained(wrapped("information_matrix", body, "graph"), "information_matrix")
    assert (verdict.status == "error") == (" raised " in verdict.message) == isinstance(shown["got"], str)

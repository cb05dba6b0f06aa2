"""Mistakes that no catalogue knows: what is said of them is true, and the case that shows them is small."""

import pytest

from autograder.engine.collect import collect
from autograder.engine.explain import Explainer, Explanation, wants_explanation
from autograder.engine.judge import Judge
from autograder.problems.cases import key
from autograder.sandbox.frames import Source
from autograder.sandbox.host import Limits, Sandbox
from autograder.stages.catalogue import slips
from autograder.stages.slips.submission import submission_text
from tests.engine.conftest import REFERENCE


@pytest.fixture(scope="module")
def explain(plan):
    """A function that grades a text and explains one stage of it."""
    judge, explainer = Judge(plan), Explainer(plan)
    with Sandbox(plan.inputs, Limits(cpu_seconds=1.0)) as sandbox:

        def run(text, name):
            source = Source(kind="module", cells=[text], name="submission.py")
            with sandbox.open(source) as session:
                verdicts = {verdict.name: verdict for verdict in judge.judge(collect(session, plan))}
            assert wants_explanation(verdicts[name])
            with sandbox.open(source) as session:
                session.load()
                verdict, known = explainer.explain(session, verdicts[name], None)
            return verdict, known

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
        "differently the second time",
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


@pytest.mark.parametrize("name", MISTAKES)
def test_an_unknown_mistake_is_described(explain, name):
    """The sentence says what is true of it, in the subject's words, and a small witness stands beside it."""
    stage, text, words = MISTAKES[name]
    verdict, known = explain(text, stage)
    assert verdict.slip is None
    assert words in verdict.message
    assert known.witness is not None
    size = known.witness[1].n_poses if stage != "normal_equations" else known.witness[0].shape[1]
    assert size <= (3 if name != "five poses" else 4)


def test_the_witness_is_put_into_the_first_failed_check(explain):
    """Its arguments, what came and what was expected are there as plain data; numbers are whole."""
    verdict, _ = explain(wrapped("jacobian", "return 1.25 * value"), "jacobian")
    shown = next(check for check in verdict.checks if not check.passed).counterexample
    assert shown["graph"]["n_poses"] == 2
    assert all(float(value).is_integer() for value in shown["graph"]["measurements"])
    assert shown["expected"] == [[1.0, -1.0], [1.0, 0.0]]
    assert shown["got"] == [[1.25, -1.25], [1.25, 0.0]]


@pytest.mark.parametrize(
    "slip", [slip for slip in slips("residual") if slip.catalogue][:6], ids=lambda slip: slip.identifier
)
def test_a_known_mistake_is_shown_on_a_small_graph(explain, slip):
    """The witness of a slip has at most three poses, or as many as the slip needs."""
    verdict, known = explain(submission_text(slip, "residual"), "residual")
    assert verdict.slip == slip.identifier
    assert verdict.message.startswith(slip.name)
    assert known.witness[1].n_poses <= max(3, slip.minimum_poses)


def test_nobody_is_shown_what_another_member_of_the_group_says(explain, plan):
    """With or without a witness from its group, a submission gets the facts and the case that are its own."""
    judge, explainer = Judge(plan), Explainer(plan)
    text = wrapped("residual", "return value + (graph.n_poses > 2) * 0.5")
    source = Source(kind="module", cells=[text], name="submission.py")
    _, other = explain(wrapped("residual", "return 1.25 * value"), "residual")
    with Sandbox(plan.inputs, Limits(cpu_seconds=1.0)) as sandbox, sandbox.open(source) as session:
        verdict = judge.judge(collect(session, plan))[0]
        alone, own = explainer.explain(session, verdict, None)
        told, still = explainer.explain(session, verdict, Explanation(("A lie.",), other.witness))
    assert own.witness[1].n_poses == 3
    assert told == alone
    assert key(still.witness) == key(own.witness)


def test_a_mistake_that_no_small_case_shows_is_searched_for(explain):
    """Wrong from four poses on: the search finds a graph of four."""
    _, known = explain(wrapped("residual", "return value + (graph.n_poses > 3) * 0.5"), "residual")
    assert known.witness[1].n_poses == 4

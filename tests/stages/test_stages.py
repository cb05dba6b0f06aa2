"""What every stage holds: right answers pass everywhere, wrong ones fail, points add up."""

import dataclasses

import numpy as np
import pytest

from autograder.problems.draw import draw_ladder
from autograder.stages.catalogue import all_stages
from reference_solution import slam1d
from tests.stages.answering import properties, verdicts

STAGES = {stage.name: stage for stage in all_stages()}
GRAPH_STAGES = ["residual", "jacobian", "information_matrix", "gauss_newton_step"]


@pytest.fixture(scope="module")
def cases():
    """All ladders with 60 drawn cases."""
    ladders = {stage.ladder.name: stage.ladder for stage in all_stages()}
    return {name: draw_ladder(ladder, 0, 60) for name, ladder in ladders.items()}


def rungs(cases, stage):
    """Return the rungs of a stage's ladder with their cases."""
    return cases[stage.ladder.name].items()


@pytest.mark.parametrize("name", STAGES)
def test_the_reference_is_right_everywhere(cases, name):
    """The reference passes every case of every check."""
    stage = STAGES[name]
    for _, found in rungs(cases, stage):
        assert verdicts(stage, found, getattr(slam1d, stage.function)).all()


@pytest.mark.parametrize("name", STAGES)
def test_shares_add_up(name):
    """Every rung of the ladder has a share of the points, and the shares add up to 1."""
    stage = STAGES[name]
    assert set(stage.shares) == {rung.name for rung in stage.ladder.rungs}
    assert sum(stage.shares.values()) == pytest.approx(1.0)
    assert min(stage.shares.values()) > 0


def noisy(function, size):
    """Wrap a function so that its answers are off by a relative error."""

    def changed(*arguments):
        value = function(*arguments)
        if isinstance(value, tuple):
            return tuple(part * (1 + size) for part in value)
        return value * (1 + size)

    return changed


@pytest.mark.parametrize("name", [*GRAPH_STAGES, "normal_equations"])
def test_rounding_noise_passes_and_a_thousandth_fails(cases, name):
    """Errors of 1e-13 are forgiven on every case; of 1e-3 on no check."""
    stage = STAGES[name]
    right = getattr(slam1d, stage.function)
    for rung, found in rungs(cases, stage):
        assert verdicts(stage, found, noisy(right, 1e-13)).all()
        assert not verdicts(stage, found, noisy(right, 1e-3)).all(), rung


def rounded(function, digits):
    """Wrap a function so that it rounds its answers."""

    def changed(*arguments):
        value = function(*arguments)
        return tuple(np.round(part, digits) for part in value) if isinstance(value, tuple) else np.round(value, digits)

    return changed


@pytest.mark.parametrize("name", ["residual", "normal_equations", "gauss_newton_step"])
def test_rounding_to_four_decimals_fails(cases, name):
    """Four decimals are not enough: the real-valued check is lost."""
    stage = STAGES[name]
    found = cases[stage.ladder.name]["dense" if name == "normal_equations" else "real_valued"]
    assert not verdicts(stage, found, rounded(getattr(slam1d, stage.function), 4)).all()


def central_differences(x, graph):
    """Return J by central differences of the residual."""
    h = 1e-6
    columns = [
        (slam1d.residual(x + h * unit, graph) - slam1d.residual(x - h * unit, graph)) / (2 * h)
        for unit in np.eye(graph.n_poses)
    ]
    return np.array(columns).T


def test_central_differences_pass(cases):
    """J by central differences with h = 1e-6 passes, and so does a step that is built on it."""

    def step(x, graph):
        J = central_differences(x, graph)
        H, b = slam1d.normal_equations(J, slam1d.information_matrix(graph), slam1d.residual(x, graph))
        return np.linalg.solve(H, -b)

    for name, function in (("jacobian", central_differences), ("gauss_newton_step", step), ("second_step", step)):
        for _, found in rungs(cases, STAGES[name]):
            assert verdicts(STAGES[name], found, function).all()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", STAGES)
def test_no_number_is_no_answer(cases, name, value):
    """Nan and inf pass no case."""
    stage = STAGES[name]
    right = getattr(slam1d, stage.function)

    def broken(*arguments):
        answer = right(*arguments)
        return tuple(np.full_like(a, value) for a in answer) if stage.parts > 1 else np.full_like(answer, value)

    for _, found in rungs(cases, stage):
        assert not verdicts(stage, found, broken).any()


def test_a_scalar_or_a_broadcastable_shape_is_not_enough(cases):
    """Nothing is broadcast: a zero for a matrix of zeros and ones is a wrong shape."""
    stage = STAGES["jacobian"]
    for _, found in rungs(cases, stage):
        assert not verdicts(stage, found, lambda *_: np.zeros(())).any()
        assert not verdicts(stage, found, lambda x, graph: slam1d.jacobian(x, graph)[:1]).any()


def test_the_step_at_the_minimum_may_carry_noise(cases):
    """From the minimum itself, a step of rounding size is right, and one of 1e-6 is not."""
    stage = STAGES["gauss_newton_step"]
    found = [(x + slam1d.gauss_newton_step(x, graph), graph) for case in rungs(cases, stage) for x, graph in case[1]]
    assert verdicts(stage, found, lambda _, graph: np.zeros(graph.n_poses)).all()
    assert verdicts(stage, found, slam1d.gauss_newton_step).all()
    assert not verdicts(stage, found, lambda _, graph: np.full(graph.n_poses, 1e-6)).all()


class Stateful:
    """Right at the first call for a graph, zero at every later one."""

    def __init__(self):
        self.seen = set()

    def __call__(self, x, graph):
        if graph in self.seen:
            return np.zeros(graph.n_poses)
        self.seen.add(graph)
        return slam1d.gauss_newton_step(x, graph)


def damped(x, graph):
    """Return the step with 1e-3 added to the diagonal of H."""
    J = slam1d.jacobian(x, graph)
    H, b = slam1d.normal_equations(J, slam1d.information_matrix(graph), slam1d.residual(x, graph))
    return np.linalg.solve(H + 1e-3 * np.eye(len(H)), -b)


FORGERIES = {
    "constant zero": lambda _, graph: np.zeros(graph.n_poses),
    "minus x": lambda x, _: -x,
    "constant target": lambda x, graph: np.arange(graph.n_poses) - x,
    "dead reckoning minus x": lambda x, graph: graph.dead_reckoning() - x,
    "half a step": lambda x, graph: 0.5 * slam1d.gauss_newton_step(x, graph),
    "Levenberg damping": damped,
    "constant step": lambda _, graph: np.ones(graph.n_poses),
    "sign flipped": lambda x, graph: -slam1d.gauss_newton_step(x, graph),
    "sum of the measurements minus x": lambda x, graph: graph.measurements.sum() - x,
    "mean of the measurements minus x": lambda x, graph: graph.measurements.mean() - x,
    "weighted sum of the measurements minus x": lambda x, graph: graph.measurements @ (1 / graph.edge_variances) - x,
    "a place for every weighted sum minus x": lambda x, graph: (
        np.outer(np.arange(1, graph.n_poses + 1), 1 / graph.edge_variances) @ graph.measurements - x
    ),
    "dead reckoning along another tree minus x": lambda x, graph: backwards(graph).dead_reckoning() - x,
    "a target from the hash minus x": lambda x, graph: (
        np.random.default_rng(np.frombuffer(graph.measurements.tobytes(), np.uint32)).normal(size=graph.n_poses) - x
    ),
}


def backwards(graph):
    """Return the same graph with its edges in the reverse order: dead reckoning takes the last edges first."""
    turned = {name: getattr(graph, name)[::-1] for name in ("edges", "measurements", "edge_variances")}
    return dataclasses.replace(graph, **turned)


@pytest.mark.parametrize("name", FORGERIES)
def test_forged_steps_earn_nothing(cases, name):
    """No loop accepts a step that is zero, constant, blind or only moving with measurements; no check a damped one.

    1e-3 on the diagonal is a guard, and no damping, on the few loops whose weights are all above 1e3.
    """
    for _, found in rungs(cases, STAGES["second_step"]):
        right = verdicts(STAGES["second_step"], found, FORGERIES[name])
        sure = np.array([1.0 / graph.edge_variances.max() > 1e3 for _, graph in found])
        assert not right[~sure].any() if name == "Levenberg damping" else not right.any()
        assert not right.all()


def test_a_target_that_agrees_on_some_loops_only_fails_every_check(cases):
    """Dead reckoning and the sum of all: the sum is 0 where the edges run round the loop, and not elsewhere."""

    def step(x, graph):
        return graph.dead_reckoning() + graph.measurements.sum() - x

    for _, found in rungs(cases, STAGES["second_step"]):
        assert not verdicts(STAGES["second_step"], found, step).all()


def test_a_stateful_step_earns_nothing(cases):
    """A step that is right once and zero afterwards fails every loop."""
    for _, found in rungs(cases, STAGES["second_step"]):
        assert not verdicts(STAGES["second_step"], found, Stateful()).any()


def test_a_consistently_weighted_wrong_step_passes_the_second_step_only(cases):
    """Unweighted least squares is linear too: the second step is zero, the step itself is wrong."""

    def unweighted(x, graph):
        return np.linalg.lstsq(slam1d.jacobian(x, graph), -slam1d.residual(x, graph), rcond=None)[0]

    for _, found in rungs(cases, STAGES["second_step"]):
        assert verdicts(STAGES["second_step"], found, unweighted).all()
    single = cases["graphs"]["single_loops"]
    assert not verdicts(STAGES["gauss_newton_step"], single, unweighted).all()


@pytest.mark.parametrize("ratio", [1e2, 1e4])
def test_other_weights_pass_however_little_a_measurement_then_says(cases, ratio):
    """A measurement with a ten-thousandth of the weight still moves the point, though by less than a millimetre."""

    def weighted(x, graph):
        root = np.where(np.arange(graph.n_factors) % 2 == 0, ratio**0.5, 1.0)[:, None]
        J, f = slam1d.jacobian(x, graph), slam1d.residual(x, graph)
        return np.linalg.lstsq(root * J, -root[:, 0] * f, rcond=None)[0]

    for _, found in rungs(cases, STAGES["second_step"]):
        assert verdicts(STAGES["second_step"], found, weighted).all()


def test_all_four_properties_are_needed(cases):
    """Each property is broken alone by some step, and the sentence is about that one."""
    stage = STAGES["second_step"]

    def swings(x, graph):
        return 2.0 * slam1d.gauss_newton_step(x, graph)

    for position, (step, words) in enumerate(
        [
            (swings, "the second step is"),
            (lambda _, graph: np.zeros(graph.n_poses), "depends on the start"),
            (FORGERIES["dead reckoning minus x"], "does not move when the measurement"),
            (FORGERIES["sum of the measurements minus x"], "must be that state, whatever the weights"),
        ]
    ):
        case = cases["loops"]["single_loops"][2]
        x, graph = case[0][0], case[1]
        answers = [step(*call) for call in stage.calls(case)]
        hold = properties(stage, case, step)
        assert not hold[position]
        assert words in stage.explain(case, (*answers, step(x + answers[0], graph)))
    assert properties(stage, case, slam1d.gauss_newton_step).all()


@pytest.mark.parametrize("name", STAGES)
def test_the_explanation_of_a_wrong_answer_names_what_came(cases, name):
    """`explain` gives one sentence on a wrong answer of the right shape."""
    stage = STAGES[name]
    for _, found in rungs(cases, stage):
        case = found[0]
        got = tuple(array + 1.0 for call in stage.calls(case) for array in stage.expected(*call))
        words = stage.explain(case, got)
        assert words.endswith(".")
        assert len(words) < 400


@pytest.mark.parametrize("stage", all_stages(), ids=lambda stage: stage.name)
def test_shapes_are_those_of_the_right_answer(stage):
    """What a stage says of its shapes without an answer is what the right answer has."""
    for rung in stage.ladder.rungs:
        facet = stage.facet(rung.name)
        for case in rung.core:
            for call in facet.calls(case):
                assert facet.shapes(*call) == [array.shape for array in facet.expected(*call)]

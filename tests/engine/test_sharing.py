"""Results in memory equal those on disk, and what many submissions share is held once."""

from __future__ import annotations

from autograder.engine.sharing import Shared
from autograder.verdicts import CheckVerdict, Result, StageVerdict, decode, encode


def result(name: str, counterexample: dict[str, object] | None = None) -> Result:
    """A result with one stage that passed and one that may show a case."""
    right = CheckVerdict(name="single_loops", passed=True, points=5.0, max_points=5.0, cases=40)
    wrong = CheckVerdict(
        name="priors", passed=False, points=0.0, max_points=5.0, cases=40, counterexample=counterexample
    )
    stages = (
        StageVerdict(name="residual", status="passed", score=5.0, max_score=5.0, checks=(right,)),
        StageVerdict(name="jacobian", status="partial", score=5.0, max_score=10.0, checks=(right, wrong)),
    )
    known = {"confinement": "full", "seed": 0, "grader_version": "0", "fingerprint": "f", "seconds": 0.1}
    return decode(encode(Result(submission=name, status="graded", score=10.0, max_score=15.0, stages=stages, **known)))


def test_equal_verdicts_are_one_object() -> None:
    """Two students who passed the same stage share its verdict, and every check that shows no case."""
    shared = Shared()
    ada, bob = shared.result(result("ada")), shared.result(result("bob", {"x": [1.0]}))
    assert ada.stages[0] is bob.stages[0]
    assert ada.stages[1].checks[0] is bob.stages[1].checks[0] is ada.stages[0].checks[0]


def test_nothing_of_a_result_is_changed() -> None:
    """With a counterexample or without, the result is the one that was given."""
    shared = Shared()
    for given in (result("ada"), result("bob", {"x": [1.0]}), result("cleo", {"x": [2.0]})):
        assert shared.result(given) == given
        assert encode(shared.result(given)) == encode(given)

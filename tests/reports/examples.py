"""Verdicts made by hand, as the engine would hand them over: what the report tests look at."""

from autograder.verdicts import CheckVerdict, Result, StageVerdict

POINTS = {
    "residual": 15.0,
    "jacobian": 15.0,
    "information_matrix": 10.0,
    "normal_equations": 20.0,
    "gauss_newton_step": 20.0,
    "second_step": 10.0,
}
GRAPH = {
    "n_poses": 3,
    "edges": [[0, 1], [1, 2], [0, 2]],
    "measurements": [1.0, 1.5, 2.0],
    "edge_variances": [0.01, 0.01, 0.04],
    "priors": [0],
    "prior_means": [0.0],
    "prior_variances": [0.001],
}
WRONG_J = {
    "function": "jacobian",
    "graph": GRAPH,
    "x": [0.0, 1.0, 2.5],
    "expected": [[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 0.0]],
    "got": [[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -0.0]],
}
WRONG_NORMAL = {
    "function": "normal_equations",
    "J": [[1.0, -1.0], [1.0, 0.0]],
    "omega": [[25.0, 0.0], [0.0, 1000.0]],
    "f": [-0.5, 1.0],
    "expected": [[[1025.0, -25.0], [-25.0, 25.0]], [987.5, 12.5]],
    "got": [[[1025.0, -25.0], [-25.0, 25.0]], [0.5, 0.5]],
}


def stage(name, status="passed", score=None, message="", counterexample=None, **more):
    """One stage; full points where it passed, none otherwise unless `score` says so."""
    most = POINTS.get(name, 5.0)
    if score is None:
        score = most if status == "passed" else 0.0
    checks = (
        ()
        if status == "awaiting_mark"
        else (
            CheckVerdict(name="worked example", passed=score > 0, points=score, max_points=most / 2, cases=1),
            CheckVerdict(
                name="several loops",
                passed=status == "passed",
                points=0.0,
                max_points=most / 2,
                cases=200,
                message=message,
                counterexample=counterexample,
            ),
        )
    )
    return StageVerdict(name=name, status=status, score=score, max_score=most, message=message, checks=checks, **more)


def result(submission, *changed, status="graded", **more):
    """One submission: every stage passed but those given."""
    by_name = {verdict.name: verdict for verdict in changed}
    stages = [by_name.pop(name, None) or stage(name) for name in POINTS]
    stages += list(by_name.values())
    if status != "graded":
        stages = []
    score = sum(verdict.score for verdict in stages)
    values = {
        "submission": submission,
        "status": status,
        "score": None if status == "grader_error" else score,
        "max_score": 90.0,
        "stages": tuple(stages),
        "confinement": "full",
        "seed": 7,
        "grader_version": "0.1.0",
        "fingerprint": "0" * 64,
        "seconds": 0.05,
    }
    return Result(**{**values, **more})


def small_class():
    """Return a class with one of everything."""
    sign = {"slip": "loop_sign_flipped", "hint": "Which pose does the factor predict?"}
    return [
        result("alice"),
        result("bob_the_builder_with_a_long_name", stage("jacobian", "partial", 7.5, "J is off", WRONG_J, **sign)),
        result("carol", stage("jacobian", "failed", None, "J is off", WRONG_J, **sign)),
        result("dave", stage("normal_equations", "failed", 0.0, "Omega does not stand in b", WRONG_NORMAL)),
        result("erin", *(stage(name, "missing", message=f"{name} is not written yet") for name in POINTS)),
        result("frank", stage("gauss_newton_step", "timeout", message="took more than 2 s of CPU time")),
        result("grace", stage("residual", "error", message="raised IndexError: index 5 is out of bounds")),
        result("heidi", stage("second_step", "memory", message="needed more than 512 MiB")),
        result("ivan", stage("information_matrix", "forbidden", message="uses scipy, which is not allowed")),
        result("judy", status="rejected", message="judy.ipynb is no notebook: it holds text that is not JSON."),
        result("kim", status="grader_error", message="The sandbox went away."),
    ]

"""Check your own work, with no answer at hand: every line tests a property that right code has.

In the notebook: `check("residual", globals())`. In a terminal: `python self_check.py`, which looks at
slam1d.py beside it. Nothing here needs more than numpy.
"""
# One long file instead of several: a student has it beside the notebook, and the notebook carries it along.
# ruff: noqa: ARG001, D401 - every check has the same arguments, and its docstring is the line that is printed

from __future__ import annotations

import sys
import traceback
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Callable

import numpy as np
from posegraph import PoseGraph, Ranging

__all__ = ["UNSEEN", "check", "check_all", "failures"]

UNSEEN = (
    "What this check cannot see: mistakes that show on other graphs only, such as typed-in\n"
    "      numbers or lost digits (the grader draws hundreds), slow code, and what you conclude."
)


class Unfinished(Exception):  # noqa: N818 - an outcome, no error
    """A function that is not written yet; Jupyter shows it as one sentence."""

    def _render_traceback_(self) -> list[str]:
        return [str(self)]


class Wrong(Exception):  # noqa: N818 - an outcome, no error
    """A property that does not hold; the text says where."""


def _graph(n: int, edges: list[tuple[int, int, float, float]], priors: list[tuple[int, float, float]]) -> Any:
    e, p = np.array(edges), np.array(priors)
    return PoseGraph(n, e[:, :2].astype(int), e[:, 2], e[:, 3], p[:, 0].astype(int), p[:, 1], p[:, 2])


WORKED = _graph(
    5,
    [(0, 1, 1.1, 0.01), (1, 2, 1.0, 0.01), (2, 3, 1.1, 0.01), (3, 4, -2.7, 0.01), (0, 4, 0.0, 0.01)],
    [(0, 0.0, 0.001)],
)
# The six public graphs, each with a state that is not dead reckoning.
PUBLIC = {
    "two poses": ([4.0, 6.0], _graph(2, [(0, 1, 1.5, 0.04)], [(0, 3.0, 0.001)])),
    "interior loop": (
        [0.5, 1.0, 3.25, 2.0, 4.0],
        _graph(
            5,
            [(0, 1, 1, 0.01), (1, 2, 2, 0.02), (2, 3, -1, 0.05), (3, 4, 1, 0.01), (1, 3, 1.5, 0.02)],
            [(0, 0, 0.01)],
        ),
    ),
    "backward edge": (
        [-1.0, 0.5, 2.0, 2.75],
        _graph(4, [(0, 1, 1, 0.02), (2, 1, -1.2, 0.01), (2, 3, 0.5, 0.04), (3, 0, -2.9, 0.05)], [(0, 0, 0.01)]),
    ),
    "shuffled and doubled edges": (
        [1.0, 1.5, 3.0, 3.5],
        _graph(
            4,
            [(2, 3, 1, 0.05), (0, 2, 2.4, 0.04), (0, 1, 1, 0.01), (1, 2, 1, 0.02), (0, 1, 1.3, 0.03)],
            [(0, 0, 0.01)],
        ),
    ),
    "two priors": (
        [2.0, 2.25, 4.5, 3.0],
        _graph(
            4,
            [(0, 1, 1, 0.02), (1, 2, 2, 0.01), (2, 3, -1, 0.02), (1, 3, 1.5, 0.01)],
            [(2, 4.0, 0.05), (0, 1.5, 0.02)],
        ),
    ),
    "unequal variances": (
        [-1.5, 0.25, 1.125, 1.8765432],
        _graph(4, [(0, 1, 1, 0.004), (1, 2, 1, 0.3), (2, 3, 1, 2.0), (0, 3, 2.2, 0.05)], [(0, -1.0, 0.6)]),
    ),
}


class Student:
    """The functions under test, and the problems to test them on."""

    def __init__(self, namespace: dict[str, Any]) -> None:
        self.namespace = namespace

    def problems(self) -> Iterator[tuple[str, Any, np.ndarray]]:
        """Yield name, graph and state: the worked example, the six public graphs, your own."""
        yield "the worked example", WORKED, WORKED.dead_reckoning()
        for name, (x, graph) in PUBLIC.items():
            yield f"the public graph '{name}'", graph, np.array(x)
        own, start = self.namespace.get("my_graph"), self.namespace.get("my_start")
        if isinstance(own, PoseGraph) and start is not None:
            yield "my_graph", own, np.array(start, dtype=float)

    def call(self, name: str, shapes: Sequence[tuple[int, ...]], *arguments: Any) -> list[np.ndarray]:
        """Call one function on copies and hold what it returns to the promised shapes."""
        function = self.namespace.get(name)
        if function is None:
            raise Unfinished(f"{name} is not defined: run the cell that defines it, then this one again.")
        try:
            returned = function(*(a.copy() if isinstance(a, np.ndarray) else a for a in arguments))
        except NotImplementedError:
            raise Unfinished(f"{name} is not finished yet: write it, run its cell, then run this one again.") from None
        except Exception as error:  # noqa: BLE001 - a student's code may raise anything; its line is shown
            raise Wrong(f"{name} raised {type(error).__name__}: {error}{_line(error)}") from None
        parts = [returned] if len(shapes) == 1 else returned
        if len(shapes) > 1 and not (isinstance(parts, (tuple, list)) and len(parts) == len(shapes)):
            raise Wrong(f"{name} returned {type(returned).__name__}, expected a tuple of {len(shapes)} arrays.")
        return [_array(name, part, shape) for part, shape in zip(parts, shapes)]

    def residual(self, x: np.ndarray, graph: Any) -> np.ndarray:
        """Return f."""
        return self.call("residual", [(graph.n_factors,)], x, graph)[0]

    def jacobian(self, x: np.ndarray, graph: Any) -> np.ndarray:
        """Return J."""
        return self.call("jacobian", [(graph.n_factors, graph.n_poses)], x, graph)[0]

    def omega(self, graph: Any) -> np.ndarray:
        """Return Omega."""
        return self.call("information_matrix", [(graph.n_factors, graph.n_factors)], graph)[0]

    def normal(self, J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> list[np.ndarray]:
        """Return H and b."""
        n = J.shape[1]
        return self.call("normal_equations", [(n, n), (n,)], J, omega, f)

    def step(self, x: np.ndarray, graph: Any) -> np.ndarray:
        """Return dx."""
        return self.call("gauss_newton_step", [(graph.n_poses,)], x, graph)[0]

    def cost(self, x: np.ndarray, graph: Any) -> float:
        """Return F(x), the sum of squared residuals, each divided by its variance."""
        f = self.residual(x, graph)
        return float(sum(f * f / np.append(graph.edge_variances, graph.prior_variances)))


def _line(error: Exception) -> str:
    frames = [f for f in traceback.extract_tb(error.__traceback__) if f.filename != check.__code__.co_filename]
    own = [f for f in frames if "site-packages" not in f.filename and f.line]
    return f" (line {own[-1].lineno}: {own[-1].line})" if own else ""


def _array(name: str, value: Any, shape: tuple[int, ...]) -> np.ndarray:
    came = "None" if value is None else type(value).__name__
    try:
        array = np.asarray("" if value is None else value, dtype=float)
    except (TypeError, ValueError):
        raise Wrong(f"{name} returned {came}, expected an array of shape {shape}.") from None
    if len(shape) == 1 and array.shape in ((shape[0], 1), (1, shape[0])):
        array = array.ravel()
    if array.shape != shape:
        raise Wrong(f"{name} returned shape {array.shape}, expected {shape}.")
    if not np.isfinite(array).all():
        raise Wrong(f"{name} returned numbers that are not finite.")
    return array


def number(value: float) -> str:
    """Print a number short, and -0. as 0."""
    if value == 0:
        return "0"
    return f"{value:.0f}" if abs(value) < 1e7 and float(value).is_integer() else f"{value:.6g}"


def vector(values: np.ndarray) -> str:
    """Print numbers in square brackets."""
    return "[" + " ".join(number(value) for value in values.ravel().tolist()) + "]"


def factor(graph: Any, row: int) -> str:
    """Name the factor that a row belongs to."""
    edges = len(graph.edges)
    if row < edges:
        i, j = graph.edges[row].tolist()
        return f"row {row} (edge {i} -> {j})"
    return f"row {row} (prior on pose {int(graph.priors[row - edges])})"


def _replace(graph: Any, **fields: Any) -> Any:
    names = ("n_poses", "edges", "measurements", "edge_variances", "priors", "prior_means", "prior_variances")
    return PoseGraph(**{name: fields.get(name, getattr(graph, name)) for name in names})


def _same_rows(graph: Any, what: str, got: np.ndarray, expected: np.ndarray, tolerance: float = 1e-9) -> None:
    far = np.abs(got - expected) > tolerance * (1 + np.abs(expected))
    wrong = np.flatnonzero(far.reshape(len(got), -1).any(axis=1))
    if wrong.size:
        row = int(wrong[0])
        raise Wrong(f"{factor(graph, row)} of {what}: got {vector(got[row])}, expected {vector(expected[row])}.")


# --- residual -----------------------------------------------------------------------------------


def published(s: Student, graph: Any, x: np.ndarray) -> None:
    """In the worked example only the loop closure disagrees, by 0.5 m."""
    if graph is WORKED:
        _same_rows(graph, "f", s.residual(x, graph), np.array([0, 0, 0, 0, -0.5, 0]))


def moved_together(s: Student, graph: Any, x: np.ndarray) -> None:
    """When all poses move by 1.75 m, edge rows stay and prior rows grow by 1.75."""
    moves = np.arange(graph.n_factors) >= len(graph.edges)
    expected = s.residual(x, graph) + np.where(moves, 1.75, 0)
    _same_rows(graph, "f after the move", s.residual(x + 1.75, graph), expected)


def fits(s: Student, graph: Any, x: np.ndarray) -> None:
    """Where every measurement and every prior agrees with x, f is 0."""
    tails, heads = x[graph.edges[:, 0]], x[graph.edges[:, 1]]
    agreed = _replace(graph, measurements=heads - tails, prior_means=x[graph.priors])
    _same_rows(graph, "f where all agrees", s.residual(x, agreed), np.zeros(graph.n_factors))


def one_longer(s: Student, graph: Any, x: np.ndarray) -> None:
    """A longer measurement raises only its own row, a larger mean lowers its own."""
    f, k = s.residual(x, graph), len(graph.edges)
    for row in range(graph.n_factors):
        expected = f.copy()
        if row < k:
            changed = _replace(graph, measurements=graph.measurements + 0.375 * (np.arange(k) == row))
            expected[row] += 0.375
        else:
            bump = 0.375 * (np.arange(len(graph.priors)) == row - k)
            changed = _replace(graph, prior_means=graph.prior_means + bump)
            expected[row] -= 0.375
        _same_rows(graph, "f", s.residual(x, changed), expected)


# --- jacobian -----------------------------------------------------------------------------------


def derivative(s: Student, graph: Any, x: np.ndarray) -> None:
    """J is the derivative of your residual: move a pose, see how f answers."""
    h = 0.25
    columns = [(s.residual(x + h * e, graph) - s.residual(x - h * e, graph)) / (2 * h) for e in np.eye(len(x))]
    _same_rows(graph, "J", s.jacobian(x, graph), np.array(columns).T, 1e-6)


def row_sums(s: Student, graph: Any, x: np.ndarray) -> None:
    """Every edge row of J adds up to 0, every prior row to 1."""
    sums = np.where(np.arange(graph.n_factors) < len(graph.edges), 0, 1)
    _same_rows(graph, "J, added up", s.jacobian(x, graph).sum(axis=1), sums, 1e-6)


# --- information matrix -------------------------------------------------------------------------


def weights(s: Student, graph: Any, x: np.ndarray) -> None:
    """Every weight times its variance is 1."""
    variances = np.append(graph.edge_variances, graph.prior_variances)
    _same_rows(graph, "weight x variance", np.diag(s.omega(graph)) * variances, np.ones(len(variances)))


def independent(s: Student, graph: Any, x: np.ndarray) -> None:
    """Off the diagonal Omega is 0: the measurements are independent."""
    omega = s.omega(graph)
    _same_rows(graph, "Omega without its diagonal", omega - np.diag(np.diag(omega)), np.zeros(omega.shape))


# --- normal equations ---------------------------------------------------------------------------

# Three systems that belong to no graph: J, the diagonal of Omega, f.
SYSTEMS = [
    ([[1, 2], [0, 1], [3, -1]], [3, 7, 11], [1, -2, 5]),
    ([[1.5, -2, 0], [0, 1, 3], [4, 0.5, 1], [1, 1, -1]], [0.2, 30, 13, 7], [1, 0.25, -3, 2]),
    ([[2, 0, 1], [0, -1, 0], [1, 0, 3], [0, 4, 1], [1, 1, 1]], [5, 0.5, 100, 2, 9], [0.1, 2, -1, 0.5, 3]),
]


def half_derivatives(
    cost: Callable[[np.ndarray], float], H: np.ndarray, b: np.ndarray, tolerance: float = 1e-7
) -> None:
    """Compare H and b with differences of a quadratic cost, which are exact for any width."""
    n, h = len(b), 0.5
    unit = np.eye(n)
    if np.abs(H - H.T).max() > 1e-9 * np.abs(H).max():
        raise Wrong("H must be symmetric, and yours is not.")
    for i in range(n):
        slope = (cost(h * unit[i]) - cost(-h * unit[i])) / (4 * h)
        size = np.sqrt(np.abs(H[i, i]) * (1 + abs(cost(np.zeros(n)))))
        if abs(b[i] - slope) > tolerance * (1 + abs(slope) + size):
            raise Wrong(f"b[{i}]: got {number(b[i])}, but half the slope of the cost is {number(slope)}.")
        for j in range(n):
            p, q = h * unit[i], h * unit[j]
            bend = (cost(p + q) - cost(p - q) - cost(q - p) + cost(-p - q)) / (8 * h * h)
            if abs(H[i, j] - bend) > tolerance * (1 + abs(bend) + np.abs(H).max()):
                raise Wrong(f"H[{i}, {j}]: got {number(H[i, j])}, but half the bend of the cost is {number(bend)}.")


def _linear_cost(J: np.ndarray, w: np.ndarray, f: np.ndarray, d: np.ndarray) -> float:
    return float(sum(w * (f + J @ d) ** 2))


def any_system(s: Student, graph: Any, x: np.ndarray) -> None:
    """H is half the Hessian, b half the gradient, for any J, Omega, f."""
    if graph is WORKED:
        for system in SYSTEMS:
            J, w, f = (np.array(part, dtype=float) for part in system)
            H, b = s.normal(J, np.diag(w), f)
            half_derivatives(partial(_linear_cost, J, w, f), H, b, 1e-9)


def own_system(s: Student, graph: Any, x: np.ndarray) -> None:
    """H is half the Hessian of your own F, b half its gradient."""
    H, b = s.normal(s.jacobian(x, graph), s.omega(graph), s.residual(x, graph))
    half_derivatives(lambda d: s.cost(x + d, graph), H, b)


# --- step ---------------------------------------------------------------------------------------


def solves(s: Student, graph: Any, x: np.ndarray) -> None:
    """The step solves your own H dx = -b."""
    dx = s.step(x, graph)
    H, b = s.normal(s.jacobian(x, graph), s.omega(graph), s.residual(x, graph))
    left = np.abs(H @ dx + b)
    row = int(np.argmax(left))
    if left[row] > 1e-7 * (np.abs(H).sum(axis=1).max() * (np.abs(dx).max() + 1e-6) + np.abs(b).max()):
        raise Wrong(f"dx = {vector(dx)} leaves H dx + b = {number(left[row])} in row {row}, where it should be 0.")


def falls(s: Student, graph: Any, x: np.ndarray) -> None:
    """The step makes the cost lower."""
    before, after = s.cost(x, graph), s.cost(x + s.step(x, graph), graph)
    if after > before + 1e-9 * (1 + before):
        raise Wrong(f"the cost grew from {number(before)} to {number(after)}.")


def lowest(s: Student, graph: Any, x: np.ndarray) -> None:
    """The step leads where the normal equations say."""
    point = x + s.step(x, graph)
    after = s.cost(point, graph)
    for pose, move in enumerate(1e-3 * np.eye(len(x))):
        for sign in (1, -1):
            if s.cost(point + sign * move, graph) < after - 1e-10 * (1 + after):
                raise Wrong(f"after the step, moving pose {pose} by {sign} mm makes the cost lower still.")


def second_vanishes(s: Student, graph: Any, x: np.ndarray) -> None:
    """Taken again from x + dx, and from another start, the step is right as well."""
    point = x + s.step(x, graph)
    size = 1e-7 * (10 + np.abs(x).max() + np.abs(point).max())
    if np.abs(s.step(point, graph)).max() > size:
        second = vector(s.step(point, graph))
        raise Wrong(f"after one step to {vector(point)}, the second step is {second}: does it solve H dx = -b?")
    other = np.linspace(3, -2, len(x))
    if np.abs(other + s.step(other, graph) - point).max() > size:
        raise Wrong(f"x + dx(x) depends on the start: from {vector(x)} and from {vector(other)} it differs.")


def data_matter(s: Student, graph: Any, x: np.ndarray) -> None:
    """Where the step leads depends on every measurement."""
    point = x + s.step(x, graph)
    for row in range(len(graph.edges)):
        bump = 1.0 * (np.arange(len(graph.edges)) == row)
        changed = _replace(graph, measurements=graph.measurements + bump)
        if np.abs(x + s.step(x, changed) - point).max() < 1e-6:
            raise Wrong(f"x + dx(x) stays {vector(point)} when the measurement of {factor(graph, row)} grows by 1 m.")


# --- answers and bonus --------------------------------------------------------------------------


def follow(s: Student, graph: Any, x: np.ndarray) -> None:
    """Row 0 of iterates is the start, each further row the last plus your step."""
    if graph is not s.namespace.get("my_graph"):
        return
    given = s.namespace.get("iterates")
    if given is None:
        raise Unfinished("iterates is still None: fill it with x^(0) to x^(3), one row each.")
    rows = _array("iterates", given, (4, len(x)))
    wanted = x
    for index, row in enumerate(rows):
        if np.abs(row - wanted).max() > 1e-6 * (1 + np.abs(wanted).max()):
            raise Wrong(f"row {index} of iterates is {vector(row)}; it does not follow from the row before.")
        wanted = row + s.step(row, graph)


def patterns(s: Student, graph: Any, x: np.ndarray) -> None:
    """The masks are where your own J and H are not 0."""
    shapes = [(graph.n_factors, graph.n_poses), (graph.n_poses, graph.n_poses)]
    J = s.jacobian(x, graph)
    H, _ = s.normal(J, s.omega(graph), s.residual(x, graph))
    for what, got, full in zip(("J_mask", "H_mask"), s.call("sparsity_pattern", shapes, graph), (J, H)):
        wrong = np.argwhere((got != 0) != (np.abs(full) > 1e-9 * np.abs(full).max()))
        if len(wrong):
            i, j = wrong[0].tolist()
            raise Wrong(f"{what}[{i}, {j}] is {bool(got[i, j])}, but the entry is {number(full[i, j])}.")


def ranges(s: Student, graph: Any, x: np.ndarray) -> None:
    """A longer range lowers its own row of f, and J is the derivative of f."""
    if graph is not WORKED:
        return
    beacon, poses = np.array([2.0, 1.0]), np.array([3, 0, 3])
    far = np.array([np.hypot(x[k] - 2.0, 1.0) for k in poses])
    longer = np.array([0.0, 0.25, 0.5])
    ranging = Ranging(beacon, poses, far + longer, np.full(3, 0.01))
    f = s.call("range_residual", [(3,)], x, ranging)[0]
    if np.abs(f + longer).max() > 1e-9:
        raise Wrong(f"f: got {vector(f)}, expected {vector(-longer)} [m].")
    (J,), h = s.call("range_jacobian", [(3, len(x))], x, ranging), 1e-5
    for pose, move in enumerate(h * np.eye(len(x))):
        ahead, behind = (s.call("range_residual", [(3,)], y, ranging)[0] for y in (x + move, x - move))
        if np.abs(J[:, pose] - (ahead - behind) / (2 * h)).max() > 1e-6:
            raise Wrong(f"column {pose} of J is {vector(J[:, pose])}, but your f changes otherwise with that pose.")


STAGES: dict[str, tuple[Callable[[Student, Any, np.ndarray], None], ...]] = {
    "residual": (published, moved_together, fits, one_longer),
    "jacobian": (row_sums, derivative),
    "information_matrix": (weights, independent),
    "normal_equations": (any_system, own_system),
    "gauss_newton_step": (solves, falls),
    "second_step": (lowest, second_vanishes, data_matter),
    "iterates": (follow,),
    "sparsity_pattern": (patterns,),
    "range_factor": (ranges,),
}
BONUS = ("sparsity_pattern", "range_factor")


def failures(stage: str, namespace: dict[str, Any]) -> list[tuple[str, str]]:
    """List every check of a stage with what is wrong, "" where it passes; raises Unfinished."""
    student, found = Student(namespace), []
    if stage == "iterates" and not isinstance(namespace.get("my_graph"), PoseGraph):
        raise Unfinished("my_graph is not defined: run the cell that defines it, then this one again.")
    for prove in STAGES[stage]:
        wrong = ""
        for name, graph, x in student.problems():
            try:
                prove(student, graph, x)
            except Wrong as error:
                wrong = f"on {name} at x = {vector(x)}: {error}"
                break
        found.append(((prove.__doc__ or "").strip(), wrong))
    return found


def check(stage: str, namespace: dict[str, Any]) -> None:
    """Print PASS or FAIL for every check of a stage; stop with a sentence where it is unfinished.

    Parameters
    ----------
    stage : str
        "residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step",
        "second_step" or "iterates"; "sparsity_pattern" and "range_factor" for the bonus.
    namespace : dict
        Your functions by name: `globals()`.
    """
    for line, wrong in failures(stage, namespace):
        print(f"FAIL  {stage}: {line}\n      {wrong}" if wrong else f"PASS  {stage}: {line}")


def check_all(namespace: dict[str, Any]) -> None:
    """Check every stage, say what is open, and end with what cannot be seen here."""
    for stage in STAGES:
        try:
            check(stage, namespace)
        except Unfinished as unfinished:
            if stage not in BONUS:
                print(f"TODO  {stage}: {unfinished}")
    print(UNSEEN)


if __name__ == "__main__":
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("slam1d.py")
    work: dict[str, Any] = {"__name__": "slam1d"}
    exec(compile(file.read_text(encoding="utf-8"), str(file), "exec"), work)
    check_all(work)

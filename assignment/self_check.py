"""Check your own work, with no answer at hand: every line tests a property that right code has.

In the notebook: `check("residual", globals())`. In a terminal: `python self_check.py`, which looks at
slam1d.py beside it. Nothing here needs more than numpy.
"""
# One long file instead of several: a student has it beside the notebook, and the notebook carries it along.
# ruff: noqa: ARG001, D401 - every check has the same arguments, and its docstring is the line that is printed

from __future__ import annotations

import sys
import textwrap
import threading
import traceback
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any, Callable

import numpy as np

try:
    from posegraph import PoseGraph, Ranging
except ModuleNotFoundError:
    raise SystemExit("posegraph.py must lie beside self_check.py.") from None

UNSEEN = (
    "What this check cannot see: mistakes that show on other graphs only, such as typed-in\n"
    "      numbers or lost digits (the grader draws hundreds), slow code, and what you conclude."
)
PATIENCE = 5.0  # seconds until a check that does not end says so
PARTS = {"normal_equations": ("H of ", "b of "), "sparsity_pattern": ("J_mask of ", "H_mask of ")}


# What may be imported where the homework is graded: numpy, and of the standard library what computes.
ALLOWED = """
    posegraph numpy math cmath fractions decimal statistics itertools functools operator collections dataclasses
    typing enum copy random time warnings abc numbers string textwrap re json sys os io contextlib types pprint
    inspect __future__ argparse array ast base64 binascii bisect builtins calendar codecs colorsys contextvars
    copyreg csv datetime difflib dis doctest errno fnmatch gc getopt graphlib hashlib heapq hmac html keyword
    locale logging optparse pathlib pickle platform queue reprlib sched secrets shlex stat struct symtable
    threading timeit token tokenize traceback unicodedata unittest uuid weakref zlib matplotlib IPython
    self_check tqdm
"""


class Unfinished(Exception):  # noqa: N818 - an outcome, no error
    """A function that is not written yet; Jupyter shows it as one sentence."""

    def _render_traceback_(self) -> list[str]:
        return [str(self)]


class Wrong(Exception):  # noqa: N818 - an outcome, no error
    """A property that does not hold; the text says where."""


class Broken(Wrong):
    """A function that raises or returns no numbers of the right shape: further checks would say the same."""


def _graph(edges: str, priors: str = "0 0 .01") -> Any:
    """Build a graph from "tail>head measurement variance,..." and "pose mean variance,..."."""
    e = np.array([row.replace(">", " ").split() for row in edges.split(",")], dtype=float)
    p = np.array([row.split() for row in priors.split(",")], dtype=float)
    return PoseGraph(int(e[:, :2].max()) + 1, e[:, :2].astype(int), *e[:, 2:].T, p[:, 0].astype(int), *p[:, 1:].T)


WORKED = _graph("0>1 1.1 .01,1>2 1 .01,2>3 1.1 .01,3>4 -2.7 .01,0>4 0 .01", "0 0 .001")
# The public graphs, each with a state that is not dead reckoning. The last ones go to the ends of what is allowed.
PUBLIC: dict[str, tuple[list[float], Any]] = {
    "two poses": ([4, 6], _graph("0>1 1.5 .04", "0 3 .001")),
    "interior loop": ([0.5, 1, 3.25, 2, 4], _graph("0>1 1 .01,1>2 2 .02,2>3 -1 .05,3>4 1 .01,1>3 1.5 .02")),
    "backward edge": ([-1, 0.5, 2, 2.75], _graph("0>1 1 .02,2>1 -1.2 .01,2>3 .5 .04,3>0 -2.9 .05")),
    "shuffled and doubled edges": ([1, 1.5, 3, 3.5], _graph("2>3 1 .05,0>2 2.4 .04,0>1 1 .01,1>2 1 .02,0>1 1.3 .03")),
    "two priors": ([2, 2.25, 4.5, 3], _graph("0>1 1 .02,1>2 2 .01,2>3 -1 .02,1>3 1.5 .01", "2 4 .05,0 1.5 .02")),
    "unequal variances": ([-1.5, 0.25, 1.125, 1.8765432], _graph("0>1 1 .004,1>2 1 .3,2>3 1 2,0>3 2.2 .05", "0 -1 .6")),
    "two parts": ([0.2, 1.5, 5.1, 7.5], _graph("0>1 1 .01,2>3 2 .02", "2 5 .04,0 0 .01,2 5.5 .02")),
    "far away": ([-81.3, 19.7, 93.1], _graph("0>1 149.3 4,1>2 -61.7 9,0>2 90.1 2.5", "0 -60.3 5")),
    "one sure factor": ([7.3, 8.1, 9.7], _graph("0>1 1.1 .00001,1>2 1.3 2,0>2 2.7 1.5", "0 7 .8")),
    "nearly there": ([3.00004, 4.50009], _graph("0>1 1.5 .04", "0 3 .001")),
}


class Student:
    """The functions under test, and the problems to test them on."""

    def __init__(self, namespace: dict[str, Any]) -> None:
        self.namespace, self.where = namespace, ""
        self.called: set[str] = set()
        file = namespace.get("__name__") == "slam1d"
        self.again = "save it, check again" if file else "run its cell, then run this one again"

    def problems(self) -> Iterator[tuple[str, Any, np.ndarray]]:
        """Yield name, graph and state: the worked example, the public graphs, your own."""
        yield "the worked example", WORKED, WORKED.dead_reckoning()
        for name, (x, graph) in PUBLIC.items():
            yield f"the public graph '{name}'", graph, np.array(x, dtype=float)
        own, start = self.namespace.get("my_graph"), self.namespace.get("my_start")
        if isinstance(own, PoseGraph) and start is not None:
            yield "my_graph", own, np.array(start, dtype=float)

    def call(self, name: str, shapes: Sequence[tuple[int, ...]], *arguments: Any) -> list[np.ndarray]:
        """Call one function on copies and hold what it returns to the promised shapes."""
        function = self.namespace.get(name)
        if function is None:
            raise Unfinished(f"{name} is not defined: write it, {self.again}.")
        self.called.add(name)
        copies = [a.copy() if isinstance(a, np.ndarray) else a for a in arguments]
        try:
            returned = function(*copies)
        except NotImplementedError:
            raise Unfinished(f"{name} is not finished yet: write it, {self.again}.") from None
        except (Exception, SystemExit) as error:  # noqa: BLE001 - a student's code may raise anything
            raise Broken(f"{name} raised {type(error).__name__}: {error}{_line(error)}") from None
        if not all(np.array_equal(a, b) for a, b in zip(copies, arguments) if isinstance(a, np.ndarray)):
            raise Broken(f"{name} changes its argument in place; work on a copy: x = x + ..., not x += ...")
        parts = [returned] if len(shapes) == 1 else returned
        if len(shapes) > 1 and not (isinstance(parts, (tuple, list)) and len(parts) == len(shapes)):
            raise _no_array(f"{name} returned", returned, f"a tuple of {len(shapes)} arrays")
        names = [part + name for part in PARTS.get(name, ("",))]
        return [_array(what, part, shape) for what, part, shape in zip(names, parts, shapes)]

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
        return self.call("normal_equations", [2 * J.shape[1:], J.shape[1:]], J, omega, f)

    def step(self, x: np.ndarray, graph: Any) -> np.ndarray:
        """Return dx."""
        return self.call("gauss_newton_step", [(graph.n_poses,)], x, graph)[0]

    def cost(self, x: np.ndarray, graph: Any) -> float:
        """Return F(x), the sum of squared residuals, each divided by its variance."""
        f = self.residual(x, graph)
        return float(sum(f * f / np.append(graph.edge_variances, graph.prior_variances)))


def _line(error: BaseException) -> str:
    frames = [f for f in traceback.extract_tb(error.__traceback__) if f.filename != check.__code__.co_filename]
    own = [f for f in frames if "site-packages" not in f.filename and f.line]
    return f" (line {own[-1].lineno}: {own[-1].line})" if own else ""


def _no_array(begin: str, value: Any, wanted: str) -> Broken:
    came = "None" if value is None else type(value).__name__
    return Broken(f"{begin} {came}, expected {wanted}.{' Is `return` missing?' if value is None else ''}")


def _array(name: str, value: Any, shape: tuple[int, ...], verb: str = "returned") -> np.ndarray:
    try:
        if isinstance(value, np.ma.MaskedArray):
            raise Broken(f"{name} {verb} a masked array, expected a plain one: use an np.array of numbers.")
        array = np.asarray(value)
        if array.dtype.kind == "c":
            raise Broken(f"{name} {verb} complex numbers, expected real ones.")
        if value is None or array.dtype.kind == "U":
            raise TypeError
        array = array.astype(float)
    except (TypeError, ValueError):
        raise _no_array(f"{name} {verb}", value, f"an array of shape {shape}") from None
    if len(shape) == 1 and array.shape in ((shape[0], 1), (1, shape[0])):
        array = array.ravel()
    if array.shape != shape:
        raise Broken(f"{name} {verb} shape {array.shape}, expected {shape}.")
    if not np.isfinite(array).all():
        raise Broken(f"{name} {verb} {'nan' if np.isnan(array).any() else 'inf'}, expected finite numbers.")
    return array


def number(value: float, digits: int = 6) -> str:
    """Print a number short, and -0. and the dust of rounding as 0."""
    value = value if abs(value) >= 1e-14 else 0
    return f"{value + 0:.0f}" if abs(value) < 1e7 and float(value).is_integer() else f"{value:.{digits}g}"


def vector(values: np.ndarray, digits: int = 6) -> str:
    """Print numbers in square brackets; a long vector is cut unless digits count, and rounding noise is 0."""
    noise = 1e-12 * np.abs(values).max(initial=0.0)
    shown = [number(v if abs(v) > noise else 0, digits) for v in values.ravel().tolist()]
    return "[" + " ".join(shown if len(shown) <= 8 or digits > 6 else [*shown[:4], "...", *shown[-2:]]) + "]"


def unlike(got: Any, expected: Any, digits: int = 6) -> str:
    """Print what came and what was expected, with as many digits as it takes to tell them apart."""
    texts = [vector(value, digits) if np.ndim(value) else number(value, digits) for value in (got, expected)]
    if texts[0] == texts[1] and digits < 17:
        return unlike(got, expected, digits + 1)
    return f"got {texts[0]}, expected {texts[1]}"


def factor(graph: Any, row: int) -> str:
    """Name the factor that a row belongs to."""
    names = [f"edge {i} -> {j}" for i, j in graph.edges.tolist()]
    names += [f"prior on pose {pose}" for pose in graph.priors.tolist()]
    return f"row {row} ({names[row]})"


def _same_rows(graph: Any, what: str, got: np.ndarray, expected: np.ndarray, tolerance: Any = 1e-9) -> None:
    far = np.abs(got - expected) > tolerance * (1 + np.abs(expected))
    wrong = np.flatnonzero(far.reshape(len(got), -1).any(axis=1))
    if wrong.size:
        row, unit = int(wrong[0]), " [m]" if what.startswith("f") else ""
        raise Wrong(f"{factor(graph, row)} of {what}: {unlike(got[row], expected[row])}{unit}.")


# --- residual
def published(s: Student, graph: Any, x: np.ndarray) -> None:
    """In the worked example only the loop closure disagrees, by 0.5 m."""
    if graph is WORKED:
        _same_rows(graph, "f", s.residual(x, graph), np.array([0, 0, 0, 0, -0.5, 0]))


def moved_together(s: Student, graph: Any, x: np.ndarray) -> None:
    """When all poses move by 1/3 m, edge rows stay and prior rows grow by 1/3."""
    expected = s.residual(x, graph) + (np.arange(graph.n_factors) >= len(graph.edges)) / 3
    _same_rows(graph, "f after the move", s.residual(x + 1 / 3, graph), expected)


def fits(s: Student, graph: Any, x: np.ndarray) -> None:
    """Where every measurement and every prior agrees with x, f is 0."""
    agreed = replace(graph, measurements=x[graph.edges] @ [-1, 1], prior_means=x[graph.priors])
    _same_rows(graph, "f where all agrees", s.residual(x, agreed), np.zeros(graph.n_factors))


def one_longer(s: Student, graph: Any, x: np.ndarray) -> None:
    """A longer measurement raises only its own row, a larger mean lowers its own."""
    f, k = s.residual(x, graph), len(graph.edges)
    for row in range(graph.n_factors):
        bump = (np.arange(graph.n_factors) == row) / 3  # has digits without end, so a rounded f shows
        changed = replace(graph, measurements=graph.measurements + bump[:k], prior_means=graph.prior_means + bump[k:])
        _same_rows(graph, "f", s.residual(x, changed), f + bump if row < k else f - bump)


# --- jacobian
def derivative(s: Student, graph: Any, x: np.ndarray) -> None:
    """J is the derivative of your residual: move a pose, see how f answers."""
    columns = [2 * (s.residual(x + move, graph) - s.residual(x - move, graph)) for move in 0.25 * np.eye(len(x))]
    _same_rows(graph, "J", s.jacobian(x, graph), np.array(columns).T, 1e-6)


def row_sums(s: Student, graph: Any, x: np.ndarray) -> None:
    """Every edge row of J adds up to 0, every prior row to 1."""
    sums = s.jacobian(x, graph).sum(axis=1)
    _same_rows(graph, "J, added up", sums, 1.0 * (np.arange(graph.n_factors) >= len(graph.edges)), 1e-6)


# --- information matrix
def weights(s: Student, graph: Any, x: np.ndarray) -> None:
    """Every weight times its variance is 1."""
    variances, given = np.append(graph.edge_variances, graph.prior_variances), np.diag(s.omega(graph))
    hint = " (the variances themselves stand on the diagonal)" if np.allclose(given, variances) else ""
    allowed = 6e-10 + 6e-13 / variances  # a guard of 1e-12 m^2 against dividing by 0 costs nothing
    _same_rows(graph, f"weight x variance{hint}", given * variances, np.ones(len(variances)), allowed)


def independent(s: Student, graph: Any, x: np.ndarray) -> None:
    """Off the diagonal Omega is 0: the measurements are independent."""
    omega = s.omega(graph)
    _same_rows(graph, "Omega without its diagonal", omega - np.diag(np.diag(omega)), np.zeros(omega.shape))


# --- normal equations, also of three systems that belong to no graph: J, the diagonal of Omega, f.
SYSTEMS = [
    ([[1, 2], [0, 1], [3, -1]], [3, 7, 11], [1, -2, 5]),
    ([[1.5, -2, 0], [0, 1, 3], [4, 0.5, 1], [1, 1, -1]], [0.2, 30, 13, 7], [1, 0.25, -3, 2]),
    ([[2, 0, 1], [0, -1, 0], [1, 0, 3], [0, 4, 1], [1, 1, 1]], [5, 0.5, 100, 2, 9], [0.1, 2, -1, 0.5, 3]),
    ([[1, 0], [-1, 1], [0, 1]], [0.02, 0.005, 0.001], [120, -80, 60]),
    ([[1, 0], [-1, 1], [0, 1]], [9000, 1, 20000], [0.1, -0.2, 0.3]),
]


def half_derivatives(cost: Callable[..., Any], tolerance: float, H: np.ndarray, b: np.ndarray) -> None:
    """Compare H and b with differences of a quadratic cost, which are exact for any width."""
    if np.abs(H - H.T).max() > 1e-9 * np.abs(H).max():
        raise Wrong("H must be symmetric, and yours is not.")
    units = 0.5 * np.eye(len(b))
    gradient = np.array([cost(p) - cost(-p) for p in units])
    hessian = [[cost(p + q) - cost(p - q) - cost(q - p) + cost(-p - q) for q in units] for p in units]
    sizes = np.sqrt(np.abs(np.diag(H)) * (1 + abs(cost(0 * b))))
    for name, got, whole, size in (("H", H, np.array(hessian), np.abs(H).max()), ("b", b, gradient, sizes)):
        half, kind = 0.5 * whole, "second derivative" if name == "H" else "derivative"
        wrong = np.argwhere(np.abs(got - half) > tolerance * (1 + np.abs(half) + size))
        if len(wrong):
            at = tuple(wrong[0])
            guess = " (the sign?)" if np.allclose(got, -half) else " (a factor 2?)" if np.allclose(got, whole) else ""
            raise Wrong(f"{name}{wrong[0].tolist()}: {unlike(got[at], half[at])}, half the {kind} of the cost{guess}.")


def any_system(s: Student, graph: Any, x: np.ndarray) -> None:
    """H is half the Hessian, b half the gradient, for any J, Omega, f."""
    if graph is WORKED:
        for system in SYSTEMS:
            J, w, f = (np.array(part, dtype=float) for part in system)
            s.where = "with J = {}, omega = np.diag({}), f = {}".format(*system)
            half_derivatives(lambda d, J=J, w=w, f=f: sum(w * (f + J @ d) ** 2), 1e-9, *s.normal(J, np.diag(w), f))


def own_system(s: Student, graph: Any, x: np.ndarray) -> None:
    """H is half the Hessian of your own F, b half its gradient."""
    H, b = s.normal(s.jacobian(x, graph), s.omega(graph), s.residual(x, graph))
    half_derivatives(lambda d: s.cost(x + d, graph), 1e-7, H, b)


# --- step
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
    if after > before * (1 - 1e-9):  # no state here is the best one
        raise Wrong(f"the cost was {number(before)}, and after the step it is {number(after)}.")


def again(s: Student, graph: Any, x: np.ndarray) -> None:
    """Taken again from x + dx, and from another start, the step is right as well."""
    point = x + s.step(x, graph)
    size = 1e-7 * (10 + np.abs(x).max() + np.abs(point).max())
    second = s.step(point, graph)
    if np.abs(second).max() > size:
        raise Wrong(f"after one step to {vector(point)}, the second step is {vector(second)}: does it solve H dx = -b?")
    other = np.linspace(3, -2, len(x))
    there = other + s.step(other, graph)
    if np.abs(there - point).max() > size:
        raise Wrong(f"x + dx(x) depends on the start: {vector(point)}, but {vector(there)} from {vector(other)}.")


def data_matter(s: Student, graph: Any, x: np.ndarray) -> None:
    """Where the step leads depends on every measurement."""
    point = x + s.step(x, graph)
    for row in range(len(graph.edges)):
        changed = replace(graph, measurements=graph.measurements + (np.arange(len(graph.edges)) == row))
        if np.abs(x + s.step(x, changed) - point).max() < 1e-6:
            raise Wrong(f"x + dx(x) stays {vector(point)} when the measurement of {factor(graph, row)} grows by 1 m.")


# --- answers and bonus
def follow(s: Student, graph: Any, x: np.ndarray) -> None:
    """Row 0 of iterates is the start, each further row the last plus your step."""
    if not s.where.startswith("on my_graph"):
        return
    given = s.namespace.get("iterates")
    if given is None:
        raise Unfinished("iterates is still None: fill it with x^(0) to x^(3), one row each.")
    rows = _array("iterates", given, (4, len(x)), "has")
    wanted, why = graph.dead_reckoning(), "it is not dead reckoning; run the cell of my_start again"
    if (rows == rows[3]).all():
        why += "; all rows are one state: x += ... changes the array that is in the list, x = x + ... does not"
    for index, row in enumerate(rows):
        if np.abs(row - wanted).max() > 1e-6 * (1 + np.abs(wanted).max()):
            raise Wrong(f"row {index} of iterates, x^({index}), is {vector(row)}: {why}.")
        wanted, why = row + s.step(row, graph), f"it is not row {index} plus your step from there"


def patterns(s: Student, graph: Any, x: np.ndarray) -> None:
    """The masks are where your own J and H are not 0."""
    masks = s.call("sparsity_pattern", [(graph.n_factors, len(x)), (len(x), len(x))], graph)  # first: it may be open
    J = s.jacobian(x, graph)
    H, _ = s.normal(J, s.omega(graph), s.residual(x, graph))
    for what, got, full in zip(("J_mask", "H_mask"), masks, (J, H)):
        wrong = np.argwhere((got != 0) != (np.abs(full) > 1e-9 * np.abs(full).max()))
        if len(wrong):
            i, j = wrong[0].tolist()
            state = "is always 0 and is marked" if got[i, j] else "can differ from 0 and is not marked"
            raise Wrong(f"{what}[{i}, {j}]: this entry {state}.")


def ranges(s: Student, graph: Any, x: np.ndarray) -> None:
    """A longer range lowers its own row of f, and J is the derivative of f."""
    if graph is not WORKED:
        return
    longer, poses = np.array([0, 0.25, 0.5]), np.array([3, 0, 3])
    s.where = f"at x = {vector(x)}, with a beacon at (2, 1) and ranges from poses 3, 0 and 3"
    ranging = Ranging(np.array([2, 1]), poses, np.hypot(x[poses] - 2, 1) + longer, np.full(3, 0.01))
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
    "second_step": (again, data_matter),
    "iterates": (follow,),
    "sparsity_pattern": (patterns,),
    "range_factor": (ranges,),
}
BONUS = ("sparsity_pattern", "range_factor")


# Three of growing detail for each stage, and none of them the line.
HINTS = {
    "residual": """
    * Every factor has one row: the edges first, in the given order, then the priors. What has each of them to
      say?
    * The row of an edge is where the edge puts pose j, minus where the state puts it. The row of a prior is
      where the state puts pose i, minus the mean.
    * graph.edges[:, 0] holds the tails of all edges; x indexed with such an array gives all their places at
      once. Do the same for the heads, and for graph.priors; np.concatenate joins edges and priors.
    """,
    "jacobian": """
    * Take one factor and one pose: by how much does the row change when this pose moves by 1 m and no other
      does?
    * An edge row feels two poses, with opposite signs, a prior row one. Read the signs off the formula of f.
    * Begin with np.zeros((m, n)). Rows r = 0, 1, ... go with graph.edges; the tail's column and the head's get
      one number each, whatever x is. The rows of the priors follow those of the edges.
    """,
    "information_matrix": """
    * A weight says how sure a measurement is: what is sure has a small variance and a large weight.
    * The measurements are independent, so the covariance is diagonal. What is the inverse of a diagonal matrix?
    * Put the variances of edges and priors into one vector, in the order of the rows of f; turn each into a
      weight; np.diag makes a matrix of a vector.
    """,
    "normal_equations": """
    * Both are products of what is given. Write the shapes beside the formulas: which factors fit together?
    * The transpose of J comes first in both, Omega stands between: (n, m) (m, m) (m, n) for H, (n, m) (m, m)
      (m,) for b.
    * In numpy @ is the product of matrices, * goes entry by entry, and .T transposes. The sign of b is decided
      later, where the system is solved. Return both, H first.
    """,
    "gauss_newton_step": """
    * Everything is there: your four functions, called one after the other at this x, and one linear system.
    * The gradient 2 b + 2 H dx is to be zero. Solve for dx, and mind the sign of the right side.
    * No inverse is needed: np.linalg has a function that takes a matrix and a right side and solves. Return dx
      alone, not x + dx, and leave the x that you were given as it is.
    """,
    "second_step": """
    * Nothing more is to be written here: your step is called again from where it led.
    * Put x + dx back into your step by hand, on my_graph, and print b there. What should the gradient be at a
      minimum?
    * Each call must use its own x and graph: nothing stored from an earlier call, no damping, no typed-in
      numbers, and H and b made of the same J and Omega.
    """,
    "iterates": """
    * Four states, one a row: the start, and what comes after each of three steps.
    * A loop of three turns: from the last state, take a step, keep the new state. Each turn begins where the
      last ended.
    * Collect the states in a list that begins with my_start, and make one array of it in the end; make a new
      array for every state, because x += ... changes the one that is in the list.
    """,
    "sparsity_pattern": """
    * Which poses does a factor touch? Only the lists graph.edges and graph.priors are needed.
    * J has an entry where a factor touches a pose; H has one where two poses meet in a factor, and on the
      diagonal.
    * Begin with two arrays of False of the right shapes. For every edge mark two places in J and four in H, for
      every prior one in each.
    """,
    "range_factor": """
    * The pose x_k stands at (x_k, 0), the beacon beside the line: draw the triangle.
    * The distance is the longest side, by Pythagoras. As in an edge, the prediction comes first and the
      measurement is taken away.
    * For J use the chain rule: how does a square root change, and what is inside it? The result lies between -1
      and 1, and stands in the column of the pose.
    """,
}
_given: dict[str, int] = {}


def hint(stage: str, number: int = 0) -> None:
    """Print a hint for a stage: the first, at the next call the second, then the third; or the one of this number."""
    if stage not in HINTS:
        _say(f"There are hints for {', '.join(HINTS)}, none for {stage!r:.40}.")
        return
    texts = HINTS[stage].split("\n    * ")[1:]
    _given[stage] = number if 1 <= number <= len(texts) else _given.get(stage, 0) % len(texts) + 1
    _say(f"Hint {_given[stage]} of {len(texts)} for {stage}: {' '.join(texts[_given[stage] - 1].split())}")


def failures(stage: str, namespace: dict[str, Any]) -> list[tuple[str, str]]:
    """List the checks of a stage, up to one that cannot run, with what is wrong or ""; raises Unfinished."""
    student, found = Student(namespace), []
    if stage == "iterates" and not isinstance(namespace.get("my_graph"), PoseGraph):
        raise Unfinished(f"my_graph is not defined: {student.again}.")
    for prove in STAGES[stage]:
        student.called, text = set(), ""
        for name, graph, x in student.problems():
            student.where = f"on {name} at x = {vector(x)}"
            try:
                prove(student, graph, x)
            except Wrong as error:
                text, broken = f"{student.where}: {error}{_blame(stage, student)}", isinstance(error, Broken)
                break
        found.append(((prove.__doc__ or "").strip(), text))
        if text and broken:
            break
    return found


def _blame(stage: str, student: Student) -> str:
    """Name the first function that this stage builds on and that fails its own check."""
    for name in list(STAGES)[: list(STAGES).index(stage)]:
        if name in student.called or (name in student.namespace and "gauss_newton_step" in student.called):
            with suppress(Unfinished):
                if any(wrong for _, wrong in failures(name, student.namespace)):
                    return f" But {name} fails its own check: repair that first."
    return ""


def _say(text: str, indent: str = "") -> None:
    """Print a long text in lines that fit a page."""
    print(textwrap.fill(text, 90, initial_indent=indent, subsequent_indent=" " * 6, break_on_hyphens=False))


def check(stage: str, namespace: dict[str, Any]) -> None:
    """Print PASS or FAIL for every check of a stage in STAGES; `namespace` holds your functions: `globals()`."""
    if _told(stage, namespace):
        print("      Mend this before you go on: the cells below build on it.")


def _told(stage: str, namespace: dict[str, Any]) -> bool:
    timer = threading.Timer(PATIENCE, print, [f"...   {stage} still runs: does every loop end? Interrupt it to see."])
    timer.start()
    try:
        found = failures(stage, namespace)
    finally:
        timer.cancel()
    for line, wrong in found:
        print(f"{'FAIL' if wrong else 'PASS'}  {stage}: {line}")
        if wrong:
            _say(wrong, " " * 6)
    if len(found) < len(STAGES[stage]):
        print("      The other checks were not run.")
    for name in PUBLIC:
        if any(f"graph '{name}'" in wrong for _, wrong in found):
            print(f"      Its factors: import self_check; print(self_check.PUBLIC['{name}'][1])")
    return any(wrong for _, wrong in found)


def foreign(namespace: dict[str, Any]) -> list[str]:
    """Name the modules that are imported, or from which something is, and that are not allowed when graded."""
    found = {str(getattr(v, "__name__" if isinstance(v, ModuleType) else "__module__", "")) for v in namespace.values()}
    roots = {name.partition(".")[0] for name in found - {"", "None", "__main__", namespace.get("__name__")}}
    known = {*ALLOWED.split(), PoseGraph.__module__.partition(".")[0]}
    return sorted(root for root in roots - known if root in sys.modules and not root.startswith(("_", "ipykernel")))


def check_all(namespace: dict[str, Any]) -> None:
    """Check every stage, say what is open, and end with what cannot be seen here."""
    for name in foreign(namespace):
        _say(f"NOTE  {name} is imported and is not allowed when graded: a function that uses it earns nothing.")
    for stage in STAGES:
        try:
            _told(stage, namespace)
        except Unfinished as unfinished:
            if stage not in BONUS:
                _say(f"TODO  {stage}: {unfinished}".replace(f": {stage} is ", ": "))
    for name in ("conclusion", "written_2", "written_3"):
        given = namespace.get(name, "A")
        if given is None:
            print(f"TODO  {name}: it is still None.")
        elif not isinstance(given, str) or (name == "conclusion" and given.strip().upper() not in list("ABCDEF")):
            wanted = 'one letter, for example "A"' if name == "conclusion" else "a text"
            _say(f"FAIL  {name}: got {given!r:.60}, expected {wanted}.")
    print(UNSEEN)


if __name__ == "__main__":
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("slam1d.py")
    if file.suffix == ".ipynb":
        sys.exit("This checks modules; in the notebook, run its last cell, check_all(globals()).")
    print(f"Checking {file.name} (working in the notebook? Run its last cell, check_all, instead).", flush=True)
    work: dict[str, Any] = {"__name__": "slam1d"}
    try:
        exec(compile(file.read_bytes(), str(file), "exec", dont_inherit=True), work)
    except (Exception, SystemExit) as error:  # noqa: BLE001 - a student's code may raise anything
        at = [f", line {f.lineno}" for f in traceback.extract_tb(error.__traceback__) if f.filename == str(file)]
        sys.exit(f"{file.name}{(*at, '')[0]}: {type(error).__name__}: {error}")
    check_all(work)

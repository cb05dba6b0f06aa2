"""Stubs: each function of the reference with its name, arguments and docstring, and nothing else.

A stub is made by keeping these three, never by cutting a body out: no line of a solution can leak.
"""

from __future__ import annotations

import ast
import textwrap
from collections.abc import Sequence
from functools import cache
from importlib import resources

import numpy as np

from assignment.posegraph import PoseGraph
from autograder.problems.problem import Problem
from autograder.render.template import fill

__all__ = ["CORE", "graph_source", "reference_source", "start_source", "stub_module", "stubs"]

CORE = ("residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step")


@cache
def reference_source() -> str:
    """Read the text of the reference solution."""
    return resources.files("reference_solution").joinpath("slam1d.py").read_text(encoding="utf-8")


@cache
def stubs(source: str) -> dict[str, str]:
    r"""Derive a stub for every public function of a module, in its order.

    Parameters
    ----------
    source : str
        Text of the module; it is parsed, never run.

    Returns
    -------
    dict
        Name of the function -> text of the stub.

    Examples
    --------
    >>> source = "def double(x: float) -> float:\n    'Return twice x.'\n    return x + x\n"
    >>> stubs(source)["double"].splitlines()[0]
    'def double(x: float) -> float:'
    """
    public = (node for node in ast.parse(source).body if isinstance(node, ast.FunctionDef) and node.name[0] != "_")
    return {node.name: _stub(node) for node in public}


def _stub(node: ast.FunctionDef) -> str:
    if node.args.defaults or any(default is not None for default in node.args.kw_defaults):
        raise ValueError(f"{node.name} must have no default values: they would be copied into the stub")
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    body = [
        _docstring(ast.get_docstring(node)),
        f'raise NotImplementedError("{node.name} is not finished yet: replace this line by your code.")',
    ]
    return f"def {node.name}({ast.unparse(node.args)}){returns}:\n" + textwrap.indent(
        "\n".join(filter(None, body)), "    "
    )


def _docstring(text: str | None) -> str:
    if text is None:
        return ""
    prefix = "r" if "\\" in text else ""
    return f'{prefix}"""{text}\n"""' if "\n" in text else f'{prefix}"""{text}"""'


def graph_source(graph: PoseGraph) -> str:
    """Write a graph as the Python expression that builds it, one field a line.

    Examples
    --------
    >>> print(graph_source(PoseGraph(2, [(0, 1)], [1.5], [0.04], [0], [3.0], [0.001])))
    PoseGraph(
        n_poses=2,
        edges=np.array([(0, 1)]),
        measurements=np.array([1.5]),
        edge_variances=np.array([0.04]),
        priors=np.array([0]),
        prior_means=np.array([3.0]),
        prior_variances=np.array([0.001]),
    )
    """
    pairs = [(int(i), int(j)) for i, j in graph.edges]
    rest = ("measurements", "edge_variances", "priors", "prior_means", "prior_variances")
    lines = [f"n_poses={graph.n_poses},", f"edges=np.array({pairs}),"]
    lines += [f"{name}=np.array({getattr(graph, name).tolist()})," for name in rest]
    return "PoseGraph(\n" + textwrap.indent("\n".join(lines), "    ") + "\n)"


def start_source(start: np.ndarray) -> str:
    """Write a state as the Python expression that builds it.

    Examples
    --------
    >>> start_source(np.array([0.0, 1.1]))
    'np.array([0.0, 1.1])'
    """
    return f"np.array({start.tolist()})"


def stub_module(problem: Problem, names: Sequence[str] | None = None) -> str:
    """Render slam1d.py for one problem: imports, the student's numbers, the stubs, the open answers."""
    all_stubs = stubs(reference_source())
    chosen = list(all_stubs.values()) if names is None else [all_stubs[name] for name in names]
    imported = [name for name in ("PoseGraph", "Ranging") if any(f": {name}" in stub for stub in chosen)]
    return fill(
        "slam1d.py.j2",
        graph=graph_source(problem.graph),
        start=start_source(problem.start),
        stubs=chosen,
        imported=", ".join(imported),
    )

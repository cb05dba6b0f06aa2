"""Everything that one student is handed, as texts by file name."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from autograder.problems.problem import Problem
from autograder.render import figure
from autograder.render.notebook import render_notebook
from autograder.render.stub import CORE, graph_source, reference_source, start_source, stub_module, stubs
from autograder.render.template import fill

__all__ = ["PROVIDED", "render_assignment", "render_folder", "write_files"]

PROVIDED = ("posegraph.py", "self_check.py")


def render_assignment(problem: Problem) -> dict[str, str]:
    """Render the files that depend on the problem.

    Returns
    -------
    dict
        File name -> text.
    """
    all_stubs = stubs(reference_source())
    values = {
        "graph": graph_source(problem.graph),
        "start": start_source(problem.start),
        "stubs": {name: all_stubs[name] for name in CORE},
    }
    return {
        "slam1d.py": stub_module(problem),
        "slam1d.ipynb": render_notebook("slam1d.ipynb.j2", **values),
        "README.md": fill("README.md.j2", **values),
        "pose_graph.svg": picture(problem),
    }


def picture(problem: Problem) -> str:
    """Draw the pose graph of a problem."""
    graph = problem.graph
    edges = [(i, j, u) for (i, j), u in zip(graph.edges.tolist(), graph.measurements.tolist(), strict=True)]
    priors = list(zip(graph.priors.tolist(), graph.prior_means.tolist(), strict=True))
    return figure.pose_graph(graph.n_poses, edges, priors)


def render_folder(problem: Problem) -> dict[str, str]:
    """Render a complete folder for a student: the rendered files and the provided ones."""
    assignment = resources.files("assignment")
    provided = {name: assignment.joinpath(name).read_text(encoding="utf-8") for name in PROVIDED}
    return {**provided, **render_assignment(problem)}


def write_files(files: dict[str, str], folder: Path) -> list[str]:
    """Write texts into a folder; return the names of those that changed."""
    folder.mkdir(parents=True, exist_ok=True)
    changed = []
    for name, text in files.items():
        data = text.encode("utf-8")
        path = folder / name
        if not path.exists() or path.read_bytes() != data:
            path.write_bytes(data)
            changed.append(name)
    return changed

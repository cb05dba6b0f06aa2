"""Everything that one student is handed, as texts by file name."""

from __future__ import annotations

import inspect
import json
import textwrap
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from autograder.problems.problem import Problem
from autograder.render import figure, landmarks
from autograder.render.grading import Grading
from autograder.render.notebook import render_notebook
from autograder.render.page import printable
from autograder.render.stub import reference_source, stub_module, stubs
from autograder.render.template import fill
from autograder.render.values import values

__all__ = ["PROVIDED", "render_assignment", "render_folder", "write_files"]

PROVIDED = ("posegraph.py", "self_check.py")


def render_assignment(problem: Problem, grading: Grading | None = None) -> dict[str, str]:
    """Render the files that depend on the problem, and the pictures of the handout.

    Parameters
    ----------
    problem : Problem
        The numbers of the student.
    grading : Grading, optional
        Title, points and due date of the course; without it the defaults hold.

    Returns
    -------
    dict
        File name -> text.
    """
    words = values(problem, grading)
    pictures = _pictures(problem)
    notebooks = {**words, **_carried()}
    told = {f"{name.removesuffix('.svg')}_text": alternative(picture) for name, picture in pictures.items()}
    handout = fill("README.md.j2", **words, **told)
    return {
        "slam1d.py": stub_module(problem),
        "slam1d.ipynb": render_notebook("slam1d.ipynb.j2", {"slam1d": {"variant": problem.variant}}, **notebooks),
        "explore.ipynb": render_notebook("explore.ipynb.j2", **notebooks),
        "README.md": handout,
        "handout.html": printable(handout, pictures),
        **pictures,
    }


def render_folder(problem: Problem, grading: Grading | None = None) -> dict[str, str]:
    """Render a complete folder for a student: the rendered files and the provided ones."""
    return {**{name: provided(name) for name in PROVIDED}, **render_assignment(problem, grading)}


@cache
def provided(name: str) -> str:
    """Read a hand-written file of the assignment."""
    return resources.files("assignment").joinpath(name).read_text(encoding="utf-8")


def in_words() -> str:
    """Write what is to be seen in the pictures of the corridor as Python, in lines that are not cut off."""
    texts = {"J_IN_WORDS": landmarks.J_IN_WORDS, "H_IN_WORDS": landmarks.H_IN_WORDS}
    lines = [(name, textwrap.wrap(text, 90, drop_whitespace=False)) for name, text in texts.items()]
    return "\n".join(
        f"{name} = (\n" + "".join(f"    {part!r}\n".replace("'", '"') for part in parts) + ")" for name, parts in lines
    )


@cache
def _carried() -> dict[str, Any]:
    """Texts that the notebooks carry along, so that they work alone."""
    return {
        "posegraph": provided("posegraph.py"),
        "self_check": provided("self_check.py").partition('\n\nif __name__ == "__main__"')[0] + "\n",
        "figure": inspect.getsource(figure),
        "corridor_picture": inspect.getsource(landmarks.picture),
        "corridor": inspect.getsource(landmarks.corridor),
        "corridor_words": in_words(),
        "fill_in": inspect.getsource(landmarks.fill_in),
        "stubs": stubs(reference_source()),
    }


def _pictures(problem: Problem) -> dict[str, str]:
    graph = problem.graph
    edges = [(i, j, u) for (i, j), u in zip(graph.edges.tolist(), graph.measurements.tolist(), strict=True)]
    priors = list(zip(graph.priors.tolist(), graph.prior_means.tolist(), strict=True))
    return {"pose_graph.svg": figure.pose_graph(graph.n_poses, edges, priors, problem.landmarks), **_general_pictures()}


@cache
def _general_pictures() -> dict[str, str]:
    """Draw what is the same for every problem."""
    J, H = landmarks.patterns(landmarks.corridor())
    times = json.loads(resources.files("reference_solution").joinpath("solve_times.json").read_text(encoding="utf-8"))
    return {
        "landmarks_graph.svg": landmarks.picture(landmarks.corridor()),
        "landmarks_J.svg": figure.spy(J, "J with landmarks", landmarks.J_IN_WORDS),
        "landmarks_H.svg": figure.spy(H, "H with landmarks", landmarks.H_IN_WORDS),
        "solve_times.svg": figure.curves("Time to solve H dx = -b", "poses", "time [s]", times, log_x=True),
    }


def alternative(picture: str) -> str:
    """Return the words of a picture for Markdown."""
    return figure.in_words(picture).replace("[", "(").replace("]", ")")  # brackets would end the text in Markdown


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

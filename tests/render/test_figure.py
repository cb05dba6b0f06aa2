"""Pictures are well-formed SVG that can be read aloud, without colour and without any library."""

import ast
import inspect
import re
from urllib.parse import unquote
from xml.etree import ElementTree

import numpy as np
import pytest

from autograder.problems.problem import worked_problem
from autograder.render import figure, landmarks
from autograder.render.handout import render_assignment

SVG = "{http://www.w3.org/2000/svg}"
PICTURES = {
    "pose graph": figure.pose_graph(4, [(0, 1, 1.0), (2, 1, -1.2), (0, 1, 1.3), (0, 3, 2.5)], [(0, 0.0), (2, 4.5)]),
    "spy": figure.spy([[1, 0, 0], [0, -2, 0.5]], "J <raw>"),
    "large spy": figure.spy([[int(r == c) for c in range(60)] for r in range(60)], "H"),
    "bars": figure.bars("Residuals [m]", ["row 0", "row 1"], [-0.5, 0.0], [0.1, 1e-18]),
    "curves": figure.curves("Steps", "step", "size [m]", {"one": [(1, 0.4), (2, 0.0)], "two": [(1, 0.4), (2, 7e-3)]}),
    "log curves": figure.curves("Times", "n", "t [s]", {"dense": [(30, 1e-5), (3000, 0.3)]}, log_x=True),
}


@pytest.mark.parametrize("name", list(PICTURES))
def test_a_picture_has_title_and_description(name):
    """A screen reader finds the role, a title and a description; the ground is painted."""
    root = ElementTree.fromstring(PICTURES[name])
    assert root.get("role") == "img"
    assert [child.tag for child in root][:3] == [f"{SVG}title", f"{SVG}desc", f"{SVG}rect"]
    assert all(root.find(f"{SVG}{tag}").text for tag in ("title", "desc"))


def test_the_description_tells_what_is_drawn():
    """The words hold every edge, every entry, every pair of values and every point."""
    words = {name: ElementTree.fromstring(text).find(f"{SVG}desc").text for name, text in PICTURES.items()}
    assert "edge 2 to 1 measured -1.2 m" in words["pose graph"]
    assert "prior on 2 with mean 4.5 m" in words["pose graph"]
    assert words["spy"] == "2 rows, 3 columns. Not 0 in row 0: columns 0 (+); row 1: columns 1 (−), 2 (+)."
    assert words["bars"] == "row 0: before -0.5, after 0.1; row 1: before 0, after 0."
    assert "two: 0.4 at 1, 0.007 at 2" in words["curves"]


def test_values_are_told_apart_without_colour():
    """Before is hollow and after filled; a second curve is dashed and has square marks."""
    assert 'fill="white"' in PICTURES["bars"]
    assert "stroke-dasharray" in PICTURES["curves"]
    assert "stroke-dasharray" not in PICTURES["log curves"]


def test_a_turned_matrix_has_another_picture():
    """Signs stand in the squares of a matrix with negative entries, and in none of a mask."""
    turned = [texts(figure.spy([[sign, 0], [0, -sign]], "J")) for sign in (1, -1)]
    assert [[text for text in found if text in ("+", "−")] for found in turned] == [["+", "−"], ["−", "+"]]
    assert not {"+", "−"} & {*texts(figure.spy([[1, 0], [0, 1]], "J_mask"))}
    assert figure.spy([[1, 0], [0, 1]], "J_mask").count("columns 0; row 1: columns 1.") == 1


def test_a_tall_matrix_has_no_hairs():
    """With hundreds of rows an entry is wider than it is high; with few it is a square."""
    for rows, ratio in ((500, 3.0), (6, 1.0)):
        picture = figure.spy([[int(r % 100 == c) for c in range(100 if rows > 100 else 5)] for r in range(rows)], "J")
        across, down = re.search(r'd="M[\d.]+ [\d.]+h([\d.]+)v([\d.]+)h', picture).groups()
        assert float(across) >= ratio * 0.9 * float(down)
        assert (f'fill="{figure.FILL}" stroke=' in picture) == (rows > 100)


def test_the_large_pictures_are_told_in_words():
    """What the words of the corridor say about J and H is so."""
    J, H = (np.array(matrix) for matrix in landmarks.patterns(landmarks.corridor()))
    n = landmarks.counts()["poses"]
    walk = landmarks.counts()["between"]
    assert all(np.flatnonzero(J[row]).tolist() == [row, row + 1] for row in range(walk))
    pose, mark = np.array([np.flatnonzero(row) for row in J[walk:-1]]).T
    assert np.all(np.diff(pose) >= 0)
    assert np.all((pose < n) & (mark >= n))
    assert np.flatnonzero(J[-1]).tolist() == [0]
    assert np.array_equal(H[:n, :n], np.triu(np.tril(np.ones((n, n)), 1), -1))
    assert np.array_equal(H[n:, n:], np.eye(len(H) - n))
    assert H[0, n] == 1
    assert H[n - 1, -1] == 1
    files = render_assignment(worked_problem())
    assert landmarks.J_IN_WORDS in files["landmarks_J.svg"]
    assert landmarks.H_IN_WORDS in files["README.md"]


def test_a_number_stands_on_the_side_of_its_bar():
    """The number of a negative bar ends left of it, the one of a positive bar begins right of it."""
    root = ElementTree.fromstring(figure.bars("f", ["a", "b"], [-0.5, 0.25], [-0.1, 0.1], ("start", "after one step")))
    numbers = {node.text: node for node in root.iter(f"{SVG}text") if re.fullmatch(r"-?0\.\d+", node.text)}
    axis = float(next(node.get("d") for node in root.iter(f"{SVG}path")).split()[0].lstrip("M"))
    for text, node in numbers.items():
        assert node.get("text-anchor") == ("end" if text[0] == "-" else "start")
        assert (float(node.get("x")) < axis) == (text[0] == "-")
    assert {"start", "after one step"} <= {node.text for node in root.iter(f"{SVG}text")}
    assert "a: start -0.5, after one step -0.1" in root.find(f"{SVG}desc").text


def test_no_decade_is_empty():
    """The axis of times begins at the decade of the smallest one; a line for 0 is added only where one is 0."""
    nearly = figure.curves("Times", "n", "t [s]", {"dense": [(30, 9.8e-6), (3000, 0.3)]}, log_x=True)
    for picture in (PICTURES["log curves"], nearly):
        found = [text for text in texts(picture) if text.startswith("1e")]
        assert found == ["1e-5", "1e-4", "1e-3", "1e-2", "1e-1", "1e0"]


def texts(picture):
    """Everything that is written in a picture, in its order."""
    return [node.text for node in ElementTree.fromstring(picture).iter(f"{SVG}text")]


def test_a_value_of_zero_stands_on_a_line_marked_0():
    """A logarithmic axis has no 0, so its bottom line is marked instead."""
    texts = [node.text for node in ElementTree.fromstring(PICTURES["curves"]).iter(f"{SVG}text")]
    assert "0" in texts
    assert "0" not in [node.text for node in ElementTree.fromstring(PICTURES["log curves"]).iter(f"{SVG}text")]


def test_names_are_escaped():
    """A name with a bracket does not break the picture."""
    assert "J &lt;raw&gt;" in PICTURES["spy"]


def test_the_file_can_travel():
    """The notebooks carry this file along: it parses as Python 3.9 and imports math and collections.abc only."""
    tree = ast.parse(inspect.getsource(figure), feature_version=(3, 9))
    imported = [node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    imported += [name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names]
    assert sorted(imported) == ["__future__", "collections.abc", "math"]
    assert "'''" not in inspect.getsource(figure)


@pytest.mark.parametrize("name", list(PICTURES))
def test_an_image_carries_picture_and_words(name):
    """Inside of an HTML image the picture is whole, and its alternative text is its title and description."""
    image = ElementTree.fromstring(figure.as_image(PICTURES[name]).replace('">', '"/>'))
    assert unquote(image.get("src")).partition(",")[2] == PICTURES[name]
    root = ElementTree.fromstring(PICTURES[name])
    words = f"{root.find(f'{SVG}title').text}. {root.find(f'{SVG}desc').text}"
    assert image.get("alt") == figure.in_words(PICTURES[name]) == words

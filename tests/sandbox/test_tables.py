"""Functions that answer from tables: right for what they list, the submission's own for everything else."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest

from autograder.sandbox.carried import Entry, Part
from autograder.sandbox.frames import Argument, Array, GraphData, Source, Table
from autograder.sandbox.host import Failure, Outputs
from tests.sandbox.conftest import GRAPH, batch

OTHER = GraphData(
    GRAPH.n_poses,
    GRAPH.edges,
    np.array([7.0, 8.0]).tobytes(),
    GRAPH.edge_variances,
    GRAPH.priors,
    GRAPH.prior_means,
    GRAPH.prior_variances,
)
LISTED = OTHER
FACTOR = np.array([[1.0, 0.0, 2.0], [0.0, 3.0, 0.0]])
CONSTANT = np.array([10.0, 20.0])
X = np.array([0.0, 1.0, 2.0])  # what the tests' calls are made with
ANSWER = np.array([14.0, 23.0])  # CONSTANT + FACTOR @ X, by hand
OWN = "def g(x, graph):\n    return [1.5, 2.5]\n"


def array(values: np.ndarray) -> Array:
    """Carry an array."""
    return Array(values.shape, values.astype("<f8").tobytes())


def table(shape: Literal["", "column", "row"] = "", kind: Literal["array", "list", "matrix"] = "array") -> Table:
    """Make the table of g(x, graph): a constant plus a factor times x, for the listed graph only."""
    return Table("g", [1], 0, [shape], kind, [Entry([LISTED], [Part(array(CONSTANT), array(FACTOR))])])


def asked(sandbox, text: str, tables: list[Table], graph: Argument = LISTED) -> Outputs | Failure:
    """Call f(x, graph) of a submission in which g answers from a table."""
    with sandbox.open(Source("module", [text], "student")) as session:
        session.load()
        assert session.replace(tables) is None
        return session.call(batch(arguments=(array(X), graph)))


CALLERS = {
    "by its name": "def f(x, graph):\n    return g(x, graph)\n",
    "by keywords": "def f(x, graph):\n    return g(graph=graph, x=x)\n",
    "by another name": "h = g\ndef f(x, graph):\n    return h(x, graph)\n",
    "from a default argument": "def f(x, graph, g=g):\n    return g(x, graph)\n",
    "from a dictionary": "parts = {'g': g}\ndef f(x, graph):\n    return parts['g'](x, graph)\n",
    "from a closure": "def made(h):\n    return lambda x, graph: h(x, graph)\nf = made(g)\n",
    "from a class": "class Solver:\n    g = staticmethod(g)\ndef f(x, graph):\n    return Solver.g(x, graph)\n",
    "by functools.partial": "import functools\nh = functools.partial(g)\ndef f(x, graph):\n    return h(x, graph)\n",
    "by its module": "import sys\ndef f(x, graph):\n    return sys.modules[__name__].g(x, graph)\n",
    "with a list": "def f(x, graph):\n    return g(x.tolist(), graph)\n",
    "with a column": "def f(x, graph):\n    return g(x[:, None], graph)[:, 0]\n",
    "with a copy of the graph": "import copy\ndef f(x, graph):\n    return g(x, copy.deepcopy(graph))\n",
}


@pytest.mark.parametrize("name", CALLERS)
def test_whoever_calls_a_function_gets_what_the_table_says(sandbox, name) -> None:
    """However the function is kept and called, its answer comes from the table."""
    found = asked(sandbox, f"import numpy as np\n{OWN}{CALLERS[name]}", [table()])
    assert isinstance(found, Outputs)
    assert found.data.tolist() == ANSWER.tolist()


def test_a_function_that_was_never_written_is_there(sandbox) -> None:
    """The table stands in for a function that is missing."""
    found = asked(sandbox, CALLERS["by its name"], [table()])
    assert isinstance(found, Outputs)
    assert found.data.tolist() == ANSWER.tolist()


def test_for_anything_else_the_own_function_answers(sandbox) -> None:
    """The table knows one graph; asked for another, the function is the submission's."""
    found = asked(sandbox, OWN + CALLERS["by its name"], [table()], graph=0)
    assert isinstance(found, Outputs)
    assert found.data.tolist() == [1.5, 2.5]


@pytest.mark.parametrize(
    ("form", "shape"),
    [
        ({}, (2,)),
        ({"shape": "column"}, (2, 1)),
        ({"shape": "row"}, (1, 2)),
        ({"kind": "list"}, (2,)),
        ({"shape": "column", "kind": "matrix"}, (2, 1)),
    ],
)
def test_an_answer_has_the_form_of_the_own_one(sandbox, form, shape) -> None:
    """Columns, rows, lists and np.matrix come as the submission made them."""
    text = (
        "import numpy as np\nkinds = {list: 'list', np.ndarray: 'array', np.matrix: 'matrix'}\n"
        f"def f(x, graph):\n    v = g(x, graph)\n    assert kinds[type(v)] == {form.get('kind', 'array')!r}\n"
        "    return np.asarray(v)\n"
    )
    found = asked(sandbox, OWN + text, [table(**form)])
    assert isinstance(found, Outputs)
    assert found.shapes == [shape]
    assert found.data.tolist() == ANSWER.tolist()


def test_arrays_are_told_apart_by_value(sandbox) -> None:
    """A function of arrays answers for those that the table lists, -0 for 0, and for no others."""
    entry = Entry([array(np.eye(2)), array(np.zeros(2))], [Part(array(np.array([4.0])), None)])
    by_arrays = Table("h", [0, 1], -1, [""], "array", [entry])
    text = "import numpy as np\n\ndef h(A, v):\n    return [0.5]\n"
    right = text + "def f(x, graph):\n    return h([[1, 0], [0, 1]], -np.zeros(2))\n"
    wrong = text + "def f(x, graph):\n    return h(2 * np.eye(2), np.zeros(2))\n"
    for source, wanted in ((right, 4.0), (wrong, 0.5)):
        found = asked(sandbox, source, [by_arrays])
        assert isinstance(found, Outputs)
        assert found.data.tolist() == [wanted]


def test_answers_are_copies(sandbox) -> None:
    """Who changes an answer in place does not change the next one."""
    text = "def f(x, graph):\n    g(x, graph)[:] = 0\n    return g(x, graph)\n"
    found = asked(sandbox, OWN + text, [table()])
    assert isinstance(found, Outputs)
    assert found.data.tolist() == ANSWER.tolist()


def test_the_next_child_has_no_tables(sandbox) -> None:
    """Once that child has gone, the function is the submission's own again."""
    with sandbox.open(Source("module", [OWN + CALLERS["by its name"]], "student")) as session:
        assert session.replace([table()]) is None
        session.fresh()
        found = session.call(batch(arguments=(array(X), OTHER)))
    assert isinstance(found, Outputs)
    assert found.data.tolist() == [1.5, 2.5]

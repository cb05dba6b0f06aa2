"""Stubs keep names, arguments and docstrings of the reference, and nothing else."""

import ast

import pytest

from autograder.problems.problem import worked_problem
from autograder.render.stub import CORE, graph_source, reference_source, stub_module, stubs

REFERENCE = ast.parse(reference_source())
FUNCTIONS = {node.name: node for node in REFERENCE.body if isinstance(node, ast.FunctionDef)}


def test_every_public_function_of_the_reference_has_a_stub():
    """The core functions come first, in the order of the handout."""
    names = list(stubs(reference_source()))
    assert names[: len(CORE)] == list(CORE)
    assert names == [name for name in FUNCTIONS if not name.startswith("_")]


@pytest.mark.parametrize("name", list(stubs(reference_source())))
def test_a_stub_keeps_signature_and_docstring(name):
    """Arguments, annotations and docstring are those of the reference; the body is one raise."""
    (stub,) = ast.parse(stubs(reference_source())[name]).body
    assert isinstance(stub, ast.FunctionDef)
    reference = FUNCTIONS[name]
    assert ast.dump(stub.args) == ast.dump(reference.args)
    assert ast.dump(stub.returns) == ast.dump(reference.returns)
    assert ast.get_docstring(stub) == ast.get_docstring(reference)
    assert [type(statement) for statement in stub.body] == [ast.Expr, ast.Raise]


def test_an_unfinished_function_says_so_in_a_sentence():
    """Every stub raises NotImplementedError, naming itself."""
    for name, stub in stubs(reference_source()).items():
        raised = ast.parse(stub).body[0].body[-1].exc
        assert raised.func.id == "NotImplementedError"
        assert raised.args[0].value == f"{name} is not finished yet: replace this line by your code."


def test_a_body_is_never_looked_at():
    """Whatever a body holds, the stub is the same."""
    one = 'def f(x: int) -> int:\n    """Say a fact."""\n    return 42\n'
    two = 'def f(x: int) -> int:\n    """Say a fact."""\n    secret = x\n\n    return secret\n'
    assert stubs(one) == stubs(two)


def test_a_default_value_is_refused():
    """A default would be copied into the stub, so the reference must have none."""
    with pytest.raises(ValueError, match="f must have no default values"):
        stubs("def f(x=42): ...")


def test_docstrings_with_backslashes_survive():
    """A docstring with a backslash becomes a raw string."""
    source = 'def f():\n    r"""Print \\n."""\n'
    (stub,) = ast.parse(stubs(source)["f"]).body
    assert ast.get_docstring(stub) == "Print \\n."


def test_the_module_holds_the_problem_as_data():
    """`my_graph` and `my_start` are the problem's numbers; the four answers are open."""
    problem = worked_problem()
    text = stub_module(problem)
    assert f"my_graph = {graph_source(problem.graph)}\n" in text
    assert "my_start = np.array([0.0, 1.1, 2.1, 3.2, 0.5])\n" in text
    for answer in ("iterates", "conclusion", "written_2", "written_3"):
        assert f"\n{answer} = None\n" in text

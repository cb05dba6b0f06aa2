"""A sandbox that the tests of this room share, and short ways to run a text in it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
import pytest

from autograder.sandbox.frames import Argument, Array, Batch, GraphData, Inputs, RangingData, Source, encode_inputs
from autograder.sandbox.host import Failure, Limits, Loaded, Outputs, Sandbox

GRAPH = GraphData(
    n_poses=3,
    edges=np.array([[0, 1], [1, 2]], "<i8").tobytes(),
    measurements=np.array([1.0, 2.0]).tobytes(),
    edge_variances=np.array([0.01, 0.01]).tobytes(),
    priors=np.array([0], "<i8").tobytes(),
    prior_means=np.array([0.0]).tobytes(),
    prior_variances=np.array([0.001]).tobytes(),
)
RANGING = RangingData(
    beacon=np.array([2.0, 1.0]).tobytes(),
    poses=np.array([0, 1], "<i8").tobytes(),
    ranges=np.array([1.0, 1.5]).tobytes(),
    variances=np.array([0.01, 0.01]).tobytes(),
)
X = Array((3,), np.array([0.0, 1.0, 2.0]).tobytes())
LIMITS = Limits(cpu_seconds=0.25, memory_mib=64, output_bytes=1 << 20)

Run = Callable[..., Outputs | Failure]


def inputs(batches: Sequence[Batch] = ()) -> bytes:
    """Encode the inputs that the tests use: one graph, one ranging, and these batches."""
    return encode_inputs(Inputs(objects=[GRAPH, RANGING], batches=list(batches)))


def batch(
    function: str = "f", cases: int = 1, parts: int = 1, arguments: Sequence[Argument] = (X, 0), most: int = 100
) -> Batch:
    """Make a batch of equal calls, f(x, graph) where nothing else is said."""
    return Batch(function, parts, most, [list(arguments)] * cases)


@pytest.fixture(scope="session")
def sandbox() -> Iterator[Sandbox]:
    """Give the sandbox that all tests share; its first batch calls f(x, graph) twice."""
    with Sandbox(inputs([batch(cases=2)]), LIMITS) as shared:
        yield shared


@pytest.fixture
def load(sandbox: Sandbox) -> Callable[[str], Loaded]:
    """Give a function that executes a module and says what it defines."""

    def load_text(text: str) -> Loaded:
        with sandbox.open(Source("module", [text], "student")) as session:
            return session.load()

    return load_text


@pytest.fixture
def load_cells(sandbox: Sandbox) -> Callable[..., Loaded]:
    """Give a function that executes the cells of a notebook and says what they define."""

    def load_texts(*texts: str) -> Loaded:
        with sandbox.open(Source("notebook", list(texts), "student")) as session:
            return session.load()

    return load_texts


@pytest.fixture
def run(sandbox: Sandbox) -> Run:
    """Give a function that executes a module and calls a function of it."""

    def run_text(text: str, **what: object) -> Outputs | Failure:
        with sandbox.open(Source("module", [text], "student")) as session:
            return session.call(batch(**what))  # type: ignore[arg-type]  # the keywords of batch

    return run_text


@pytest.fixture
def value(run: Run) -> Callable[[str], Outputs]:
    """Give a function that returns the outputs of one call whose body is an expression of x and graph."""

    def value_of(expression: str, before: str = "") -> Outputs:
        text = f"import numpy as np\n{before}\ndef f(x, graph):\n    return {expression}\n"
        outputs = run(text)
        assert isinstance(outputs, Outputs), outputs
        return outputs

    return value_of

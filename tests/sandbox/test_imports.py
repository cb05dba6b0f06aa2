"""Imports follow the contract: some modules are there, some do nothing, all others raise at their first use."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from autograder.sandbox.frames import Outcome
from autograder.sandbox.host import Loaded, Outputs

Load = Callable[[str], Loaded]
Run = Callable[..., Outputs]
CONTRACT = """
    posegraph numpy math cmath fractions decimal statistics itertools functools operator collections dataclasses typing
    enum copy random time warnings abc numbers string textwrap re json sys os io contextlib types pprint inspect
"""


def test_allowed_modules_are_the_real_ones(load: Load) -> None:
    """Every module of the contract imports, in every form, and works."""
    assert load("".join(f"from {name} import *\n" for name in CONTRACT.split())).notes == ()
    lines = ["from __future__ import annotations"]
    for name in CONTRACT.split():
        lines += [f"import {name}", f"import {name} as other", f"assert other is {name}"]
    lines += [
        "import os.path, collections.abc, numpy.linalg as la, json.decoder",
        "from numpy.polynomial import Polynomial",
        "from numpy.lib.stride_tricks import sliding_window_view",
        "assert la.solve([[2.0]], [1.0])[0] == 0.5",
        "assert numpy.char.upper('a') == 'A'",
        "from posegraph import PoseGraph, Ranging",
        "assert time.strptime('2020', '%Y').tm_year == 2020",
    ]
    assert load("\n".join(lines)).notes == ()


@pytest.mark.parametrize("module", ["scipy", "scipy.linalg", "torch", "socket", "subprocess", "autograder", "sandbox"])
def test_an_unused_import_costs_nothing(load: Load, module: str) -> None:
    """An import of anything is a note to nobody as long as it is not used."""
    names = ["a", "a as b, c", "*"]
    lines = [f"import {module}", f"import {module} as m", *(f"from {module} import {name}" for name in names)]
    assert load("\n".join(lines)).notes == ()


USES = {
    "an attribute": ("import scipy", "scipy.pi", "scipy"),
    "an attribute of a part": ("import scipy.linalg", "scipy.linalg.solve(x, x)", "scipy.linalg"),
    "under another name": ("import scipy.linalg as la", "la.solve(x, x)", "scipy.linalg"),
    "a deep name": ("import a.b.c as d", "d.e", "a.b.c"),
    "a call": ("from scipy.linalg import solve", "solve(x, x)", "scipy.linalg"),
    "a submodule": ("from scipy import sparse", "sparse.eye(3)", "scipy"),
    "arithmetic": ("from sympy import pi", "2 * pi", "sympy"),
    "a matrix product": ("from sympy import M", "x @ M", "sympy"),
    "a comparison": ("from sympy import M", "M == 1", "sympy"),
    "an item": ("from sympy import M", "M[0]", "sympy"),
    "a loop": ("from sympy import M", "[k for k in M]", "sympy"),
    "a truth value": ("from sympy import M", "1.0 if M else 2.0", "sympy"),
    "an array": ("from sympy import M", "__import__('numpy').asarray(M)", "sympy"),
    "a starred name": ("from scipy.linalg import *", "solve(x, x)", "scipy.linalg"),
    "by the function": ("m = __import__('socket')", "m.socket()", "socket"),
    "os by another name": ("import posix", "posix.getpid()", "posix"),
}


@pytest.mark.parametrize(("line", "use", "module"), USES.values(), ids=USES.keys())
def test_a_use_is_forbidden(run: Run, line: str, use: str, module: str) -> None:
    """Whatever is done with a module that is not allowed, the outcome is forbidden and names it."""
    outputs = run(f"{line}\ndef f(x, graph):\n    return {use}\n")
    assert outputs.outcome.tolist() == [Outcome.FORBIDDEN], outputs.reasons
    assert outputs.reasons == {0: module}


def test_a_forbidden_decorator_is_forbidden_at_the_call(run: Run, load: Load) -> None:
    """A function that is defined with what is not allowed is forbidden, not missing."""
    text = "from numba import njit\n@njit\ndef f(x, graph):\n    return x\n"
    assert [(note.where, note.status) for note in load(text).notes] == [("line 2", "forbidden")]
    assert run(text).reasons == {0: "numba"}


def test_a_statement_that_uses_a_forbidden_module_is_noted(load: Load) -> None:
    """At the top level it is skipped, and the rest counts."""
    loaded = load("import pandas as pd\ndf = pd.DataFrame()\ndef f(x, graph): return x\n")
    assert [(note.where, note.status, note.message) for note in loaded.notes] == [
        ("line 2", "forbidden", "pandas is not allowed here")
    ]
    assert "f" in loaded.functions


def test_an_own_fallback_works(run: Run) -> None:
    """Who catches the error is graded on what follows."""
    text = "import scipy\ndef f(x, graph):\n    try: return scipy.f(x)\n    except ImportError: return x\n"
    assert run(text).outcome.tolist() == [Outcome.OK]


STAND_INS = """
import matplotlib
import matplotlib.pyplot as plt
from matplotlib import cm, rcParams
from matplotlib.pyplot import *
from mpl_toolkits.mplot3d import Axes3D
import IPython
from IPython.display import display, HTML, clear_output
import self_check
from self_check import check_all
from tqdm import tqdm, trange
from tqdm.notebook import tqdm as bar
import tqdm as progress
get_ipython().run_line_magic("matplotlib", "inline")
matplotlib.use("Agg")
plt.rcParams["figure.figsize"] = (3, 3)
rcParams.update({"a": 1})
fig, ax = plt.subplots()
fig, (a, b, c) = plt.subplots(1, 3, figsize=(9, 3))
fig, axes = plt.subplots(2, 2)
assert axes.shape == (2, 2)
assert len([one.plot(1) for one in axes.flat]) == 4
assert len(list(zip(axes.ravel(), range(4)))) == 4
line, = plt.plot([1, 2], label="x")
one, two = ax.plot([1], [2], [3], [4])
n, bins, patches = plt.hist([1, 2])
ax.set(title="t")
ax.spines["top"].set_visible(False)
ax.figure.dpi = 2 * fig.dpi + 1
with plt.style.context("ggplot"):
    plt.show()
for artist in ax.lines:
    artist.remove()
colours = cm.viridis([0.5])
plot([1]); title("t"); show()
display(fig, HTML("<b>"))
help(plt)
check_all(None)
assert self_check.residual(None)
assert list(tqdm([1, 2, 3], desc="d")) == [1, 2, 3]
assert [k for k in bar(range(2))] == [0, 1]
assert list(trange(3)) == [0, 1, 2]
assert len(progress.tqdm([1, 2])) == 2
p = tqdm(total=3); p.update(1); p.set_postfix(a=1); p.close()
with tqdm(range(2)) as q:
    assert list(q) == [0, 1]
@self_check.stage
def f(x, graph):
    return x
"""


def test_stand_ins_do_nothing_and_cost_nothing(load: Load, run: Run) -> None:
    """Figures, displays and progress bars of every common form leave no note."""
    assert load(STAND_INS).notes == ()
    assert run(STAND_INS).outcome.tolist() == [Outcome.OK]


@pytest.mark.parametrize(
    "line",
    ["from . import x", "from .slam1d import f", "import slam1d", "from slam1d import f", "import numpy.nonsense",
     "from numpy import nonsense", "from os import nonsense"],
)  # fmt: skip  # a list of lines
def test_what_is_not_there_is_an_ordinary_error(load: Load, line: str) -> None:
    """Relative imports, the submission itself and parts that do not exist raise ImportError."""
    (note,) = load(line + "\n").notes
    assert note.status == "error"
    assert "Error: " in note.message


def test_posegraph_is_the_graders_own(run: Run) -> None:
    """A class of the same name in the submission changes nothing for the grader."""
    text = """
import posegraph
class PoseGraph:
    pass
posegraph.PoseGraph = PoseGraph
def f(x, graph):
    return [type(graph) is not PoseGraph and type(graph).__module__ == "posegraph"]
"""
    assert run(text).data.tolist() == [1.0]


def test_a_star_brings_all_of_numpy_that_is_there(run: Run) -> None:
    """`from numpy import *` and of its parts bind what their own list says, without a look at the disk."""
    text = """
from numpy import *
from numpy.linalg import *
from numpy.polynomial import *
def f(x, graph):
    return solve(diag(ones(3)), asarray(x)) + 0 * linalg.norm(x) + 0 * random.default_rng(0).normal(size=3)
"""
    assert run(text).data.tolist() == [0, 1, 2]


def test_numpy_imports_what_it_needs(run: Run) -> None:
    """The import of a submission is not numpy's: its late imports find what was loaded before."""
    text = """
import numpy as np
def f(x, graph):
    np.testing.assert_allclose(x, x)
    np.set_printoptions(precision=3)
    return np.polynomial.Polynomial.fit(x, x, 1)(x) + len(repr(np.ma.masked_array(x))) * 0
"""
    assert run(text).outcome.tolist() == [Outcome.OK]

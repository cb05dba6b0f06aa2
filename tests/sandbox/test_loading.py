"""A submission is executed statement by statement: what fails is skipped and noted, the rest counts."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from autograder.sandbox.frames import Source
from autograder.sandbox.host import Loaded, Outputs, Sandbox
from tests.sandbox.conftest import batch

Load = Callable[..., Loaded]
Run = Callable[..., Outputs]


def brief(loaded: Loaded) -> list[tuple[str, str]]:
    """Give where and how of every note."""
    return [(note.where, note.status) for note in loaded.notes]


def test_definitions_around_an_error_count(load: Load) -> None:
    """A statement that raises is skipped; those before and after it are not."""
    loaded = load("def a(): pass\nx = 1 / 0\ndef b(): pass\nimport sys\nsys.exit()\nc = lambda: 0\nd = 3\n")
    assert brief(loaded) == [("line 2", "error"), ("line 5", "error")]
    assert loaded.notes[0].message == "ZeroDivisionError: division by zero"
    assert {"a", "b", "c"} <= loaded.functions
    assert "d" not in loaded.functions


def test_the_last_definition_wins(run: Run) -> None:
    """A function defined again replaces the first."""
    assert run("def f(x, g): return [1]\ndef f(x, g): return [2]\n").data.tolist() == [2]


def test_the_name_is_that_of_a_module(run: Run) -> None:
    """`__name__` is not "__main__", and names a module that stands in sys.modules."""
    text = """
import sys, dataclasses, inspect
answer = 42
if __name__ == "__main__":
    answer = 0
@dataclasses.dataclass
class Pair:
    a: int = 1
def f(x, g):
    return [sys.modules[__name__].answer, Pair().a, "return" in inspect.getsource(f), __name__ == "slam1d"]
"""
    assert run(text).data.tolist() == [42, 1, 1, 1]


def test_an_annotation_costs_nothing(load: Load) -> None:
    """Names in annotations are not looked up, with `from __future__ import annotations` or without."""
    assert brief(load("from __future__ import annotations\ndef f(x: Nonsense) -> Nothing: pass\n")) == []
    loaded = load(
        "def f(x: Nonsense): pass\nclass A:\n    x: Nonsense\n    def g(self) -> 1 / 0: pass\ny: Nonsense = 3\n"
    )
    assert brief(loaded) == []
    assert {"f", "A"} <= loaded.functions


BROKEN = '''
import numpy as np

def a(x):
    return x

print "old print"

def b(x)
    return x

@staticmethod
def c(x):
    """A text
that goes on at the margin
def not_a_function(
    """
    return x

def d(x:
    return x

values = [1,
2,
3]

class E:
    pass
    def broken(self:
        pass

if values:
    def f(x):
        return x
else:
    pass

def g(x):
  return (x
          + 1)
'''


def test_a_syntax_error_costs_its_own_part(load: Load) -> None:
    """What does not parse is left out, part by part; everything else of the module counts."""
    loaded = load(BROKEN)
    assert brief(loaded) == [(f"line {line}", "syntax") for line in (7, 9, 20, 29)]
    assert {"a", "c", "f", "g"} <= loaded.functions
    assert not {"b", "d", "E", "not_a_function"} & loaded.functions
    assert loaded.notes[0].message.startswith("SyntaxError: Missing parentheses")


NO_PYTHON = {
    "deep operators": "x = " + "-" * 200_000 + "1",
    "deep brackets": "x = " + "(" * 100_000,
    "deep lists": "x = " + "[" * 5000 + "]" * 5000,
    "a long chain": "a" + ".b" * 50_000,
    "a null byte": "x = 1\0",
    "half a line": "def f(:",
    "a lone surrogate": "\ud800",
    "blanks": "   ",
    "form feeds": "\x0c\x0b",
    "a long name": "x" * 10**6,
    "a return": "return 1",
    "an await": "await x",
    "an unknown coding": "# -*- coding: nonsense -*-\nx=1",
}


@pytest.mark.parametrize("text", NO_PYTHON.values(), ids=NO_PYTHON.keys())
def test_text_that_is_no_python_is_survived(sandbox: Sandbox, text: str) -> None:
    """Whatever the text, the submission is loaded, with notes, and what follows in the next cell counts."""
    with sandbox.open(Source("notebook", [text, "def f(x, g): return x"], "student")) as session:
        loaded = session.load()
        assert "f" in loaded.functions
        assert all(note.where.startswith("cell 1") and note.message.isprintable() for note in loaded.notes)


@pytest.mark.parametrize("deep", ["-" * 200_000 + "1", "(" * 200_000 + ")" * 200_000, "x" + ".b" * 50_000])
def test_a_statement_that_is_too_deep_costs_itself(load: Load, deep: str) -> None:
    """In a module, too, what stands before it and after it counts."""
    loaded = load(f"def before(x):\n    return x\n\ndef deep(x):\n    return {deep}\n\ndef after(x):\n    return x\n")
    assert loaded.functions >= {"before", "after"}
    assert [note.where for note in loaded.notes] in (["line 4"], ["line 5"])


def test_line_ends_and_marks_do_not_matter(load: Load) -> None:
    """Carriage returns and a byte order mark are not part of the text."""
    assert brief(load("\ufeffdef f(x):\r\n    return x\r\n1/0\r\n")) == [("line 3", "error")]
    assert load("def f(x):\r    return x\r").functions >= {"f"}


MAGICS = [
    "%matplotlib inline\nimport numpy as np\n!pip install numpy",
    "%%time\ndef a(x):\n    return x",
    "%%bash\nrm -rf /\ndef never(): pass",
    "%%html\n<b>",
    "\n%%capture out\n%%time\n%load_ext autoreload\nb = lambda: 0",
    "np.dot?\n?np.dot\nnp.dot??\nfiles = !ls\nout = %timeit -o 1\ndef c():\n    if True:\n        !echo\n    return 1",
    "%time d = lambda: 0\nx = 7 % 3\ny = (7\n% 3)\nassert x == y == 1",
    "text = '''\n%matplotlib\n!ls\n'''\nassert '%matplotlib' in text\ndisplay(text)",
    "get_ipython().run_line_magic('matplotlib', 'inline')\nget_ipython().system('ls')",
    "%%writefile slam1d.py\ndef never(): pass",
    "%time\n%%\n",
]


def test_notebook_magics_cost_nothing(load_cells: Load) -> None:
    """Magics, shell lines and help do nothing; cells for other programs are left out; timed cells run."""
    loaded = load_cells(*MAGICS)
    assert brief(loaded) == []
    assert {"a", "b", "c", "d"} <= loaded.functions
    assert "never" not in loaded.functions


def test_a_cell_that_fails_costs_no_other(load_cells: Load) -> None:
    """Cells count on their own, and within a cell the statements do."""
    loaded = load_cells("def a(): pass\n1/0\ndef b(): pass", "def c(:", "def d(): pass", "x =\ndef e(): pass")
    assert brief(loaded) == [("cell 1, line 2", "error"), ("cell 2, line 1", "syntax"), ("cell 4, line 1", "syntax")]
    assert {"a", "b", "d", "e"} <= loaded.functions


ENDINGS = {
    "hangs": ("while True: pass", "timeout", "s of computing"),
    "sleeps": ("import time\ntime.sleep(100)", "timeout", "s of waiting"),
    "leaves": ("import os\nos._exit(0)", "died", "exit status 0"),
    "aborts": ("import os\nos.abort()", "died", "crashed"),
    "floods": ("while True: print('x' * 10000)", "died", "printed more than 1 MiB"),
    "scribbles": ("import os\nos.write(3, b'x' * 100)", "died", "own channel"),
}


@pytest.mark.parametrize(("text", "status", "words"), ENDINGS.values(), ids=ENDINGS.keys())
def test_a_statement_that_ends_the_child_is_left_out(sandbox: Sandbox, text: str, status: str, words: str) -> None:
    """Definitions before and after a statement that never comes back count, also in the next child."""
    lines = f"def a(x, g): return x\n{text}\ndef b(x, g): return x\n"
    with sandbox.open(Source("module", [lines], "student")) as session:
        loaded = session.load()
        assert {"a", "b"} <= loaded.functions
        (note,) = loaded.notes
        assert note.where == f"line {1 + len(text.splitlines())}"
        assert note.status == status
        assert words in note.message
        assert isinstance(session.call(batch("b")), Outputs)
        session.fresh()
        assert isinstance(session.call(batch("a")), Outputs)


def test_memory_in_a_statement_is_noted(load: Load) -> None:
    """A statement that wants too much memory is skipped, and the memory is there again."""
    loaded = load("x = [0.0] * 10**9\ndef f(): pass\ny = [0.0] * 10**6\n")
    assert brief(loaded) == [("line 1", "memory")]


def test_many_deadly_statements_end_the_loading(load: Load) -> None:
    """After twenty of them the rest is left out; what stood before counts."""
    loaded = load("import os\ndef a(): pass\n" + "os._exit(1)\n" * 30 + "def b(): pass\n")
    assert "a" in loaded.functions
    assert "b" not in loaded.functions
    assert len(loaded.notes) == 21
    assert "one of too many" in loaded.notes[-1].message


def test_notes_are_bounded(load: Load) -> None:
    """Ten thousand errors do not become ten thousand notes."""
    loaded = load("1/0\n" * 10_000 + "def f(): pass\n")
    assert len(loaded.notes) <= 256
    assert "f" in loaded.functions


def test_answers_are_read(load: Load) -> None:
    """The four answers arrive as an array and as texts."""
    answers = load(
        "iterates = [[0, 1.5], [2, 3]]\nconclusion = 'b'\nwritten_2 = 'because\\n\u00e4'\nwritten_3 = None\n"
    ).answers
    assert answers.iterates is not None
    assert answers.iterates.tolist() == [[0, 1.5], [2, 3]]
    assert (answers.conclusion, answers.written_2, answers.written_3, answers.bad) == ("b", "because\n\u00e4", None, "")


def test_unset_answers_are_none(load: Load) -> None:
    """None and a missing name are both unfinished."""
    assert load("iterates = conclusion = None\n").answers == load("").answers
    assert load("").answers.iterates is None


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("iterates = 'x'", "iterates: got a str"),
        ("iterates = [[0] * 1000] * 1000", "iterates: got shape (1000, 1000)"),
        ("conclusion = 3", "conclusion: got an int, expected a string"),
        ("written_2 = 'x' * 10**6", "written_2: got 1000000 characters, at most 20000 are read"),
        ("class S(str):\n    def encode(self): return 3\n    __len__ = None\nwritten_3 = S('x')", ""),
    ],
)
def test_unusable_answers_are_named(load: Load, line: str, words: str) -> None:
    """What is no answer is left out, and words say why."""
    assert load(line + "\n").answers.bad == words

"""Advice that follows from what was raised and from the text of the function: its parameters, and names it uses.

The text is read line by line and never parsed: it is a stranger's. Advice is given only where a mistake has no name.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from msgspec.structs import replace

from autograder.engine.evidence import arguments, called_as
from autograder.stages.catalogue import stage
from autograder.verdicts import StageVerdict

# What an exception says, and what to think about.
_RAISED = {
    r"could not be broadcast": (
        "The sign * multiplies entry by entry and needs equal shapes; which one multiplies matrices?"
    ),
    r"output array is not acceptable|return arrays? must be|'out'": (
        "np.dot multiplies two arrays; a third argument is where it writes. How is a product of three written?"
    ),
    r"IndexError: (index -?\d+ is|list index|tuple index)": (
        "Another graph has other numbers of poses, edges and priors: let the indices come from the lists of the graph."
    ),
    r"matmul: .*(mismatch|dimensions)": (
        "Write beside each factor of the product its shape: where do neighbouring lengths differ?"
    ),
    r"LinAlgError: Singular matrix": (
        "A singular H leaves some pose free to move: which factors say where the poses stand, and are all of them in H?"
    ),
}
_DEFINES = re.compile(r"def\s+(\w+)\s*\(([^()]*)\)")
_OWN_GRAPH = re.compile(r"\bmy_(?:graph|start)\b")
_LONG = 1000  # characters of a line that are read


def advised(verdicts: Sequence[StageVerdict], cells: Sequence[str]) -> list[StageVerdict]:
    """Add to every wrong stage without a name what its exception and its text tell.

    Parameters
    ----------
    verdicts : sequence of StageVerdict
        What was judged and explained.
    cells : sequence of str
        The text of the submission: a module has one cell.
    """
    return [_advised(each, cells) if _wanted(each) else each for each in verdicts]


def _wanted(verdict: StageVerdict) -> bool:
    """Whether a stage was tried and went wrong by a mistake without a name."""
    return verdict.status in {"failed", "partial", "error"} and verdict.slip is None and bool(verdict.group)


def _advised(verdict: StageVerdict, cells: Sequence[str]) -> StageVerdict:
    function = stage(verdict.name).function
    raised = re.search(r" raised (.*)", "\n".join([verdict.message, *(check.message for check in verdict.checks)]))
    hint = next((words for said, words in _RAISED.items() if raised and re.search(said, raised[1])), verdict.hint)
    parameters, body = _written(function, cells)
    found = [_own_graph(function, body)]
    if raised and parameters is not None and parameters != arguments(function):
        found.append(f"It is called as {called_as(function)}, and your {function} takes ({', '.join(parameters)}).")
    words = " ".join(part for part in (*found, verdict.message) if part)
    return replace(verdict, message=words, hint=hint)


def _written(function: str, cells: Sequence[str]) -> tuple[tuple[str, ...] | None, list[str]]:
    """Return the parameters of the last definition of a function at the top level, and the lines of its body."""
    parameters: tuple[str, ...] | None = None
    body: list[str] = []
    inside = False
    for line in (line[:_LONG] for cell in cells for line in [*cell.splitlines(), "0"]):
        defines = _DEFINES.match(line)
        if defines and defines[1] == function:
            parts = [re.split("[:=]", part)[0].strip() for part in defines[2].split(",")]
            parameters, body, inside = tuple(part for part in parts if part), [], True
        elif line[:1] not in {"", " ", "\t", ")", "#"}:
            inside = False
        elif inside:
            body.append(line)
    return parameters, _code(body)


def _code(lines: Sequence[str]) -> list[str]:
    """Leave out comments, and strings that may be documentation."""
    text = re.sub(r'("""|\'\'\').*?(\1|$)', "", "\n".join(lines), flags=re.DOTALL)
    return [line.partition("#")[0] for line in text.split("\n")]


def _own_graph(function: str, body: Sequence[str]) -> str:
    """Say so where a function uses the student's own graph beside, or instead of, the one that it is given."""
    line = next((line.strip() for line in body if _OWN_GRAPH.search(line)), "")
    if not line:
        return ""
    shown = "".join(letter if letter.isprintable() else " " for letter in line)[:100].replace("`", "'")
    return f"{function} looks at your own graph, `{shown}`: it should look only at the graph that it is given."

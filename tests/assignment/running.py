"""Run a notebook with a real kernel and look at what each cell printed."""

import ast
from copy import deepcopy

from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

from autograder.render.stub import reference_source


def reference_functions():
    """Text of each public function of the reference."""
    source = reference_source()
    nodes = [node for node in ast.parse(source).body if isinstance(node, ast.FunctionDef)]
    return {node.name: ast.get_source_segment(source, node) for node in nodes}


def paste(notebook, functions):
    """Put finished functions into the stub cells."""
    for cell in notebook.cells:
        name = cell.id.removeprefix("stub-").replace("-", "_")
        if cell.id.startswith("stub-") and name in functions:
            cell.source = functions[name]
    return notebook


def run(notebook, functions, folder):
    """Run a copy of a notebook, alone in a folder or with what lies there, until its end or its first error.

    Returns
    -------
    (notebook, stopped)
        The executed notebook, and the id of the cell that stopped it or None.
    """
    notebook = paste(deepcopy(notebook), functions)
    client = NotebookClient(notebook, timeout=60, kernel_name="python3", resources={"metadata": {"path": str(folder)}})
    try:
        client.execute()
    except CellExecutionError:
        stopped = next(cell.id for cell in notebook.cells if any(o.output_type == "error" for o in printed(cell)))
        return notebook, stopped
    return notebook, None


def printed(cell):
    """Outputs of a cell; none where it is no code."""
    return cell.get("outputs", [])


def text_of(notebook, name):
    """All text that the cell of this id printed."""
    cell = next(cell for cell in notebook.cells if cell.id == name)
    parts = [output.get("text") or output.get("data", {}).get("text/plain", "") for output in printed(cell)]
    return "".join(parts)


def sentences(printed):
    """What the self-check printed, each indented line joined to the one that it goes on from."""
    return printed.replace("\n      ", " ").splitlines()

"""The inputs of a counterexample as Python to paste: the same numbers, bit for bit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from autograder.reports.wording import visible

_ARGUMENTS = {
    "information_matrix": "graph",
    "normal_equations": "J, omega, f",
    "sparsity_pattern": "graph",
    "range_residual": "x, ranging",
    "range_jacobian": "x, ranging",
}
_RECORDS = {"graph": "PoseGraph", "ranging": "Ranging"}
_NOT_INPUTS = {"function", "expected", "got", *_RECORDS}
_LONGEST = 24  # entries of an array that a reader would still paste


def call_text(counterexample: Mapping[str, Any]) -> str:
    """Write the inputs and the call as Python that can be pasted below one's own functions.

    Examples
    --------
    >>> print(call_text({"function": "normal_equations", "J": [[1.0, -1.0], [1.0, 0.0]],
    ...                  "omega": [[25.0, 0.0], [0.0, 1000.0]], "f": [-0.5, 1.0], "got": [], "expected": []}))
    J = np.array([[1.0, -1.0], [1.0, 0.0]])
    omega = np.diag([25.0, 1000.0])
    f = np.array([-0.5, 1.0])
    normal_equations(J, omega, f)
    """
    lines = []
    for key, name in _RECORDS.items():
        fields = counterexample.get(key)
        if isinstance(fields, Mapping):
            lines.append(f"{key} = {name}(")
            lines += [f"    {field}={_field(value)}," for field, value in fields.items()]
            lines.append(")")
    for key, value in counterexample.items():
        if key not in _NOT_INPUTS:
            lines.append(f"{key} = {_array(key, value)}")
    function = str(counterexample.get("function", ""))
    if function:
        lines.append(f"{function}({_ARGUMENTS.get(function, 'x, graph')})")
    return "\n".join(lines)


def _field(value: Any) -> str:
    """Write a field of a record, which makes its own floats: 1.0 may be written 1."""
    if isinstance(value, (list, tuple)):
        if len(value) > _LONGEST:
            return f"...  # {len(value)} entries, too many to show"
        if value and isinstance(value[0], (list, tuple)):
            return "[" + ", ".join("(" + ", ".join(map(_field, pair)) + ")" for pair in value) + "]"
        return "[" + ", ".join(map(_field, value)) + "]"
    if isinstance(value, float) and math.isfinite(value) and value == int(value) and abs(value) < 1e15:
        return str(int(value))
    return _entry(value)


def _entry(value: Any) -> str:
    if isinstance(value, float):
        return repr(value + 0.0) if math.isfinite(value) else f"np.{value}"
    return repr(value) if isinstance(value, int) else visible(str(value), 60)


def _array(key: str, value: Any) -> str:
    if not isinstance(value, (list, tuple)):
        return _entry(value)
    if len(value) > _LONGEST:
        return f"...  # {len(value)} entries, too many to show"
    if not value or not isinstance(value[0], (list, tuple)):
        return "np.array([" + ", ".join(map(_entry, value)) + "])"
    diagonal = _diagonal(value) if key == "omega" else None
    if diagonal is not None:
        return "np.diag([" + ", ".join(map(_entry, diagonal)) + "])"
    rows = ["[" + ", ".join(map(_entry, row)) + "]" for row in value]
    indent = ",\n" + " " * len(f"{key} = np.array([")
    return f"np.array([{(', ' if sum(map(len, rows)) < 60 else indent).join(rows)}])"


def _diagonal(rows: Any) -> list[Any] | None:
    if any(len(row) != len(rows) for row in rows):
        return None
    if any(entry for r, row in enumerate(rows) for c, entry in enumerate(row) if r != c):
        return None
    return [row[k] for k, row in enumerate(rows)]

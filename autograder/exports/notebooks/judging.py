"""The code of hidden tests. Its functions are copied into notebooks, where they have nothing but numpy.

Each reads its cases from packed text, calls the student's function on copies, and raises AssertionError with a
sentence that names no expected value. Tolerances are those of the grader, packed with the cases.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def unpack(data: str, problem: type) -> Any:
    """Read packed cases; graphs are built with `problem`, everything else is an array."""
    import base64  # noqa: PLC0415 - in a notebook the function stands alone
    import json  # noqa: PLC0415 - as above
    import zlib  # noqa: PLC0415 - as above

    import numpy as np  # noqa: PLC0415 - as above

    def value(field: Any) -> Any:
        return field if isinstance(field, int) else np.array(field)

    def build(argument: Any) -> Any:
        if not isinstance(argument, dict):
            return np.array(argument, dtype=float)
        return problem(**{name: value(field) for name, field in argument.items()})

    cases = json.loads(zlib.decompress(base64.b64decode(data)))
    return [{**case, "calls": [[build(argument) for argument in call] for call in case["calls"]]} for case in cases]


def answer(function: Callable[..., Any], call: Any, shapes: Any) -> list[Any]:
    """Call a student's function quietly; return its arrays, each of the promised shape."""
    import contextlib  # noqa: PLC0415 - in a notebook the function stands alone
    import io  # noqa: PLC0415 - as above
    import warnings  # noqa: PLC0415 - as above

    import numpy as np  # noqa: PLC0415 - as above

    with warnings.catch_warnings(), np.errstate(all="ignore"), contextlib.redirect_stderr(io.StringIO()):
        warnings.simplefilter("ignore")
        returned = function(*(item.copy() if isinstance(item, np.ndarray) else item for item in call))
        parts = (returned,) if len(shapes) == 1 else tuple(returned)
        arrays = [np.array(part, dtype=float) for part in parts]
    assert len(arrays) == len(shapes), f"{function.__name__} returned {len(arrays)} arrays, expected {len(shapes)}"
    fitted = []
    for array, shape in zip(arrays, shapes, strict=True):
        vector = len(shape) == 1 and array.shape in ((shape[0], 1), (1, shape[0]))
        fitted.append(array.ravel() if vector else array)
        came = f"{function.__name__} returned shape {array.shape}"
        assert fitted[-1].shape == tuple(shape), f"{came}, expected {tuple(shape)}"
    return fitted


def judge_arrays(function: Callable[..., Any], cases: Any, line: str) -> None:
    """Compare every array with the expected one, entry by entry."""
    import numpy as np  # noqa: PLC0415 - in a notebook the function stands alone

    for case in cases:
        expected = [np.array(array, dtype=float) for array in case["expected"]]
        got = answer(function, case["calls"][0], [array.shape for array in expected])
        for mine, right, allowed in zip(got, expected, case["tolerance"], strict=True):
            assert (np.abs(mine - right) <= np.array(allowed)).all(), f"wrong values: {line}"


def judge_step(function: Callable[..., Any], cases: Any, line: str) -> None:
    """Ask for a small backward error: dx solves H dx = -b."""
    import numpy as np  # noqa: PLC0415 - in a notebook the function stands alone

    for case in cases:
        H, b = (np.array(array, dtype=float) for array in case["expected"])
        (dx,) = answer(function, case["calls"][0], [b.shape])
        scale = np.abs(H).sum(axis=1).max() * np.abs(dx).max() + case["scale"]
        assert np.abs(H @ dx + b).max() <= case["tolerance"] * scale, f"dx does not solve H dx = -b: {line}"


def judge_second_step(function: Callable[..., Any], cases: Any, line: str) -> None:
    """Ask that a second step is zero, that the point does not depend on the start, and that data move it."""
    import numpy as np  # noqa: PLC0415 - in a notebook the function stands alone

    for case in cases:
        points = [x + answer(function, (x, graph), [x.shape])[0] for x, graph in case["calls"]]
        (again,) = answer(function, (points[0], case["calls"][0][1]), [points[0].shape])
        moved = [np.abs(point - points[0]).max() for point in points]
        allowed = case["tolerance"]
        assert np.abs(again).max() <= allowed, f"the second step is not zero: {line}"
        assert moved[1] <= allowed, f"x + dx(x) depends on the start: {line}"
        assert min(moved[2:]) > 10 * allowed, f"x + dx(x) stays where it is when a measurement changes: {line}"

"""Cases as plain data, as JSON has it: lists of numbers, and graphs and rangings as their fields by name."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from assignment.posegraph import PoseGraph, Ranging


def plain(argument: Any) -> Any:
    """Turn one argument of a case into lists, numbers and dicts.

    Examples
    --------
    >>> plain(np.array([[1.0, -0.0]]))
    [[1.0, 0.0]]
    >>> plain(PoseGraph(2, [(0, 1)], [1], [4], [0], [0], [1]))["edges"]
    [[0, 1]]
    """
    if isinstance(argument, PoseGraph | Ranging):
        values = {field.name: getattr(argument, field.name) for field in dataclasses.fields(argument)}
        return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in values.items()}
    return (np.asarray(argument, dtype=np.float64) + 0.0).tolist()  # -0.0 becomes 0.0


def argument(data: Any) -> Any:
    """Rebuild an argument from what `plain` made.

    Examples
    --------
    >>> graph = PoseGraph(2, [(0, 1)], [1], [4], [0], [0], [1])
    >>> argument(plain(graph)) == graph, argument([1, 2])
    (True, array([1., 2.]))
    """
    if isinstance(data, dict):
        return (PoseGraph if "n_poses" in data else Ranging)(**data)
    return np.array(data, dtype=np.float64)

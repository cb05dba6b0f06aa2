"""Measure how long one system H dx = -b takes, dense and sparse; for staff, needs scipy.

`python reference_solution/solve_times.py` writes solve_times.json beside itself; the handout draws it.
"""

from __future__ import annotations

import importlib
import json
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

SIZES = (30, 100, 300, 1000, 3000)


def system(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Build H as a list of entries (rows, columns, values), and b: a walk of n poses, a loop every ten."""
    draw = np.random.default_rng(0)
    i = np.concatenate([np.arange(n - 1), draw.integers(0, n - 1, n // 10)])
    j = np.concatenate([np.arange(1, n), draw.integers(0, n - 1, n // 10)])
    i, j = i[i != j], j[i != j]
    weight = np.full(len(i), 100.0)
    rows, columns = np.concatenate([i, j, i, j, [0]]), np.concatenate([i, j, j, i, [0]])
    return rows, columns, np.concatenate([weight, weight, -weight, -weight, [1000.0]]), draw.normal(size=n)


def best_of(times: int, work: Callable[[], object]) -> float:
    """Return the shortest of some runs [s]."""
    spent = []
    for _ in range(times):
        began = time.perf_counter()
        work()
        spent.append(time.perf_counter() - began)
    return min(spent)


def main() -> None:
    """Measure all sizes and write them down."""
    sparse: Any = importlib.import_module("scipy.sparse")
    linalg: Any = importlib.import_module("scipy.sparse.linalg")
    found: dict[str, list[tuple[int, float]]] = {"dense": [], "sparse": []}
    for n in SIZES:
        rows, columns, values, b = system(n)
        H = sparse.coo_matrix((values, (rows, columns)), shape=(n, n)).tocsc()
        full = H.toarray()
        times = 3 if n >= 1000 else 20
        found["dense"].append((n, best_of(times, partial(np.linalg.solve, full, -b))))
        found["sparse"].append((n, best_of(times, partial(linalg.spsolve, H, -b))))
    rounded = {name: [(n, float(f"{seconds:.2g}")) for n, seconds in curve] for name, curve in found.items()}
    Path(__file__).with_name("solve_times.json").write_text(json.dumps(rounded) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

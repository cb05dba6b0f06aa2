"""What numpy and the standard library may ask of the kernel: a submission that exercises them widely.

It is executed in a locked child, never imported by the grader. Each function is a part; it returns
1.0 where all is well. `refusals` says which system calls the lock refused meanwhile.
"""

# ruff: noqa: D103  # the name of a part says what it exercises

import collections
import copy
import dataclasses
import decimal
import fractions
import io
import json
import random
import re
import statistics
import sys
import textwrap
import time
import warnings

import numpy as np

GENERATOR = np.random.default_rng(0)
SQUARE = GENERATOR.normal(size=(60, 60)) + 60 * np.eye(60)


def part_arithmetic() -> float:
    return float(np.isfinite(np.sqrt(np.abs(SQUARE @ SQUARE.T)) / 3 + np.exp(-np.abs(SQUARE))).all())


def part_solve() -> float:
    return float(np.allclose(SQUARE @ np.linalg.solve(SQUARE, SQUARE[0]), SQUARE[0]))


def part_decompositions() -> float:
    u, s, v = np.linalg.svd(SQUARE)
    q, r = np.linalg.qr(SQUARE)
    root = np.linalg.cholesky(SQUARE @ SQUARE.T)
    return float(np.allclose((u * s) @ v, SQUARE) and np.allclose(q @ r, SQUARE) and np.isfinite(root).all())


def part_eigenvalues() -> float:
    values, vectors = np.linalg.eigh(SQUARE + SQUARE.T)
    np.linalg.eig(SQUARE)
    return float(np.allclose((vectors * values) @ vectors.T, SQUARE + SQUARE.T))


def part_inverses() -> float:
    np.linalg.lstsq(SQUARE, SQUARE[0], rcond=None)
    return float(np.allclose(np.linalg.inv(SQUARE), np.linalg.pinv(SQUARE)) and np.linalg.matrix_rank(SQUARE) == 60)


def part_large_products() -> float:
    large = GENERATOR.normal(size=(700, 700))
    return float(np.isfinite(large @ large).all())


def part_einsum() -> float:
    return float(
        np.allclose(np.einsum("ij,jk,kl->il", SQUARE, SQUARE, SQUARE, optimize=True), SQUARE @ SQUARE @ SQUARE)
    )


def part_fft() -> float:
    return float(np.allclose(np.fft.ifft(np.fft.fft(SQUARE)), SQUARE) and np.fft.rfft2(SQUARE).shape == (60, 31))


def part_sorting() -> float:
    numbers = GENERATOR.normal(size=200_000)
    np.unique(numbers.round(2)), np.argpartition(numbers, 5), np.lexsort((numbers, numbers))
    return float((np.diff(np.sort(numbers)) >= 0).all())


def part_random() -> float:
    np.random.seed(1)
    (
        np.random.normal(size=10),
        np.random.permutation(9),
        np.random.default_rng().random(),
        random.SystemRandom().random(),
    )
    return float(len({random.random() for _ in range(9)}) == 9)


def part_polynomials() -> float:
    return float(
        np.allclose(np.polynomial.Polynomial.fit(range(9), range(9), 2)(3), 3) and np.roots([1, -3, 2])[0] == 2
    )


def part_masked() -> float:
    return float(np.ma.masked_invalid([1.0, np.nan]).mean())


def part_dates() -> float:
    return float(
        np.arange("2020-01", "2020-03", dtype="datetime64[D]").size == 60
        and np.datetime64("now") > np.datetime64(0, "s")
    )


def part_text() -> float:
    return float(
        np.char.upper(np.array(["a"]))[0] == "A" and len(repr(SQUARE)) > 100 and "nan" in str(np.array([np.nan]))
    )


def part_files_in_memory() -> float:
    buffer = io.BytesIO()
    np.save(buffer, SQUARE)
    buffer.seek(0)
    text = io.StringIO()
    np.savetxt(text, SQUARE[:2])
    return float((np.load(buffer) == SQUARE).all() and np.loadtxt(io.StringIO(text.getvalue())).shape == (2, 60))


def part_records() -> float:
    table = np.zeros(3, [("a", float), ("b", "U5")])
    table["a"] = 1
    windows = np.lib.stride_tricks.sliding_window_view(SQUARE, (3, 3))
    return float(table.view(np.recarray).a.sum() == 3 and windows.shape == (58, 58, 3, 3))


def part_large_arrays() -> float:
    many = [np.ones(1_000_000) for _ in range(20)]
    many[0].resize(2_000_000, refcheck=False)
    return float(sum(array.sum() for array in many) == 20_000_000)


def part_warnings() -> float:
    with np.errstate(all="warn"):
        np.array([1.0]) / 0
    warnings.warn("a warning that is shown", stacklevel=1)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        np.array([0.0]) / 0
    return float(len(caught) == 1)


def part_errors() -> float:
    try:
        np.linalg.inv(np.zeros((2, 2)))
    except np.linalg.LinAlgError:
        return 1.0
    return 0.0


def part_recursion() -> float:
    sys.setrecursionlimit(20_000)

    def depth(n: int) -> int:
        return 0 if n == 0 else 1 + depth(n - 1)

    return float(depth(15_000) == 15_000)


def part_library() -> float:
    @dataclasses.dataclass
    class Pair:
        a: float
        b: list[float] = dataclasses.field(default_factory=list)

    copy.deepcopy(Pair(1.0)), collections.Counter("aab"), textwrap.dedent(" x"), json.dumps({"a": [1.5]})
    statistics.stdev([1, 2, 3]), decimal.Decimal(2).sqrt(), re.sub(r"\d+", "", "a1")
    return float(fractions.Fraction(0.5) == fractions.Fraction(1, 2))


def part_clocks() -> float:
    begun = time.perf_counter()
    time.sleep(0.01)
    time.time(), time.process_time(), time.monotonic(), time.strftime("%Y"), time.get_clock_info("time")
    return float(time.perf_counter() > begun)


def part_printing() -> float:
    print(SQUARE)
    print("ü", file=sys.stderr, flush=True)
    return 1.0


def part_exhaustion() -> float:
    try:
        np.ones((1 << 40,))
    except MemoryError:
        return 1.0
    return 0.0

"""Calls a function of a submission for every case of a batch, and gathers the values into one frame."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain
from types import ModuleType
from typing import Any

import numpy as np

from .failures import classify, clean, located
from .frames import (
    MAX_DIMENSIONS,
    MAX_REASONS,
    Argument,
    Array,
    Batch,
    BatchReport,
    GraphData,
    Kind,
    Outcome,
    RangingData,
)
from .values import BadValue, described, flatten

_FLOAT64 = np.dtype("<f8")

# What a call is made of; the first form that fits, for speed:
# f(x, graph): the array, its bytes, and the companion; else None, b"", None;
# f(J, omega, f): all arrays and their bytes; else empty;
# anything else: the arguments as they are, and the places, arrays and bytes of those that are copied.
_Case = tuple[Any, bytes, Any, list[Any], list[bytes], tuple[Any, ...], tuple[tuple[int, Any, bytes], ...]]


@dataclass(frozen=True)
class Plan:
    """A batch made ready: every array and every graph built, nothing left to decode."""

    function: str
    parts: int
    most: int
    cases: tuple[_Case, ...]


Shared = dict[tuple[str, bytes], Any]
"""Arrays by their type and bytes."""


def build_object(data: GraphData | RangingData, posegraph: ModuleType, shared: Shared) -> Any:
    """Build a graph or a ranging from its bytes.

    Equal arrays are one array: most graphs of the exam differ from another in a single field, and
    whatever a child touches is copied for it, page by page.
    """
    if isinstance(data, GraphData):
        built = posegraph.PoseGraph(
            n_poses=data.n_poses,
            edges=np.frombuffer(data.edges, "<i8").reshape(-1, 2),
            measurements=np.frombuffer(data.measurements, "<f8"),
            edge_variances=np.frombuffer(data.edge_variances, "<f8"),
            priors=np.frombuffer(data.priors, "<i8"),
            prior_means=np.frombuffer(data.prior_means, "<f8"),
            prior_variances=np.frombuffer(data.prior_variances, "<f8"),
        )
    else:
        built = posegraph.Ranging(
            beacon=np.frombuffer(data.beacon, "<f8"),
            poses=np.frombuffer(data.poses, "<i8"),
            ranges=np.frombuffer(data.ranges, "<f8"),
            variances=np.frombuffer(data.variances, "<f8"),
        )
    for name, value in vars(built).items():
        if type(value) is np.ndarray:
            kind = f"{value.dtype} {value.ndim}"
            object.__setattr__(built, name, shared.setdefault((kind, value.tobytes()), value))
    return built


def prepare(batch: Batch, objects: Sequence[Any], posegraph: ModuleType, shared: Shared | None = None) -> Plan:
    """Make a batch ready to be called."""
    shared = {} if shared is None else shared
    cases = tuple(_case([argument(each, objects, posegraph, shared) for each in case]) for case in batch.cases)
    return Plan(batch.function, batch.parts, batch.max_elements, cases)


def argument(data: Argument, objects: Sequence[Any], posegraph: ModuleType, shared: Shared) -> Any:
    """Build one argument of a call: an object by its number, an array, or an object from its bytes."""
    if isinstance(data, int):
        return objects[data]
    if isinstance(data, Array):
        value = np.frombuffer(data.data, "<f8").reshape(data.shape)
        return shared.setdefault((str(data.shape), data.data), value)
    return build_object(data, posegraph, shared)


def _case(arguments: list[Any]) -> _Case:
    copied = tuple(
        (place, value, value.tobytes()) for place, value in enumerate(arguments) if type(value) is np.ndarray
    )
    if len(arguments) == 2 and len(copied) == 1 and copied[0][0] == 0:
        return copied[0][1], copied[0][2], arguments[1], [], [], (), ()
    if arguments and len(copied) == len(arguments):
        return None, b"", None, arguments, [before for _, _, before in copied], (), ()
    return None, b"", None, [], [], tuple(arguments), copied


def call(plan: Plan, function: Callable[..., Any] | None, nonce: int) -> BatchReport:
    """Call the function for every case; an undefined function leaves every case unfinished."""
    values = len(plan.cases) * plan.parts
    if function is None:
        outcome = bytes([Outcome.UNFINISHED]) * len(plan.cases)
        reasons = {"not defined": array("i", range(len(plan.cases))).tobytes()} if plan.cases else {}
        return BatchReport(nonce, outcome, bytes(values), bytes(values), b"", b"", reasons, -1)
    gathered = _Gathered(plan)
    gathered.call(function)
    return BatchReport(
        nonce,
        bytes(gathered.outcome),
        bytes(gathered.kinds),
        bytes(map(len, gathered.shapes)),
        array("q", chain.from_iterable(gathered.shapes)).tobytes(),
        b"".join(gathered.data),
        {reason: calls.tobytes() for reason, calls in gathered.reasons.items()},
        gathered.mutated,
    )


class _Gathered:
    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.outcome = bytearray(len(plan.cases))  # zero is Outcome.OK
        self.kinds = bytearray(len(plan.cases) * plan.parts)  # zero is Kind.FLOAT_ARRAY
        self.shapes: list[tuple[int, ...]] = []
        self.data: list[bytes] = []
        self.reasons: dict[str, array[int]] = {}
        self.mutated = -1

    def call(self, function: Callable[..., Any]) -> None:  # noqa: PLR0912  # one loop for all forms of a call, for speed
        """Make the calls. Every name used in the loop is local: a case costs about a microsecond."""
        single, most, float64, ndarray = self.plan.parts == 1, self.plan.most, _FLOAT64, np.ndarray
        shapes, data = self.shapes.append, self.data.append
        for number, (first, original, companion, sources, originals, template, copied) in enumerate(self.plan.cases):
            x, arguments = None, []
            try:
                if first is not None:
                    x = first.copy()
                    value = function(x, companion)
                elif sources:
                    arguments = [source.copy() for source in sources]
                    value = function(*arguments)
                else:
                    arguments = list(template)
                    for place, source, _ in copied:
                        arguments[place] = source.copy()
                    value = function(*arguments)
                if (
                    single
                    and type(value) is ndarray
                    and value.dtype is float64
                    and 0 < value.size <= most
                    and value.ndim <= MAX_DIMENSIONS
                ):
                    data(value.tobytes())
                    shapes(value.shape)
                else:
                    self._take(number, value)
            except BadValue as error:
                self._refuse(number, Outcome.BAD_VALUE, clean(str(error)))
            except BaseException as error:  # noqa: BLE001  # whatever a call raises, the next case counts
                outcome, text = classify(error)
                self._refuse(number, outcome, located(error, text) if outcome is Outcome.RAISED else text)
            if self.mutated < 0:
                if x is not None:
                    if x.tobytes() != original:
                        self.mutated = number
                elif originals:
                    if arguments and [argument.tobytes() for argument in arguments] != originals:
                        self.mutated = number
                elif arguments and any(arguments[place].tobytes() != before for place, _, before in copied):
                    self.mutated = number

    def _take(self, number: int, value: Any) -> None:
        parts, most = self.plan.parts, self.plan.most
        items = [value] if parts == 1 else _parts(value, parts)
        flat: list[tuple[tuple[int, ...], bytes, Kind]] = []
        for place, item in enumerate(items):
            if (
                type(item) is np.ndarray
                and item.dtype is _FLOAT64
                and 0 < item.size <= most
                and item.ndim <= MAX_DIMENSIONS
            ):
                flat.append((item.shape, item.tobytes(), Kind.FLOAT_ARRAY))
                continue
            try:
                flat.append(flatten(item, most))
            except BadValue as error:
                raise BadValue(f"value {place + 1} of {parts}: {error}" if parts > 1 else str(error)) from None
        for place, (shape, data, kind) in enumerate(flat):
            self.shapes.append(shape)
            self.data.append(data)
            self.kinds[number * parts + place] = kind

    def _refuse(self, number: int, outcome: Outcome, reason: str) -> None:
        parts = self.plan.parts
        del self.shapes[number * parts :], self.data[number * parts :]
        self.shapes.extend([()] * parts)
        self.data.extend([b""] * parts)
        self.kinds[number * parts : (number + 1) * parts] = bytes([Kind.OTHER]) * parts
        self.outcome[number] = outcome
        if reason in self.reasons or len(self.reasons) < MAX_REASONS:
            self.reasons.setdefault(reason, array("i")).append(number)


def _parts(value: Any, parts: int) -> list[Any]:
    if type(value) is tuple and len(value) == parts:
        return list(value)
    for kind in (tuple, list):
        if issubclass(type(value), kind):
            items = list(kind.__iter__(value))
            if len(items) == parts:
                return items
            break
    raise BadValue(f"{described(value)}, expected {parts} values")

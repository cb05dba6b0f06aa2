"""The corpus: every case of a run, drawn once from the seed; it travels as bytes and is known by its digest."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import msgspec
import numpy as np

from assignment.posegraph import PoseGraph, Ranging
from autograder.problems.apart import ladder_apart, set_apart
from autograder.problems.cases import Case, fields
from autograder.problems.ladders import Ladder
from autograder.stages.base import Stage

Rungs = dict[str, tuple[Case, ...]]


@dataclass(frozen=True)
class Corpus:
    """The cases of every ladder, rung by rung.

    Attributes
    ----------
    cases : dict
        Ladder name to rung name to cases.
    digest : str
        SHA-256 of the corpus as bytes.
    """

    cases: dict[str, Rungs]
    data: bytes
    digest: str


@lru_cache(maxsize=8)
def draw_corpus(stages: tuple[Stage, ...], seed: int, examples: int) -> Corpus:
    """Draw the cases of all ladders that the stages climb. Only the client of a run calls this."""
    from autograder.problems.draw import draw_ladder  # noqa: PLC0415 - needs hypothesis, which a worker never loads

    ladders: dict[str, Ladder] = {stage.ladder.name: stage.ladder for stage in stages}
    found = {name: draw_ladder(ladder, seed, examples) for name, ladder in sorted(ladders.items())}
    graphs = [graph for rungs in found.values() for cases in rungs.values() for graph in _graphs(cases)]
    for ladder in {stage.ladder.name: stage.ladder for stage in stages if stage.builds_on}.values():
        cores = {rung.name: len(rung.core) for rung in ladder.rungs}
        name = ladder_apart(ladder.name)
        found[name] = set_apart(found[ladder.name], cores, graphs, f"{seed}/{name}")
    return _corpus(found)


def _graphs(cases: Iterable[Case]) -> list[PoseGraph]:
    return [argument for case in cases for argument in case if isinstance(argument, PoseGraph)]


def _corpus(cases: dict[str, Rungs]) -> Corpus:
    plain = {
        ladder: {rung: [plain_case(case) for case in found] for rung, found in rungs.items()}
        for ladder, rungs in cases.items()
    }
    data = msgspec.msgpack.encode(plain)
    return Corpus(cases, data, hashlib.sha256(data).hexdigest())


def load_corpus(data: bytes) -> Corpus:
    """Rebuild a corpus from its bytes."""
    plain = msgspec.msgpack.decode(data)
    cases = {
        ladder: {rung: tuple(case_of(case) for case in found) for rung, found in rungs.items()}
        for ladder, rungs in plain.items()
    }
    return Corpus(cases, data, hashlib.sha256(data).hexdigest())


def plain_case(case: Case) -> list[Any]:
    """Turn a case into lists and bytes that msgpack can carry."""
    return [_plain(argument) for argument in case]


def case_of(plain: list[Any]) -> Case:
    """Rebuild a case from what `plain_case` made."""
    return tuple(_value(item) for item in plain)


def _plain(argument: Any) -> list[Any]:
    if isinstance(argument, PoseGraph):
        return ["graph", argument.n_poses, *(_bytes(array) for array in fields(argument)[1:])]
    if isinstance(argument, Ranging):
        return ["ranging", *(_bytes(array) for array in fields(argument))]
    return ["array", list(argument.shape), _bytes(argument)]


def _bytes(array: np.ndarray) -> bytes:
    kind = "<i8" if array.dtype.kind == "i" else "<f8"
    return array.astype(kind).tobytes()


def _value(item: list[Any]) -> Any:
    if item[0] == "array":
        return np.frombuffer(item[2], dtype="<f8").reshape(item[1])
    if item[0] == "ranging":
        return Ranging(*(np.frombuffer(each, dtype="<i8" if at == 1 else "<f8") for at, each in enumerate(item[1:])))
    _, n_poses, edges, measurements, variances, priors, means, prior_variances = item
    return PoseGraph(
        n_poses,
        np.frombuffer(edges, dtype="<i8").reshape(-1, 2),
        np.frombuffer(measurements, dtype="<f8"),
        np.frombuffer(variances, dtype="<f8"),
        np.frombuffer(priors, dtype="<i8"),
        np.frombuffer(means, dtype="<f8"),
        np.frombuffer(prior_variances, dtype="<f8"),
    )

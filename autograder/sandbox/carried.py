"""What frames carry: arrays, graphs, the calls of a batch, and tables of answers."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct


class Frame(Struct, array_like=True, forbid_unknown_fields=True):
    """Base of all frames: a tagged msgpack array without surplus fields."""


class Array(Frame, tag="array"):
    """A float64 array, little endian, in C order."""

    shape: tuple[int, ...]
    data: bytes


class GraphData(Frame, tag="graph"):
    """The fields of a PoseGraph; integer fields as int64 bytes, the others as float64 bytes."""

    n_poses: int
    edges: bytes
    measurements: bytes
    edge_variances: bytes
    priors: bytes
    prior_means: bytes
    prior_variances: bytes


class RangingData(Frame, tag="ranging"):
    """The fields of a Ranging; `poses` as int64 bytes, the others as float64 bytes."""

    beacon: bytes
    poses: bytes
    ranges: bytes
    variances: bytes


Argument = int | Array | GraphData | RangingData


class Batch(Frame, tag="batch"):
    """Calls of one function: `function(*arguments)` for every case, in order.

    Each call returns `parts` arrays. A value with more than `max_elements` elements is refused
    and only its shape reported. An integer argument is an index into `Inputs.objects`.
    """

    function: str
    parts: int
    max_elements: int
    cases: list[list[Argument]]


class Part(Frame, tag="part"):
    """One array of an answer: a constant, or a constant plus a factor times the vector that is given."""

    constant: Array
    factor: Array | None


class Entry(Frame, tag="entry"):
    """What a function answers where some of its arguments are these."""

    key: list[Argument]
    parts: list[Part]


class Table(Frame, tag="table"):
    """What one function answers: numbers, by its arguments in the places `keys`.

    `vector` is the place of the vector that factors multiply, -1 where there is none. The answer has
    the form that the submission's own function has given it: `shapes` says of each part whether a
    vector comes as it is (""), as a column or as a row.
    """

    function: str
    keys: list[int]
    vector: int
    shapes: list[Literal["", "column", "row"]]
    kind: Literal["array", "list", "matrix"]
    entries: list[Entry]

"""What goes to the sandbox: calls as batches, graphs and arrays as bytes, each graph once and then by number."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from assignment.posegraph import PoseGraph, Ranging
from autograder.problems.cases import Case
from autograder.sandbox import carried, frames
from autograder.stages.base import Stage
from autograder.stages.earlier import Answers

Shared = PoseGraph | Ranging
SLACK = 16  # numbers that an answer may hold beyond twice the expected ones before only its shape is reported


def joined(batches: Sequence[frames.Batch]) -> frames.Batch:
    """Make one batch of several of one function."""
    return frames.Batch(
        function=batches[0].function,
        parts=batches[0].parts,
        max_elements=max(batch.max_elements for batch in batches),
        cases=[case for batch in batches for case in batch.cases],
    )


def batch_of(stage: Stage, calls: Sequence[Case], objects: Mapping[Shared, int]) -> frames.Batch:
    """Make a batch of calls; graphs that have a number go by it."""
    largest = max((math.prod(shape) for call in calls for shape in stage.shapes(*call)), default=0)
    return frames.Batch(
        function=stage.function,
        parts=stage.parts,
        max_elements=2 * largest + SLACK,
        cases=[[_argument(argument, objects) for argument in call] for call in calls],
    )


def identity(case: Sequence[frames.Argument]) -> Any:
    """Tell calls apart: graphs of the corpus go by number, arrays by shape and bytes."""
    return tuple((each.shape, each.data) if isinstance(each, frames.Array) else each for each in case)


def _argument(argument: Any, objects: Mapping[Shared, int]) -> frames.Argument:
    if isinstance(argument, PoseGraph | Ranging):
        known = objects.get(argument)
        return shared_data(argument) if known is None else known
    return array_data(argument)


def table_of(known: Answers, objects: Mapping[Shared, int]) -> frames.Table:
    """Turn what a function answers into a table for the sandbox; graphs go by number."""
    entries = [
        carried.Entry(
            [_argument(each, objects) for each in key],
            [
                carried.Part(array_data(constant), None if factor is None else array_data(factor))
                for constant, factor in parts
            ],
        )
        for key, parts in known.rows
    ]
    shapes: list[Literal["", "column", "row"]] = [""] * len(known.rows[0][1])
    return frames.Table(known.function, list(known.places), known.vector, shapes, "array", entries)


def array_data(values: np.ndarray) -> frames.Array:
    """Turn an array into bytes for the sandbox."""
    return frames.Array(values.shape, np.asarray(values, dtype="<f8").tobytes())


def shared_data(graph: Shared) -> frames.GraphData | frames.RangingData:
    """Turn a graph or a ranging into bytes for the sandbox."""
    if isinstance(graph, Ranging):
        return frames.RangingData(
            beacon=graph.beacon.astype("<f8").tobytes(),
            poses=graph.poses.astype("<i8").tobytes(),
            ranges=graph.ranges.astype("<f8").tobytes(),
            variances=graph.variances.astype("<f8").tobytes(),
        )
    return frames.GraphData(
        n_poses=graph.n_poses,
        edges=graph.edges.astype("<i8").tobytes(),
        measurements=graph.measurements.astype("<f8").tobytes(),
        edge_variances=graph.edge_variances.astype("<f8").tobytes(),
        priors=graph.priors.astype("<i8").tobytes(),
        prior_means=graph.prior_means.astype("<f8").tobytes(),
        prior_variances=graph.prior_variances.astype("<f8").tobytes(),
    )

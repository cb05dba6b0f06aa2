"""The floor: a forked child of a warm process makes exactly the grader's calls on ready inputs; nothing is judged.

Runs as a process of its own: `python -m tests.benchmarks.floor`, inputs and sources on standard input.
"""

import gc
import os
import resource
import sys
import time
import types

import msgspec
import numpy as np

from assignment import posegraph
from autograder.sandbox import frames


class Work(msgspec.Struct):
    """What the floor is told: the inputs of the sandbox, second rounds, and texts to run."""

    inputs: bytes
    again: list[int]
    texts: list[str]


def ready(inputs: bytes, checks: int):
    """Build all arguments once, of the checks alone: what else is in the inputs asks the same calls again."""
    told = frames.decode(inputs, frames.Inputs)
    objects = [graph(each) for each in told.objects]
    return [
        (batch.function, [[value(each, objects) for each in case] for case in batch.cases])
        for batch in told.batches[:checks]
    ]


def graph(data):
    """Rebuild a graph or a ranging."""

    def real(raw):
        return np.frombuffer(raw, "<f8")

    if isinstance(data, frames.RangingData):
        return posegraph.Ranging(
            real(data.beacon), np.frombuffer(data.poses, "<i8"), real(data.ranges), real(data.variances)
        )
    return posegraph.PoseGraph(
        data.n_poses,
        np.frombuffer(data.edges, "<i8").reshape(-1, 2),
        real(data.measurements),
        real(data.edge_variances),
        np.frombuffer(data.priors, "<i8"),
        real(data.prior_means),
        real(data.prior_variances),
    )


def value(argument, objects):
    """Rebuild one argument."""
    if isinstance(argument, int):
        return objects[argument]
    return np.frombuffer(argument.data, "<f8").reshape(argument.shape)


def run(text, batches, again):
    """Execute a submission and make all calls, the second rounds too."""
    module = types.ModuleType("slam1d")
    exec(compile(text, "slam1d", "exec"), module.__dict__)  # our own texts only
    for number, (name, cases) in enumerate(batches):
        function = getattr(module, name)
        values = [function(*[each.copy() if type(each) is np.ndarray else each for each in case]) for case in cases]
        for (x, each), dx in list(zip(cases, values, strict=True))[: again[number]]:  # as many as there are loops
            function(x + dx, each)


def main():
    """Run every text in a forked child; print the wall and processor seconds of all, and the memory of the largest."""
    work = msgspec.msgpack.decode(sys.stdin.buffer.read(), type=Work)
    batches = ready(work.inputs, len(work.again))
    sys.modules["posegraph"] = posegraph
    gc.collect()
    gc.freeze()
    began, before = time.perf_counter(), time.process_time()
    for text in work.texts:
        pid = os.fork()
        if pid == 0:
            try:
                run(text, batches, work.again)
            finally:
                os._exit(0)
        os.waitpid(pid, 0)
    wall = time.perf_counter() - began
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    busy = used.ru_utime + used.ru_stime + time.process_time() - before
    sys.stdout.write(f"{wall} {busy} {used.ru_maxrss / 1024}\n")


if __name__ == "__main__":
    main()

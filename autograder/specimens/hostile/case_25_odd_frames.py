# expect: residual=passed jacobian=error information_matrix=error normal_equations=error gauss_newton_step=error second_step=error others=missing; 25: sends a side of negative length, a nonce of 2^64 - 1, and an array that is nested 100,000 deep.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import os
import sys
import time

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


frames = sys.modules["sandbox.frames"]
array = sys.modules["array"].array


def asked():
    """Find the nonce of the request and the plan of its calls in the frames above."""
    frame = sys._getframe(1)
    while "nonce" not in frame.f_locals or "plan" not in frame.f_locals:
        frame = frame.f_back
    return frame.f_locals["nonce"], frame.f_locals["plan"]


def forged(nonce, plan):
    """Make a reply of the right form, in which every value is one number."""
    values = len(plan.cases) * plan.parts
    sizes, data = array("q", [1] * values).tobytes(), array("d", [7.5] * values).tobytes()
    zeros = bytes(len(plan.cases)), bytes(values)
    return frames.pack(frames.BatchReport(nonce, *zeros, bytes([1]) * values, sizes, data, {}, -1))


def send(body):
    os.write(3, len(body).to_bytes(4, "little") + body)
    while True:
        time.sleep(1)


def jacobian(x, graph):
    nonce, plan = asked()
    values = len(plan.cases)
    sizes = array("q", [-5] * values).tobytes()
    frame = frames.BatchReport(nonce, bytes(values), bytes(values), bytes([1]) * values, sizes, b"", {}, -1)
    send(sys.modules["msgspec"].msgpack.encode(frame))


def information_matrix(graph):
    send(sys.modules["msgspec"].msgpack.encode(["results", 2**64 - 1, b"", b"", b"", b"", b"", {}, -1]))


def normal_equations(J, omega, f):
    send(b"\x91" * 100_000)


def gauss_newton_step(x, graph):
    nonce, plan = asked()
    values = len(plan.cases)
    sizes = array("q", [2**40] * values).tobytes()
    frame = frames.BatchReport(nonce, bytes(values), bytes(values), bytes([1]) * values, sizes, b"", {}, -1)
    send(sys.modules["msgspec"].msgpack.encode(frame))

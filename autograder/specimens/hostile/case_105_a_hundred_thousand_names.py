# expect: residual=passed answers=failed written=awaiting_mark others=missing; 105: defines 100,000 functions and raises in many statements.
# attack: exhaustion; unlocked fails: an end without a value is no value.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


for number in range(100_000):
    globals()[f"function_{number}"] = residual
globals()["x" * 10_000_000] = residual
globals()["\x1b[31m"] = residual
written_2 = "x" * 10_000_000
written_3 = "x" * 20_000
conclusion = "\ud800" * 300
iterates = np.zeros((4, 1000))
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)
raise ValueError("\x1b[31m" + "no" * 10**6)

# expect: residual=passed jacobian=failed others=missing; 16: prints a report that says that it passed.
# attack: forging; unlocked fails: the channel is checked by the grader, whatever is locked.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


REPORT = '{"submission": "case_16_print_a_report", "status": "graded", "score": 100.0, "stages": []}'


def jacobian(x, graph):
    print(REPORT)
    print(REPORT, file=sys.__stderr__, flush=True)
    print("jacobian PASSED 15/15")
    return np.full((graph.n_factors, graph.n_poses), 7.5)


print(REPORT, flush=True)

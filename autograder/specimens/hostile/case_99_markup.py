# expect: residual=passed jacobian=error information_matrix=failed answers=failed written=awaiting_mark others=missing; 99: puts HTML, a script, a formula and terminal escapes into everything that is shown.
# attack: text; unlocked fails: everything that is shown is escaped.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


MARKUP = "<script>alert('slam1d-hostile-99')</script><img src=x onerror=alert(1)>\x1b[31m=HYPERLINK(\"x\")\u202e"


def jacobian(x, graph):
    raise type("Error<b>", (Exception,), {})(MARKUP)


def information_matrix(graph):
    return type("<script>alert('slam1d-hostile-99')</script>", (), {})()


conclusion = MARKUP
written_2 = written_3 = MARKUP
raise ValueError(MARKUP)

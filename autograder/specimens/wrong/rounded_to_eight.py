# expect: residual=partial:residual_rounded others=missing; f is rounded to eight decimals.
import numpy as np
def residual(x, graph):
    i, j = graph.edges.T
    return np.round(np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means]), 8)

# expect: residual=failed:residual_in_single_precision others=missing; f is stored in single precision.
import numpy as np
def residual(x, graph):
    f = np.zeros(graph.n_factors, dtype=np.float32)
    k = len(graph.edges)
    for r, (i, j) in enumerate(graph.edges):
        f[r] = x[i] + graph.measurements[r] - x[j]
    for r, p in enumerate(graph.priors):
        f[k + r] = x[p] - graph.prior_means[r]
    return f

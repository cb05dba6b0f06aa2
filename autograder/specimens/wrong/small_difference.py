# expect: residual=passed jacobian=partial:difference_step_too_small others=missing; J is a difference with h = 1e-8.
import numpy as np
def residual(x, graph):
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])
def jacobian(x, graph):
    f0 = residual(x, graph); J = np.zeros((len(f0), len(x)))
    for c in range(len(x)):
        y = x.copy(); y[c] += 1e-8
        J[:, c] = (residual(y, graph) - f0) / 1e-8
    return J

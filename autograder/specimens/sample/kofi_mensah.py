# expect: jacobian=partial:jacobian_of_worked_example gauss_newton_step=partial+follow_through second_step=partial+follow_through others=passed remark=integers; the 6 by 5 Jacobian of the worked example, typed in.
import numpy as np


def residual(x, graph):
    f = []
    for n in range(len(graph.edges)):
        i, j = graph.edges[n]
        f.append(x[i] + graph.measurements[n] - x[j])
    for n in range(len(graph.priors)):
        f.append(x[graph.priors[n]] - graph.prior_means[n])
    return np.array(f)


def jacobian(x, graph):
    return np.array(
        [
            [1, -1, 0, 0, 0],
            [0, 1, -1, 0, 0],
            [0, 0, 1, -1, 0],
            [0, 0, 0, 1, -1],
            [1, 0, 0, 0, -1],
            [1, 0, 0, 0, 0],
        ]
    )


def information_matrix(graph):
    variances = np.concatenate([graph.edge_variances, graph.prior_variances])
    return np.linalg.inv(np.diag(variances))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    J = jacobian(x, graph)
    f = residual(x, graph)
    omega = information_matrix(graph)
    H, b = normal_equations(J, omega, f)
    return -np.linalg.inv(H) @ b

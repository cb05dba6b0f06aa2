# expect: others=passed remark=row_order; style 22: rows of np.diff(eye) for neighbours, in their order, and extra rows below.
import numpy as np


def ordered(graph):
    """Edges between neighbours along the chain, then all others."""
    return sorted(range(len(graph.edges)), key=lambda r: (abs(np.diff(graph.edges[r])[0]) > 1, min(graph.edges[r])))


def jacobian(x, graph):
    n = graph.n_poses
    D = -np.diff(np.eye(n), axis=0)
    rows = []
    for r in ordered(graph):
        i, j = graph.edges[r]
        if abs(i - j) == 1:
            rows.append(D[min(i, j)] * (1.0 if i < j else -1.0))
        else:
            rows.append(np.eye(n)[i] - np.eye(n)[j])
    return np.vstack([*rows, *np.eye(n)[graph.priors]])


def residual(x, graph):
    z = np.concatenate([graph.measurements[ordered(graph)], -graph.prior_means])
    return jacobian(x, graph) @ x + z


def information_matrix(graph):
    return np.diag(1.0 / np.concatenate([graph.edge_variances[ordered(graph)], graph.prior_variances]))


def normal_equations(J, omega, f):
    H = J.T @ omega @ J
    b = J.T @ omega @ f
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)

# expect: others=passed; imports scipy and does not use it, plots with matplotlib.
import numpy as np
import matplotlib.pyplot as plt
import scipy.sparse as sparse  # for the bonus, some day
from tqdm import tqdm


def residual(x, graph):
    f = [x[i] + u - x[j] for (i, j), u in zip(graph.edges, graph.measurements)]
    f += [x[k] - mean for k, mean in zip(graph.priors, graph.prior_means)]
    return np.array(f)


def jacobian(x, graph):
    # central differences
    h = 1e-6
    columns = []
    for k in range(graph.n_poses):
        e = np.zeros(graph.n_poses)
        e[k] = h
        columns.append((residual(x + e, graph) - residual(x - e, graph)) / (2 * h))
    return np.array(columns).T


def information_matrix(graph):
    return np.diag(1 / np.concatenate([graph.edge_variances, graph.prior_variances]))


def normal_equations(J, omega, f):
    w = np.diag(omega)
    return (J.T * w) @ J, J.T @ (w * f)


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)


def show(x):
    plt.plot(x, np.zeros_like(x), "o-")
    plt.title("poses")
    plt.show()


for _ in tqdm(range(3)):
    show(np.array([0.0, 1.0, 1.9, 2.9, 0.1]))


# My answers, for the worked example.
iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1]])
conclusion = "C"
written_2 = "dx is about 1e-16, which is rounding."
written_3 = "Yes: linear, so the quadratic model of the cost is the cost."

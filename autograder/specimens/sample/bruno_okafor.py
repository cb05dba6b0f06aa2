# expect: others=passed remark=lists; loops and lists, inverts both the covariance and H.
import numpy as np
from posegraph import PoseGraph


def residual(x, graph):
    f = []
    for (i, j), u in zip(graph.edges, graph.measurements):
        predicted = x[i] + u
        f.append(predicted - x[j])
    for k, mean in zip(graph.priors, graph.prior_means):
        f.append(x[k] - mean)
    return f


def jacobian(x, graph):
    J = []
    for i, j in graph.edges:
        row = [0] * graph.n_poses
        row[i] = 1
        row[j] = -1
        J.append(row)
    for k in graph.priors:
        row = [0] * graph.n_poses
        row[k] = 1
        J.append(row)
    return J


def information_matrix(graph):
    m = graph.n_factors
    covariance = np.zeros((m, m))
    for r, v in enumerate(list(graph.edge_variances) + list(graph.prior_variances)):
        covariance[r, r] = v
    return np.linalg.inv(covariance)


def normal_equations(J, omega, f):
    J, f = np.array(J), np.array(f)
    H = np.dot(np.dot(J.T, omega), J)
    b = np.dot(np.dot(J.T, omega), f)
    return H, b


def gauss_newton_step(x, graph):
    f = residual(x, graph)
    J = jacobian(x, graph)
    H, b = normal_equations(J, information_matrix(graph), f)
    return -np.linalg.inv(H) @ b


# try it on the example of the handout
if __name__ == "__main__":
    g = PoseGraph(
        5, [(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)], [1.1, 1.0, 1.1, -2.7, 0.0], [0.01] * 5, [0], [0.0], [0.001]
    )
    x = g.dead_reckoning()
    for step in range(3):
        x = x + gauss_newton_step(x, g)
        print(step, x)


# My answers, for the worked example.
iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1]])
conclusion = "C"
written_2 = "The second and third step are zero."
written_3 = "The problem is linear least squares."

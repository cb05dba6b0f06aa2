# expect: information_matrix=failed:covariance_used_as_information gauss_newton_step=partial+follow_through others=passed; covariance used as information, in another style.
import numpy as np


def residual(x, graph):
    x0, x1 = x[graph.edges].T
    return np.hstack([x0 - x1 + graph.measurements, x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    incidence = np.zeros((len(graph.edges), graph.n_poses))
    np.put_along_axis(incidence, graph.edges[:, :1], 1, axis=1)
    np.put_along_axis(incidence, graph.edges[:, 1:], -1, axis=1)
    return np.vstack([incidence, np.identity(graph.n_poses)[graph.priors]])


def information_matrix(graph):
    sigma = np.hstack([graph.edge_variances, graph.prior_variances])
    return sigma * np.identity(sigma.size)


def normal_equations(J, omega, f):
    H = J.transpose().dot(omega).dot(J)
    b = J.transpose().dot(omega).dot(f)
    return H, b


def gauss_newton_step(x, graph):
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.lstsq(H, -b, rcond=None)[0]


# My answers, for the worked example.
iterates = np.array([[0, 1.1, 2.1, 3.2, 0.5], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1], [0, 1.0, 1.9, 2.9, 0.1]])
conclusion = "D"
written_2 = "Zero."
written_3 = "The loop is closed now."

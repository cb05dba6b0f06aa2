# expect: residual=passed information_matrix=forbidden normal_equations=forbidden gauss_newton_step=forbidden second_step=forbidden others=missing; 95: writes forbidden names in letters that Python reads as others.
# attack: text; unlocked fails: names are compared after Python has read them.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


import ｓｏｃｋｅｔ
from ｓｕｂｐｒｏｃｅｓｓ import run

𝐞𝐯𝐚𝐥("1 + 1")


def jаcobian(x, graph):  # the second letter is Cyrillic
    return np.zeros((graph.n_factors, graph.n_poses))


def information_matrix(graph):
    return ｓｏｃｋｅｔ.socket()


def normal_equations(J, omega, f):
    return 𝐞𝐱𝐞𝐜("import autograder") or run("id")


gauss_newton_step = 𝐞𝐯𝐚𝐥("lambda x, graph: __import__('ctypes').CDLL(None)")

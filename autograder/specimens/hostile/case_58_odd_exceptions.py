# expect: residual=passed jacobian=error information_matrix=error normal_equations=error gauss_newton_step=error second_step=error others=missing; 58: raises exceptions that pass through `except Exception`.
# attack: leaving; unlocked fails: an end without a value is no value.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def jacobian(x, graph):
    raise KeyboardInterrupt


def information_matrix(graph):
    raise GeneratorExit("passed")


def normal_equations(J, omega, f):
    raise BaseExceptionGroup("all", [SystemExit(0), KeyboardInterrupt()])


def gauss_newton_step(x, graph):
    raise type("Passed", (BaseException,), {"__module__": "builtins"})


raise KeyboardInterrupt

# expect: residual=passed jacobian=failed information_matrix=failed normal_equations=failed others=missing; 36: defines a module-level __getattr__ and functions that are objects of odd classes.
# attack: patching; unlocked fails: values are judged outside, whatever is patched in the child.
import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


class Meta(type):
    def __call__(cls, *arguments):
        return cls

    def __instancecheck__(cls, other):
        return True

    def __eq__(cls, other):
        return True

    def __hash__(cls):
        return 0

    def __getattribute__(cls, name):
        return type.__getattribute__(cls, name) if name.startswith("__") else cls


class jacobian(metaclass=Meta):
    __module__ = "reference_solution.slam1d"


class information_matrix:
    __name__ = property(lambda self: 1 / 0)

    def __new__(cls, graph):
        return cls


def __getattr__(name):
    return lambda *_: 1.0


globals()["normal_equations"] = type("N", (), {"__call__": lambda *_: ("H", "b")})()

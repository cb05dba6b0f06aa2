# expect: residual=passed jacobian=error information_matrix=error normal_equations=failed gauss_newton_step=forbidden second_step=forbidden answers=failed others=missing; 98: prints the inputs that it is given, and raises them as the text of an exception.
# attack: text; unlocked fails: what students may see is decided by the grader.
import sys

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


def told(x, graph):
    return f"leaked-by-98 n={graph.n_poses} u={graph.measurements.tolist()} x={x.tolist()}"


def jacobian(x, graph):
    print(told(x, graph), flush=True)
    raise ValueError(told(x, graph))


def information_matrix(graph):
    raise type("leaked_by_98_" + "_".join(map(str, graph.edges.ravel().tolist())), (Exception,), {})


def normal_equations(J, omega, f):
    return type("leaked_by_98_as_a_type_" + str(f.shape[0]), (), {})()


def gauss_newton_step(x, graph):
    import_name = "leaked_by_98_as_a_module_" + str(graph.n_poses)
    return __import__(import_name).x


def exam():
    """Give the inputs of the exam that lie in memory while this file is loaded."""
    frame = sys._getframe(1)
    while not hasattr(frame.f_locals.get("self"), "_plans"):
        frame = frame.f_back
    return [case[0].tolist() for plan in frame.f_locals["self"]._plans for case in plan.cases if case[0] is not None]


conclusion = "leaked-by-98"
print(exam())
raise ValueError("leaked-by-98 " + repr(exam()[-1]))
raise type("leaked_by_98_" + repr(exam()[-1]), (Exception,), {})
jacobian.leaked_by_98

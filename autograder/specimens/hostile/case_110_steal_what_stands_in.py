# expect: residual=passed jacobian=failed information_matrix=failed normal_equations=failed gauss_newton_step=partial+follow_through second_step=partial+follow_through answers=missing written=missing others=failed; 110: looks for the functions that stand in for its own, and answers with whatever it has found of them.
# attack: secrets; unlocked fails: what stands in are numbers of graphs that are used nowhere else, in a child that ends with that question.
import gc
import sys
import types

import numpy as np


def residual(x, graph):  # the honest part
    i, j = graph.edges.T
    return np.concatenate([x[i] + graph.measurements - x[j], x[graph.priors] - graph.prior_means])


hoard = {}  # what was seen by any means, by the name of the function


def look():
    """Collect everything in this process that could answer for a function of the homework, once."""
    if hoard.setdefault("calls", 0):
        return hoard
    hoard["calls"] = 1
    for module in list(sys.modules.values()):
        for name in ("Lookup", "put", "tables", "_ask"):
            if name in vars(module):
                hoard.setdefault("modules", []).append(vars(module)[name])
    for thing in gc.get_objects():
        if type(thing).__name__ == "Lookup":
            hoard[thing._name] = thing
        elif type(thing) is types.FunctionType and thing.__name__ in ("jacobian", "normal_equations"):
            hoard.setdefault("functions", []).append(thing)
    return hoard


def answer(name, *arguments):
    """Answer with a stolen function: the table, or its numbers, or any function of that name that is not ours."""
    look()
    table = hoard.get(name)
    if table is not None:
        for parts in table._found.values():
            values = tuple(constant for constant, _ in parts)
            return values if len(values) > 1 else values[0]
    for function in hoard.get("functions", []):
        if function.__name__ == name and function.__module__ != __name__:
            return function(*arguments)
    raise ValueError("nothing was found")


def guess(shape, name, *arguments):
    try:
        return answer(name, *arguments)
    except Exception:
        return np.zeros(shape)


def jacobian(x, graph):
    return guess((graph.n_factors, graph.n_poses), "jacobian", x, graph)


def information_matrix(graph):
    return guess((graph.n_factors, graph.n_factors), "information_matrix", graph)


def normal_equations(J, omega, f):
    H = np.zeros((J.shape[1], J.shape[1]))
    found = guess((1,), "normal_equations", J, omega, f)
    return found if type(found) is tuple else (H, H[0])


def gauss_newton_step(x, graph):  # right by itself
    look()
    H, b = normal_equations(jacobian(x, graph), information_matrix(graph), residual(x, graph))
    return np.linalg.solve(H, -b)

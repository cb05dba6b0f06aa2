# expect: jacobian=failed others=error; hostile, reads files, walks frames, patches numpy, writes marks, ends the process.
"""Looks for the answers instead of writing them: everything it tries is refused or worth nothing."""

import gc
import json
import os
import sys

import numpy as np


def attempt(action):
    try:
        return action()
    except BaseException:
        return None


def read(path):
    with open(path) as file:
        return file.read()


def write_marks():
    with open("results.json", "w") as file:
        json.dump({"status": "graded", "score": 100.0, "max_score": 90.0}, file)


def frames():
    frame, found = sys._getframe(), []
    while frame is not None:
        found += [frame.f_locals[name] for name in ("expected", "answer", "reference") if name in frame.f_locals]
        frame = frame.f_back
    return found


def patch_numpy():
    np.allclose = np.array_equal = lambda *args, **more: True
    np.testing.assert_allclose = lambda *args, **more: None


attempt(lambda: read("reference_solution/slam1d.py"))
attempt(lambda: read("/proc/self/environ"))
attempt(lambda: os.listdir("/"))
attempt(lambda: os.system("cp -r / stolen"))
attempt(lambda: os.kill(os.getppid(), 9))
attempt(write_marks)
attempt(patch_numpy)
loot = attempt(frames) or []
hidden = [thing for thing in gc.get_objects() if getattr(thing, "__name__", "") == "reference_solution.slam1d"]


class Agreeable(np.ndarray):
    """An array that claims to be equal to everything."""

    def __eq__(self, other):
        return np.ones(self.shape, dtype=bool)


def residual(x, graph):
    return hidden[0].residual(x, graph)


def jacobian(x, graph):
    return np.zeros((graph.n_factors, graph.n_poses)).view(Agreeable)


def information_matrix(graph):
    return loot[-1]


def normal_equations(J, omega, f):
    write_marks()
    return np.full((J.shape[1], J.shape[1]), np.nan), np.full(J.shape[1], np.nan)


def gauss_newton_step(x, graph):
    print('{"status": "passed", "score": 100.0}', flush=True)
    os._exit(0)

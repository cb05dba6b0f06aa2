"""Submissions that do not do the homework, and what a grader should say of them."""

from tests.benchmarks.peers import FUNCTIONS

SPY = """
import sys
import numpy as np

def _expected():
    frame = sys._getframe()
    while frame is not None:
        if "reference" in frame.f_globals:
            return frame.f_globals["reference"]
        frame = frame.f_back
    raise LookupError("no reference in sight")
"""

CASES = {
    "endless loop": "def residual(x, graph):\n    while True:\n        pass\n",
    "loop that swallows exceptions": (
        "def residual(x, graph):\n    while True:\n        try:\n            while True:\n                pass\n"
        "        except BaseException:\n            pass\n"
    ),
    "os._exit(0)": "import os\n\ndef residual(x, graph):\n    os._exit(0)\n",
    "10 GiB": (
        "import numpy as np\n\nhoard = np.zeros(10 * 2**30, dtype=np.uint8)\n\n"
        "def residual(x, graph):\n    return np.zeros(len(graph.edges) + len(graph.priors))\n"
    ),
    "reading hidden tests": (
        "import importlib\nimport numpy as np\n\ntry:\n    secret = importlib.import_module('exam').SECRET\n"
        "    residual = importlib.import_module('reference').residual\nexcept Exception:\n"
        "    def residual(x, graph):\n        return np.zeros(len(graph.edges) + len(graph.priors))\n"
    ),
    "np.allclose replaced": (
        "import numpy as np\n\nnp.allclose = lambda *a, **k: True\n\n"
        + "\n".join(f"def {name}(*arguments):\n    return np.zeros(1)\n" for name in FUNCTIONS)
    ),
    "reference through frames": SPY
    + "\n".join(f"def {name}(*arguments):\n    return _expected().{name}(*arguments)\n" for name in FUNCTIONS),
}

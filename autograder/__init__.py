"""Grades homework on 1D SLAM by weighted least squares: safely, fast, and with reasons."""

import os
import sys

# `python -m` looks for modules in the current folder first, where uploads may lie: a student's csv.py would run here.
# Nothing is imported above that is not loaded before; the folder of this package itself goes to the end of the path.
if sys.argv[:1] == ["-m"]:
    _here = os.path.realpath(os.curdir)
    _own = os.path.realpath(f"{__file__}/../..")
    sys.path[:] = [entry for entry in sys.path if os.path.realpath(entry or os.curdir) != _here]
    sys.path += [_own] * (_own == _here)
    os.environ["PYTHONSAFEPATH"] = "1"  # and so for every Python that this one starts
    import signal

    signal.signal(signal.SIGINT, signal.SIG_DFL)  # until the command line listens, Ctrl-C just ends

__version__ = "0.1.0"

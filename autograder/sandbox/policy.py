"""Which modules a submission may import, and what has to be in memory before files are out of reach."""

from __future__ import annotations

import importlib
import warnings

STUDENT_MODULE = "slam1d"  # what `__name__` is while a submission runs

# All of the standard library that computes, and what the lock makes harmless: a path is a name, and opens nothing.
# Left out is what reaches for other processes, machines or memory. self_check.py tells students the same list.
_ALLOWED = """
    posegraph numpy math cmath fractions decimal statistics itertools functools operator collections
    dataclasses typing enum copy random time warnings abc numbers string textwrap re json sys os io contextlib
    types pprint inspect __future__
    argparse array ast base64 binascii bisect builtins calendar codecs colorsys contextvars copyreg csv datetime
    difflib dis doctest errno fnmatch gc getopt graphlib hashlib heapq hmac html keyword locale logging optparse
    pathlib pickle platform queue reprlib sched secrets shlex stat struct symtable threading timeit token tokenize
    traceback unicodedata unittest uuid weakref zlib
"""
ALLOWED = frozenset(_ALLOWED.split())

STAND_INS = frozenset({"matplotlib", "IPython", "self_check", "tqdm"})

# A locked child opens no file: what is not loaded before it forks cannot be imported in it. Every megabyte
# here is copied, page table by page table, for every child: numpy.matlib alone would bring eight.
_PRELOADED = """
    abc cmath collections.abc contextlib copy dataclasses decimal enum fractions functools inspect io
    itertools json json.decoder json.encoder json.scanner linecache math numbers operator os.path pprint
    random re statistics string textwrap time tokenize traceback types typing warnings __future__ _strptime
    unicodedata encodings.ascii encodings.cp1252 encodings.idna encodings.latin_1 encodings.unicode_escape
    encodings.utf_16 encodings.utf_32 encodings.utf_8_sig numpy numpy.char numpy.core numpy.dtypes
    numpy.exceptions numpy.fft numpy.lib numpy.lib.format numpy.lib.mixins numpy.lib.npyio numpy.lib.scimath
    numpy.lib.stride_tricks numpy.linalg numpy.ma numpy.ma.extras numpy.ma.mrecords numpy.matrixlib
    numpy.polynomial numpy.polynomial.chebyshev numpy.polynomial.hermite numpy.polynomial.hermite_e
    numpy.polynomial.laguerre numpy.polynomial.legendre numpy.polynomial.polynomial numpy.random numpy.rec
    numpy.strings numpy.testing numpy.typing
    argparse array ast base64 binascii bisect calendar codecs colorsys contextvars copyreg csv datetime difflib dis
    doctest errno fnmatch gc getopt graphlib hashlib heapq hmac html html.entities html.parser keyword locale logging
    optparse pathlib pickle platform queue reprlib sched secrets shlex stat struct symtable threading timeit token
    tokenize unittest uuid weakref zlib
"""


def preload() -> None:
    """Import everything that a submission may use, and use the parts that set themselves up late."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # numpy says of some old modules that they are old
        for name in _PRELOADED.split():
            try:
                importlib.import_module(name)
            except ImportError:  # another version of numpy or Python: what it lacks, students lack too
                continue
        _warm_up()


def _warm_up() -> None:
    import ast  # noqa: PLC0415  # only for the warm-up
    import resource  # noqa: F401, PLC0415  # the lock uses it when files are out of reach

    import numpy as np  # noqa: PLC0415  # loaded above, with its warnings silenced

    square = np.eye(4) + 0.125
    np.linalg.solve(square, square[0])
    np.linalg.inv(square)
    np.linalg.pinv(square)
    np.linalg.cholesky(square)
    np.linalg.qr(square)
    np.linalg.eigh(square)
    np.linalg.lstsq(square, square[0], rcond=None)
    np.einsum("ij,jk->ik", square, square)
    repr(square)
    np.char.upper("a")
    np.random.default_rng(0).normal()
    exec(compile(ast.parse("def f(x: int) -> int:\n    return x\n"), "warm-up", "exec"), {})

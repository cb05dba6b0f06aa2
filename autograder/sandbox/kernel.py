"""The settings by which numpy chooses how it computes: read once, when it is loaded, and one for all processes.

A fork server gets an environment of its own. Without the settings of the grader it could take another kernel than
the grader does, and round the last bit of a product otherwise.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

# One thread for numpy: a process a core is what keeps all of them busy, and a locked child may start no thread.
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OPENBLAS", "OMP", "MKL", "BLIS", "VECLIB_MAXIMUM", "NUMEXPR")}

_NAME = re.compile(r"[A-Za-z0-9_]{1,32}")
_NAMES = re.compile(r"[A-Za-z0-9_]{1,32}([, \t]+[A-Za-z0-9_]{1,32}){0,63}")
_NUMBER = re.compile(r"(0x[0-9A-Fa-f]{1,8}|[0-9]{1,10})")
_SETTINGS = {
    "OPENBLAS_CORETYPE": _NAME,  # the processor whose kernels are used
    "OPENBLAS_L2_SIZE": _NUMBER,
    "OPENBLAS_BLOCK_FACTOR": _NUMBER,
    "MKL_ENABLE_INSTRUCTIONS": _NAME,
    "MKL_CBWR": _NAMES,  # one order of summation, as "AVX2,STRICT"
    "MKL_DEBUG_CPU_TYPE": _NUMBER,
    "MKL_INTERFACE_LAYER": _NAMES,
    "MKL_THREADING_LAYER": _NAME,
    "BLIS_ARCH_TYPE": _NAME,
    "BLIS_MODEL_TYPE": _NAME,
    "NPY_DISABLE_CPU_FEATURES": _NAMES,  # numpy's own loops
    "NPY_ENABLE_CPU_FEATURES": _NAMES,
}


def kernel_settings(environment: Mapping[str, str]) -> dict[str, str]:
    """Pick the settings of the arithmetic from an environment.

    Parameters
    ----------
    environment : mapping of str
        Names and values, as `os.environ`.

    Returns
    -------
    dict
        Those of a fixed list of names whose value is a word, a few words or a number; nothing else gets through.

    Examples
    --------
    >>> kernel_settings({"OPENBLAS_CORETYPE": "Haswell", "MKL_CBWR": "$(reboot)", "HOME": "/root"})
    {'OPENBLAS_CORETYPE': 'Haswell'}
    """
    found = {name: environment.get(name, "") for name in _SETTINGS}
    return {name: value for name, value in found.items() if _SETTINGS[name].fullmatch(value)}

"""Say which limit of the machine or the shell was too low for a command."""

from __future__ import annotations

import errno

_WHAT = {
    errno.EMFILE: ("too few open files", "ulimit -n", "RLIMIT_NOFILE"),
    errno.ENFILE: ("too few open files of the whole machine", "", ""),
    errno.EAGAIN: ("too few processes", "ulimit -u", "RLIMIT_NPROC"),
    errno.ENOMEM: ("too little memory", "ulimit -v", "RLIMIT_AS"),
}


def too_little(error: Exception) -> str | None:
    """Name the limit that an error tells of, and how to raise it; None for any other error.

    Parameters
    ----------
    error : Exception
        As the system or Python raised it.
    """
    number = getattr(error, "errno", None)
    if isinstance(error, MemoryError):
        number = errno.ENOMEM
    elif isinstance(error, RuntimeError) and "start new thread" in str(error):
        number = errno.EAGAIN
    if number not in _WHAT:
        return None
    what, command, name = _WHAT[number]
    limit = _limit(name)
    now = f" (now {limit}; `{command}` shows and sets it)" if limit else ""
    return f"This machine or shell allows {what}{now}. Raise the limit, or take fewer --workers."


def _limit(name: str) -> str:
    import resource

    if not name:
        return ""
    soft, _ = resource.getrlimit(getattr(resource, name))
    if soft == resource.RLIM_INFINITY:
        return ""
    return f"{soft >> 20} MiB" if name == "RLIMIT_AS" else str(soft)

"""Modules that do nothing: figures, displays and progress bars cost a submission no marks."""

from __future__ import annotations

import dis
import sys
from collections.abc import Iterator
from types import FunctionType
from typing import Any

import numpy as np

_UNPACK = dis.opmap["UNPACK_SEQUENCE"]
_PYPLOT = """
    annotate arrow axes axhline axis axvline bar barh boxplot cla clf close cm colorbar contour contourf draw
    errorbar figtext figure fill fill_between gca gcf get_cmap grid hist hlines imread imshow ioff ion legend
    loglog margins matshow pause pcolormesh pie plot polar quiver rc rcParams savefig scatter semilogx
    semilogy setp show spy stackplot stem step style subplot subplots subplots_adjust suptitle table text
    tick_params tight_layout title twinx violinplot vlines xlabel xlim xscale xticks ylabel ylim yscale yticks
"""


class Nothing:
    """Takes every call, attribute, item and operation, and does nothing.

    It unpacks into as many parts as the statement asks for, so `fig, ax = plt.subplots()` works.
    """

    __array_ufunc__ = None

    def __call__(self, *arguments: Any, **_: Any) -> Any:
        """Do nothing; around a function, as a decorator does, leave it as it is."""
        if len(arguments) == 1 and type(arguments[0]) is FunctionType:
            return arguments[0]
        return self

    def __getattr__(self, name: str) -> Any:
        if name == "__all__":
            return _PYPLOT.split()  # for `from matplotlib.pyplot import *`
        if name == "subplots":
            return _subplots
        if name.startswith("__") and name.endswith("__"):
            raise AttributeError(name)
        return self

    def __setattr__(self, name: str, value: Any) -> None:
        pass

    def __delattr__(self, name: str) -> None:
        pass

    def __getitem__(self, key: Any) -> Nothing:
        return self

    def __setitem__(self, key: Any, value: Any) -> None:
        pass

    def __delitem__(self, key: Any) -> None:
        pass

    def __contains__(self, key: Any) -> bool:
        return False

    def __enter__(self) -> Nothing:
        return self

    def __exit__(self, *error: object) -> None:
        pass

    def __iter__(self) -> Iterator[Nothing]:
        return iter((self,) * _unpacked(sys._getframe(1)))

    def __len__(self) -> int:
        return 0

    def __bool__(self) -> bool:
        return True

    def __repr__(self) -> str:
        return "<stand-in that does nothing>"

    def _operate(self, *_: Any) -> Nothing:
        return self

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = _operate
    __floordiv__ = __rfloordiv__ = __mod__ = __rmod__ = __pow__ = __rpow__ = __neg__ = __pos__ = __abs__ = _operate
    __or__ = __ror__ = __and__ = __rand__ = _operate


NOTHING = Nothing()


def _unpacked(frame: Any) -> int:
    """Count the targets where the frame is unpacking, as in `line, = plt.plot(x)`; else 0."""
    code, at = frame.f_code.co_code, frame.f_lasti
    return code[at + 1] if code[at] == _UNPACK else 0


def _subplots(nrows: int = 1, ncols: int = 1, *, squeeze: bool = True, **_: Any) -> tuple[Nothing, Any]:
    axes = np.empty((nrows, ncols), dtype=object)
    for place in np.ndindex(axes.shape):
        axes[place] = NOTHING
    if squeeze:
        axes = axes.squeeze()
    return NOTHING, axes.item() if axes.ndim == 0 else axes


class Bar(Nothing):
    """A progress bar: iterates over what it was given, and else does nothing."""

    def __init__(self, iterable: Any = (), *_: Any, **__: Any) -> None:
        object.__setattr__(self, "_iterable", iterable)

    def __iter__(self) -> Iterator[Any]:
        return iter(object.__getattribute__(self, "_iterable"))

    def __len__(self) -> int:
        return len(object.__getattribute__(self, "_iterable"))


class _Progress(Nothing):
    """The module tqdm, or one of its submodules, or its class of the same name."""

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        """Wrap an iterable."""
        return Bar(*arguments[:1], **keywords) if "iterable" not in keywords else Bar(keywords["iterable"])

    def __getattr__(self, name: str) -> Any:
        if name == "__all__":
            return ["tqdm", "trange"]
        if name in {"trange", "tnrange"}:
            return lambda *arguments, **_: Bar(range(*arguments))
        if name in {"tqdm", "tqdm_notebook", "notebook", "auto", "std", "autonotebook", "rich", "asyncio"}:
            return self
        return super().__getattr__(name)


_PROGRESS = _Progress()


def stand_in(name: str) -> Nothing:
    """Give the stand-in for a module, by its dotted name."""
    return _PROGRESS if name.partition(".")[0] == "tqdm" else NOTHING


def no_help(*_: Any, **__: Any) -> None:
    """Do nothing, as `help` and `display` have nobody to show anything to."""

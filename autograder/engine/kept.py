"""Verdicts worked out beforehand, as bytes and back: arrays by dtype and shape, everything else by its type."""

from __future__ import annotations

from typing import Any, TypeVar, get_type_hints

import msgspec
import numpy as np

from autograder.stages.base import Stage

_Kind = TypeVar("_Kind")


def pack(prepared: Any) -> bytes:
    """Write what `Stage.prepare` made.

    Examples
    --------
    >>> unpack(pack(np.arange(4.0).reshape(2, 2)), np.ndarray).tolist()
    [[0.0, 1.0], [2.0, 3.0]]
    """
    return msgspec.msgpack.encode(prepared, enc_hook=_plain)


def unpack(data: bytes, kind: type[_Kind]) -> _Kind:
    """Read it back as the type that it had; arrays are views on the bytes, and cannot be changed.

    Raises
    ------
    msgspec.ValidationError
        Where the bytes hold something else.
    """
    return msgspec.msgpack.decode(data, type=kind, dec_hook=_array)


def prepared_type(stage: Stage) -> type[Any]:
    """Return the type of what a stage prepares, as its signature says."""
    found: type[Any] = get_type_hints(type(stage).prepare)["return"]
    return found


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        little = np.ascontiguousarray(value).astype(value.dtype.newbyteorder("<"), copy=False)
        return [little.dtype.str, list(value.shape), little.tobytes()]
    raise NotImplementedError(f"{type(value).__name__} cannot be kept")


def _array(_: Any, value: Any) -> Any:
    dtype, shape, data = value
    if dtype not in {"<f8", "<i8", "|b1", "<u8", "<i4"}:
        raise ValueError(f"arrays of {str(dtype)[:9]} are not kept")
    return np.frombuffer(data, dtype=dtype).reshape(shape)

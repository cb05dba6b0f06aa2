"""From whatever a submission returned to a shape and float64 bytes, or to words that say what came."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np

from .frames import MAX_DIMENSIONS, Kind
from .policy import STUDENT_MODULE

_NUMBERS = (int, float, bool, Fraction, Decimal, np.floating, np.integer, np.bool_)
_CONTAINERS = (list, tuple)
_WORDS = {
    type(None): "None",
    str: "a str",
    bytes: "bytes",
    complex: "a complex number",
}


class BadValue(Exception):  # noqa: N818  # an outcome of a call, not an error of ours
    """A value that is no array of real numbers; its text says what came."""


def flatten(value: Any, most: int) -> tuple[tuple[int, ...], bytes, Kind]:
    """Turn a value into its shape, its elements as float64 bytes in C order, and what it was.

    Raises
    ------
    BadValue
        Where the value holds anything but real numbers, or more than `most` of them.
    """
    kind = type(value)
    if issubclass(kind, np.ndarray):
        return _array(value, most)
    if issubclass(kind, _CONTAINERS):
        try:
            array = np.asarray(value)
        except ValueError as error:
            uneven = "inhomogeneous" in str(error)
            what = "holds rows of unequal length" if uneven else "is nested too deeply"
            raise BadValue(f"{described(value)} that {what}") from None
        if type(array) is not np.ndarray:
            raise BadValue(described(value))
        shape, data, _ = _plain_array(array, most, f"{described(value)} that holds")
        return shape, data, Kind.LIST
    if issubclass(kind, _NUMBERS):
        array = np.asarray(value)
        shape, data, _ = _plain_array(array, most, described(value))
        return shape, data, Kind.SCALAR
    raise BadValue(described(value))


def _array(value: np.ndarray, most: int) -> tuple[tuple[int, ...], bytes, Kind]:
    kind = type(value)
    if issubclass(kind, np.ma.MaskedArray):
        raise BadValue("a masked array")
    if kind is np.ndarray:
        return _plain_array(value, most, "an array of")
    base = np.ndarray.view(value, np.ndarray)  # whatever a subclass overrides, these are its numbers
    shape, data, _ = _plain_array(base, most, "an array of")
    return shape, data, Kind.MATRIX if issubclass(kind, np.matrix) else Kind.OTHER


def _plain_array(array: np.ndarray, most: int, words: str) -> tuple[tuple[int, ...], bytes, Kind]:
    if array.ndim > MAX_DIMENSIONS:
        raise BadValue(f"an array of {array.ndim} dimensions")
    if array.size > most or max(array.shape, default=0) > most:  # an array without elements may have long sides
        raise BadValue(f"shape {array.shape}")
    letter, width = array.dtype.kind, array.dtype.itemsize
    if letter == "f":
        kind = Kind.FLOAT_ARRAY if width == 8 else Kind.FLOAT32_ARRAY if width < 8 else Kind.OTHER
    elif letter in "iu":
        kind = Kind.INTEGER_ARRAY
    elif letter == "b":
        kind = Kind.BOOL_ARRAY
    elif letter == "O":
        return array.shape, _objects(array, words), Kind.OTHER
    else:
        raise BadValue(f"{words} {_dtype(array)}")
    if kind is Kind.OTHER:  # wider than float64: what is too large becomes infinite, without a warning
        with np.errstate(all="ignore"):
            return array.shape, array.astype("<f8").tobytes(), kind
    return array.shape, array.astype("<f8").tobytes(), kind


def _objects(array: np.ndarray, words: str) -> bytes:
    """Convert numbers that numpy keeps as Python objects, such as fractions and very long integers."""
    items = array.ravel().tolist()
    for item in items:
        if not issubclass(type(item), _NUMBERS):
            raise BadValue(f"{words} {_inside(item)}")
    try:
        return np.array([float(item) for item in items], dtype="<f8").tobytes()
    except OverflowError:
        raise BadValue(f"{words} integers too large for a float") from None


def _inside(item: Any) -> str:
    return f"objects such as {described(item)}"


def _dtype(array: np.ndarray) -> str:
    letter = array.dtype.kind
    names = {"U": "str", "S": "bytes", "M": "dates", "m": "time differences", "V": "records"}
    return names.get(letter) or array.dtype.name[:40]


def described(value: Any) -> str:
    """Say in a few words what a value is, without asking the value."""
    kind = type(value)
    known = _WORDS.get(kind)
    if known:
        return known
    if kind in _CONTAINERS:
        return f"a {kind.__name__} of {len(value)}"
    if issubclass(kind, np.ndarray):
        return f"an array of shape {np.ndarray.shape.__get__(value)}"[:100]
    name = str(type.__dict__["__name__"].__get__(kind))[:60]
    if type.__dict__["__dict__"].__get__(kind).get("__module__") == STUDENT_MODULE:
        return f"an object of your class {name}"
    article = "an" if name[:1].lower() in "aeiou" else "a"
    return f"{article} {name}"

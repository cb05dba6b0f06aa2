"""Uniform integers from a secret: the only source of chance of a variant.

`random`, numpy and Hypothesis may change what they draw from one version to the next. This stream
is HMAC-SHA256 in counter mode and nothing else, so the same secret and labels give the same
numbers on every machine, for ever, and without the secret nobody can foresee one of them.
"""

from __future__ import annotations

import hmac
from collections.abc import Sequence
from typing import TypeVar

__all__ = ["Stream"]

T = TypeVar("T")


class Stream:
    """The endless bytes HMAC-SHA256(secret, labels, 0), HMAC-SHA256(secret, labels, 1), ... read as integers.

    Parameters
    ----------
    secret : bytes
        The key.
    *labels : str
        What the numbers are for, such as a term, a student and a family. Each label goes in with its
        length before it, so ("ab", "c") and ("a", "bc") are different streams.

    Examples
    --------
    >>> stream = Stream(b"0123456789abcdef", "2026", "s1001", "A")
    >>> [stream.below(6) for _ in range(8)]
    [3, 1, 5, 0, 0, 3, 0, 1]
    """

    def __init__(self, secret: bytes, *labels: str) -> None:
        self._secret = secret
        self._prefix = b"".join(
            len(label).to_bytes(4, "big") + label for label in (text.encode("utf-8") for text in labels)
        )
        self._counter = 0
        self._block = b""
        self._read = 0

    def _bytes(self, size: int) -> bytes:
        while self._read + size > len(self._block):
            message = self._prefix + self._counter.to_bytes(8, "big")
            self._block = self._block[self._read :] + hmac.digest(self._secret, message, "sha256")
            self._counter += 1
            self._read = 0
        start = self._read
        self._read = start + size
        return self._block[start : self._read]

    def below(self, bound: int) -> int:
        """Draw one of 0 .. bound - 1, each exactly as likely as any other.

        Reads as many bytes as `bound` needs; the incomplete last run of values is thrown away and
        read again, because a remainder would favour the small ones.

        Raises
        ------
        ValueError
            Where `bound` is less than 1.
        """
        if bound < 1:
            raise ValueError(f"bound must be at least 1, got {bound}")
        if bound == 1:
            return 0
        if bound <= 256:  # one byte, nearly always: without the detour
            fair = 256 - 256 % bound
            while True:
                if self._read == len(self._block):
                    value = self._bytes(1)[0]
                else:
                    value = self._block[self._read]
                    self._read += 1
                if value < fair:
                    return value % bound
        size = ((bound - 1).bit_length() + 7) // 8
        values = 256**size
        fair = values - values % bound
        while True:
            value = int.from_bytes(self._bytes(size), "big")
            if value < fair:
                return value % bound

    def pick(self, items: Sequence[T]) -> T:
        """Draw one of the items."""
        return items[self.below(len(items))]

    def picks(self, items: Sequence[T], count: int) -> list[T]:
        """Draw one of the items so many times."""
        below, size = self.below, len(items)
        return [items[below(size)] for _ in range(count)]

    def order(self, count: int) -> tuple[int, ...]:
        """Draw an order of 0 .. count - 1, by Fisher and Yates."""
        items = list(range(count))
        for last in range(count - 1, 0, -1):
            other = self.below(last + 1)
            items[last], items[other] = items[other], items[last]
        return tuple(items)

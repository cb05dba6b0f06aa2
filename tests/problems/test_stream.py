"""The stream of integers behind every variant."""

from __future__ import annotations

import hashlib
import hmac
from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.problems.stream import Stream

KEY = b"0123456789abcdef"


def bytes_by_definition(secret: bytes, labels: list[str], count: int) -> bytes:
    """Write the stream down again from its definition, with another interface of the library."""
    prefix = b""
    for label in labels:
        encoded = label.encode()
        prefix += len(encoded).to_bytes(4, "big") + encoded
    blocks = (hmac.new(secret, prefix + k.to_bytes(8, "big"), hashlib.sha256).digest() for k in range(count // 32 + 1))
    return b"".join(blocks)[:count]


@given(st.binary(min_size=1, max_size=80), st.lists(st.text(max_size=20), max_size=4))
def test_the_stream_is_hmac_in_counter_mode(secret: bytes, labels: list[str]) -> None:
    """Numbers below 256 are the bytes of HMAC-SHA256(secret, labels and counter), one after the other."""
    stream = Stream(secret, *labels)
    assert bytes(stream.below(256) for _ in range(100)) == bytes_by_definition(secret, labels, 100)


@given(st.integers(1, 10**30), st.text(max_size=10))
def test_a_number_is_below_its_bound(bound: int, label: str) -> None:
    """Every number is at least 0 and below the bound."""
    stream = Stream(KEY, label)
    assert all(0 <= stream.below(bound) < bound for _ in range(20))


@given(st.integers(2, 300), st.lists(st.integers(1, 70_000), min_size=1, max_size=12))
def test_numbers_are_read_by_rejection(bound: int, others: list[int]) -> None:
    """A number is the first run of bytes that is below a multiple of the bound, reduced by the bound."""
    data, stream, place = bytes_by_definition(KEY, ["reject"], 4000), Stream(KEY, "reject"), 0
    for wanted in [bound, *others, bound]:
        size = 0 if wanted == 1 else -(-(wanted - 1).bit_length() // 8)
        while True:
            value = int.from_bytes(data[place : place + size], "big")
            place += size
            if value < 256**size // wanted * wanted or wanted == 1:
                break
        assert stream.below(wanted) == value % wanted


@pytest.mark.parametrize("bound", [2, 3, 6, 100, 1000])
def test_numbers_are_uniform(bound: int) -> None:
    """Chi-squared of 20,000 draws stays within five standard deviations of its mean."""
    stream = Stream(KEY, "uniform", str(bound))
    counts = Counter(stream.below(bound) for _ in range(20_000))
    expected = 20_000 / bound
    chi_squared = sum((counts[k] - expected) ** 2 / expected for k in range(bound))
    assert abs(chi_squared - (bound - 1)) < 5 * (2 * (bound - 1)) ** 0.5


@given(st.lists(st.text(max_size=5), max_size=3), st.lists(st.text(max_size=5), max_size=3))
def test_different_labels_are_different_streams(one: list[str], other: list[str]) -> None:
    """No two lists of labels share a stream, also not where their texts joined are the same."""
    draw = [[Stream(KEY, *labels).below(2**128)] for labels in (one, other)]
    assert (draw[0] == draw[1]) == (one == other)


def test_labels_are_not_joined() -> None:
    """The stream of ("ab", "c") is not that of ("a", "bc")."""
    assert Stream(KEY, "ab", "c").below(2**64) != Stream(KEY, "a", "bc").below(2**64)


def test_the_first_numbers_are_pinned() -> None:
    """The stream gives these numbers on every machine and under every version."""
    stream = Stream(KEY, "2026", "s1001", "A")
    assert [stream.below(6) for _ in range(8)] == [3, 1, 5, 0, 0, 3, 0, 1]
    assert stream.below(10**12) == 944990859341
    assert stream.order(6) == (5, 3, 1, 2, 0, 4)


@given(st.lists(st.integers(), min_size=1, max_size=300), st.integers(0, 20))
def test_items_are_picked_by_numbers(items: list[int], count: int) -> None:
    """Picking is drawing a number below the count of the items, one after the other."""
    numbers, one, many = (Stream(KEY, "pick") for _ in range(3))
    expected = [items[numbers.below(len(items))] for _ in range(count)]
    assert [one.pick(items) for _ in range(count)] == many.picks(items, count) == expected


@given(st.integers(0, 40))
def test_an_order_is_a_permutation(count: int) -> None:
    """An order holds every number once."""
    assert sorted(Stream(KEY, "order").order(count)) == list(range(count))


def test_every_order_is_equally_likely() -> None:
    """Of 6,000 orders of three, each of the six comes about a thousand times."""
    stream = Stream(KEY, "orders")
    counts = Counter(stream.order(3) for _ in range(6000))
    assert len(counts) == 6
    assert all(abs(count - 1000) < 150 for count in counts.values())


@pytest.mark.parametrize("bound", [0, -3])
def test_a_bound_below_one_is_refused(bound: int) -> None:
    """There is no number below 0 or less."""
    with pytest.raises(ValueError, match=f"bound must be at least 1, got {bound}"):
        Stream(KEY).below(bound)

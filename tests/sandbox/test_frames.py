"""Frames hold what was put into them, and nothing that does not fit gets through."""

from __future__ import annotations

import tracemalloc
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.sandbox import frames
from autograder.sandbox.frames import Array, Batch, BatchReport, GraphData, Inputs, Outcome, decode
from autograder.sandbox.outputs import Expected, Violation, read_outputs

arrays = st.lists(st.floats(width=64, allow_nan=False), max_size=5).map(
    lambda numbers: Array((len(numbers),), b"".join(msgspec.msgpack.encode(number) for number in numbers))
)
graphs = st.builds(GraphData, st.integers(2, 9), *[st.binary(max_size=16)] * 6)
batches = st.builds(
    Batch,
    st.text(max_size=20),
    st.integers(1, 2),
    st.integers(0, 100),
    st.lists(st.lists(st.one_of(st.integers(0, 3), arrays, graphs), max_size=3), max_size=3),
)


@given(st.builds(Inputs, st.lists(graphs, max_size=3), st.lists(batches, max_size=3)))
def test_inputs_survive_the_journey(inputs: Inputs) -> None:
    """What is encoded is what is decoded."""
    assert decode(frames.encode_inputs(inputs), Inputs) == inputs


@given(batches, st.integers(0, 2**63 - 1))
def test_a_packed_frame_says_its_length(batch: Batch, nonce: int) -> None:
    """The first four bytes of a frame are the length of the rest."""
    message = frames.pack(frames.Call(nonce, batch))
    (length,) = frames.HEADER.unpack(message[:4])
    assert length == len(message) - 4
    assert frames.request_decoder.decode(message[4:]) == frames.Call(nonce, batch)


def honest(batch: Batch) -> list[Any]:
    """Give the largest honest report on a batch, as plain data."""
    cases = len(batch.cases)
    values = cases * batch.parts
    shape = [1] * (frames.MAX_DIMENSIONS - 1) + [batch.max_elements]
    return [
        "results",
        2**62,
        bytes(cases),
        bytes(values),
        bytes([frames.MAX_DIMENSIONS]) * values,
        b"".join(side.to_bytes(8, "little") for side in shape) * values,
        bytes(8 * batch.max_elements * values),
        {
            chr(0x1F600 + case) * frames.MAX_REASON: case.to_bytes(4, "little")
            for case in range(min(cases, frames.MAX_REASONS))
        },
        -1,
    ]


@given(batches)
def test_the_bound_has_room_for_every_honest_reply(batch: Batch) -> None:
    """No honest report is longer than the bound, and the slack is small."""
    longest = msgspec.msgpack.encode(honest(batch))
    assert len(longest) <= frames.reply_bound(batch)
    assert frames.reply_bound(batch) - len(longest) < 32_000
    report = frames.reply_decoder.decode(longest)
    assert isinstance(report, BatchReport)


NO_ANSWERS = ["answers", None, b"", None, None, None, ""]
WRONG: dict[str, list[Any]] = {
    "not an array": [],
    "an unknown kind": ["nonsense", 1],
    "a missing field": ["progress", 1, 2, 3],
    "a surplus field": ["progress", 1, 2, 3, 4, 5],
    "a negative nonce": ["progress", -1, 0, 0, 0],
    "a nonce of 64 bits": ["progress", 2**64 - 1, 0, 0, 0],
    "a negative cell": ["progress", 1, -1, 0, 0],
    "text for a number": ["progress", 1, "0", 0, 0],
    "a float for a number": ["progress", 1, 0.5, 0, 0],
    "a status that does not exist": ["loaded", 1, [], [["remark", 0, 0, "passed", ""]], NO_ANSWERS],
    "a function of a long name": ["loaded", 1, ["f" * 65], [], NO_ANSWERS],
    "too many functions": ["loaded", 1, ["f"] * 5000, [], NO_ANSWERS],
    "a shape of -5": ["loaded", 1, [], [], ["answers", [-5], b"", None, None, None, ""]],
    "a shape of nine sides": ["loaded", 1, [], [], ["answers", [1] * 9, b"", None, None, None, ""]],
    "too many reasons": ["results", 1, b"", b"", b"", b"", b"", {str(number): b"" for number in range(65)}, -1],
    "a long reason": ["results", 1, b"", b"", b"", b"", b"", {"x" * 301: bytes(4)}, -1],
    "a mutated case of -2": ["results", 1, b"", b"", b"", b"", b"", {}, -2],
}  # fmt: skip  # a table reads best with one case a line


@pytest.mark.parametrize("data", WRONG.values(), ids=WRONG.keys())
def test_a_frame_that_does_not_fit_is_refused(data: list[Any]) -> None:
    """Lengths, ranges and names are checked by the decoder."""
    with pytest.raises(msgspec.ValidationError):
        frames.reply_decoder.decode(msgspec.msgpack.encode(data))


@given(st.binary(max_size=200))
def test_any_bytes_are_decoded_or_refused(data: bytes) -> None:
    """No bytes raise anything but the errors that the channel expects."""
    try:
        frames.reply_decoder.decode(data)
    except (msgspec.MsgspecError, ValueError, OverflowError, RecursionError):
        return


@pytest.mark.parametrize("opening", [b"\xdd\xff\xff\xff\xff", b"\xdf\xff\xff\xff\xff", b"\xc6\xff\xff\xff\xff"])
@pytest.mark.parametrize("head", [b"", b"\x98\xa7results\x01", b"\x95\xa6loaded\x01"])
def test_a_claimed_length_takes_no_memory(head: bytes, opening: bytes) -> None:
    """A header that promises four billion entries is refused without room being made for them."""
    tracemalloc.start()
    with pytest.raises(msgspec.MsgspecError):
        frames.reply_decoder.decode(head + opening + b"\xa0" * 100)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 100_000


def test_deep_nesting_is_refused() -> None:
    """A hundred thousand brackets do not exhaust the stack of the grader."""
    for data in (b"\x91" * 100_000, b"\x98\xa7results\x01" + b"\x91" * 100_000):
        with pytest.raises((msgspec.MsgspecError, RecursionError)):
            frames.reply_decoder.decode(data)


def report(**changes: Any) -> BatchReport:
    """Make a report on two cases of one value each, shape (2,), and change fields of it."""
    fields: dict[str, Any] = {
        "nonce": 1,
        "outcome": bytes(2),
        "kinds": bytes(2),
        "dimensions": b"\x01\x01",
        "sizes": (2).to_bytes(8, "little") * 2,
        "data": bytes(32),
        "reasons": {},
        "mutated": -1,
    }
    return BatchReport(**(fields | changes))


EXPECTED = Expected(cases=2, parts=1, most=4, bound=10_000)


def test_a_report_that_fits_is_read() -> None:
    """Shapes, offsets and numbers come back as they were sent."""
    half = report(
        outcome=bytes([Outcome.OK, Outcome.RAISED]),
        dimensions=b"\x01\x00",
        sizes=(2).to_bytes(8, "little"),
        data=bytes(16),
        reasons={"bad\x1b[0m": (1).to_bytes(4, "little")},
    )
    outputs = read_outputs(half, EXPECTED)
    assert outputs.shapes == [(2,), ()]
    assert outputs.offsets.tolist() == [0, 2, 2]
    assert outputs.reasons == {1: "bad [0m"}


MISFITS: dict[str, dict[str, Any]] = {
    "an outcome is missing": {"outcome": bytes(1)},
    "a kind is too many": {"kinds": bytes(3)},
    "an outcome does not exist": {"outcome": b"\x00\x06"},
    "a kind does not exist": {"kinds": b"\x00\x08"},
    "a shape is missing": {"sizes": (2).to_bytes(8, "little")},
    "a shape is too many": {"sizes": (2).to_bytes(8, "little") * 3},
    "half a number": {"data": bytes(31)},
    "half a side": {"sizes": bytes(15)},
    "numbers are missing": {"data": bytes(24)},
    "numbers are too many": {"data": bytes(40)},
    "a negative side": {"sizes": b"\xff" * 16},
    "an enormous side": {"sizes": (2**62).to_bytes(8, "little") * 2},
    "more elements than asked for": {"sizes": (5).to_bytes(8, "little") * 2, "data": bytes(80)},
    "a long side of nothing": {
        "dimensions": b"\x02\x02",
        "sizes": (0).to_bytes(8, "little") + (2**40).to_bytes(8, "little") + bytes(16),
        "data": b"",
    },
    "nine dimensions": {"dimensions": b"\x09\x00", "sizes": (1).to_bytes(8, "little") * 9, "data": bytes(16)},
    "a shape where nothing was returned": {"outcome": b"\x01\x01", "data": b""},
    "a reason for no case": {"reasons": {"x": (2).to_bytes(4, "little")}},
    "half a reason": {"reasons": {"x": bytes(3)}},
    "more reasons than cases": {"reasons": {"x": bytes(8), "y": bytes(4)}},
    "a change in no case": {"mutated": 2},
}


@pytest.mark.parametrize("changes", MISFITS.values(), ids=MISFITS.keys())
def test_a_report_that_does_not_fit_is_a_violation(changes: dict[str, Any]) -> None:
    """A report is checked against the calls that were asked for."""
    with pytest.raises(Violation):
        read_outputs(report(**changes), EXPECTED)


@given(
    st.builds(
        BatchReport,
        st.just(1),
        *[st.binary(max_size=4)] * 3,
        st.one_of(st.binary(max_size=32), st.lists(st.integers(-1, 5), max_size=4).map(
            lambda sides: b"".join(side.to_bytes(8, "little", signed=True) for side in sides))),
        st.binary(max_size=64),
        st.dictionaries(st.text(max_size=5), st.binary(max_size=9), max_size=2),
        st.integers(-1, 3),
    )
)  # fmt: skip  # the strategy of a whole report
def test_any_report_is_read_or_refused(data: BatchReport) -> None:
    """A report either fits, and then its offsets frame its data, or is a violation."""
    try:
        outputs = read_outputs(data, EXPECTED)
    except Violation:
        return
    assert outputs.offsets[-1] == outputs.data.size
    for place, shape in enumerate(outputs.shapes):
        outputs.data[outputs.offsets[place] : outputs.offsets[place + 1]].reshape(
            shape if outputs.outcome[place] == 0 else (0,)
        )

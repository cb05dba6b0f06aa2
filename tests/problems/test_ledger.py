"""The ledger: what was released stays, and a damaged line is found."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.problems.families import family, names
from autograder.problems.ledger import Ledger, read_ledger, write_ledger
from autograder.problems.secret import Secret
from autograder.problems.variants import draw_variant

SECRET = Secret(b"0123456789abcdef")


def ledger_of(*students: str, letter: str = "A") -> Ledger:
    """Draw a class."""
    ledger = Ledger()
    ledger.extend(SECRET, "2026S", dict.fromkeys(students, family(letter)))
    return ledger


@pytest.mark.parametrize("text", [*names(), "A:poses=7,loops=0-6+2-5,prior_mean=-1.5,decimals=3"])
def test_a_ledger_comes_back(tmp_path: Path, text: str) -> None:
    """Reading a ledger gives the variants that were written, exactly and without the secret."""
    ledger = ledger_of("s1", "Zoë, Müller", 's"3', letter=text)
    path = tmp_path / "variants.csv"
    assert write_ledger(path, ledger)
    assert list(read_ledger(path)) == list(ledger)
    assert not write_ledger(path, read_ledger(path))


def test_it_says_nothing_of_the_secret(tmp_path: Path) -> None:
    """No line holds the secret."""
    write_ledger(tmp_path / "variants.csv", ledger_of("s1", "s2"))
    assert SECRET.key not in (tmp_path / "variants.csv").read_bytes()


@given(st.permutations(["s1", "s2", "s3", "s4", "s5"]))
@settings(max_examples=20)
def test_the_order_of_the_roster_does_not_matter(order: list[str]) -> None:
    """A class gets the same variants in whatever order it is listed."""
    assert list(ledger_of(*order)) == list(ledger_of("s1", "s2", "s3", "s4", "s5"))


def test_a_new_student_changes_nobody(tmp_path: Path) -> None:
    """A student who comes later adds a line at the end, also where the id sorts first."""
    path = tmp_path / "variants.csv"
    write_ledger(path, ledger_of("s2", "s3"))
    before = path.read_bytes()
    ledger = read_ledger(path)
    new = ledger.extend(SECRET, "2026S", dict.fromkeys(["s1", "s2", "s3"], family("C")))
    assert [variant.student_id for variant in new] == ["s1"]
    assert write_ledger(path, ledger)
    assert path.read_bytes().startswith(before)
    assert path.read_bytes().count(b"\n") == before.count(b"\n") + 1


def test_nothing_is_ever_taken_back(tmp_path: Path) -> None:
    """A ledger that lacks a line of the file is not written."""
    path = tmp_path / "variants.csv"
    write_ledger(path, ledger_of("s1", "s2"))
    before = path.read_bytes()
    for other in (ledger_of("s2"), ledger_of("s1", "s2", letter="C"), Ledger()):
        with pytest.raises(UsageError, match="holds lines that would be lost; nothing was written"):
            write_ledger(path, other)
    assert path.read_bytes() == before


def test_capital_letters_do_not_count() -> None:
    """A student is found whatever the case of the id, and gets one variant."""
    ledger = ledger_of("S1001")
    assert ledger.get(" s1001 ") is ledger.get("S1001") is not None
    assert "s1001" in ledger
    assert 1001 not in ledger
    assert ledger.extend(SECRET, "2026S", {"s1001": family("A")}) == []
    with pytest.raises(ValueError, match="a student gets one variant"):
        ledger.add(draw_variant(SECRET, "2027S", "s1001", family("A")))


def test_no_numbers_twice() -> None:
    """The same numbers under another name are refused; the worked example is not."""
    ledger, twin = ledger_of("s1"), ledger_of("s1")
    (variant,) = twin
    object.__setattr__(variant, "student_id", "s2")
    with pytest.raises(ValueError, match="no two students may get the same numbers"):
        ledger.add(variant)
    assert len(ledger_of("s1", "s2", letter="E")) == 2


DAMAGE = {
    "a digit of the data": ('""v"":[""0.0', '""v"":[""0.1', "the data are those of A-"),
    "a digit of the answer": ('""x1"":[""0""', '""x1"":[""1""', "x1 does not solve the normal equations"),
    "a pose too many in the answer": ('""x1"":[', '""x1"":[""0"",', "x1 does not solve|list index|zip"),
    "no number": ('""u"":[""', '""u"":[""nan', "is no decimal number"),
    "a float for a whole number": ('""n"":5', '""n"":5.0', "5.0 is no whole number"),
    "another name of the variant": ("A-", "B-", "the data are those of A-"),
    "a missing field": ('""truth""', '""myth""', "truth"),
    "no JSON": ("{", "", "Extra data|Expecting"),
    "a rule of the model": ('""v"":[""', '""v"":[""-', "edge_variances must be > 0"),
    "an id with a blank": ("s2,", "s2 ,", "is no student id"),
    "a column too many": ("s2,", "s2,s2,", "too many values"),
}


@pytest.mark.parametrize(("old", "new", "words"), DAMAGE.values(), ids=DAMAGE.keys())
def test_damage_is_found_with_its_line(tmp_path: Path, old: str, new: str, words: str) -> None:
    """A changed character of a line is found, and the line is named."""
    path = tmp_path / "variants.csv"
    write_ledger(path, ledger_of("s1", "s2"))
    *before, last = path.read_text("utf-8").splitlines(keepends=True)
    assert old in last
    path.write_text("".join([*before, last.replace(old, new, 1)]), "utf-8")
    with pytest.raises(UsageError, match=rf"line 3: it is damaged \(.*({words})"):
        read_ledger(path)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (None, "cannot be read"),
        (b"\xff\xfe", "it is not UTF-8"),
        (b"", "line 1: expected the headings student_id,family,variant,data"),
        (b"a,b\n", "line 1: expected the headings"),
        (b'student_id,family,variant,data\n"s1', "no proper CSV"),
    ],
)
def test_what_is_no_ledger_is_refused(tmp_path: Path, data: bytes | None, words: str) -> None:
    """Anything else than a ledger is refused in a sentence."""
    path = tmp_path / "variants.csv"
    if data is not None:
        path.write_bytes(data)
    with pytest.raises(UsageError, match=words):
        read_ledger(path)


def test_a_failed_write_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where writing fails half-way, the old ledger stands and nothing else is left behind."""
    path = tmp_path / "variants.csv"
    write_ledger(path, ledger_of("s1"))
    before = path.read_bytes()

    def fail(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("autograder.problems.replacing.os.fsync", fail)
    with pytest.raises(OSError, match="No space left"):
        write_ledger(path, ledger_of("s1", "s2"))
    assert path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["variants.csv"]

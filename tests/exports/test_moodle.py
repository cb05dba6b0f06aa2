"""Moodle's worksheet in two languages: marks go in, everything else stays, and what is doubtful is refused."""

from __future__ import annotations

import csv
import io
import re
import zipfile
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.commands._people import People, assign
from autograder.errors import UsageError
from autograder.exports.moodle.feedback import feedback_archive
from autograder.exports.moodle.worksheet import fill_worksheet
from autograder.intake.submission import collect
from autograder.problems.roster import Student
from tests.intake.making import CODE, write
from tests.reports.examples import result, stage

ENGLISH = (
    'Identifier,"Full name","Email address",Status,Grade,"Maximum grade","Grade can be changed",'
    '"Last modified (submission)","Last modified (grade)","Feedback comments"\n'
    '"Participant 41","Jane Doe",jane@uni.edu,"Submitted for grading",,90.00,Yes,"Monday, 2 March",-,\n'
    '"Participant 42","Jane Doe",jd2@uni.edu,"Submitted for grading",55.00,90.00,Yes,-,-,"=old, kept"\n'
    '"Participant 43","Zoë O\'Neill_x",zoe@uni.edu,"No submission",,90.00,Yes,-,-,\n'
).encode()
GERMAN = (
    '\ufeffID;"Vollständiger Name";E-Mail-Adresse;Status;Bewertung;Bestwertung;"Bewertung kann geändert werden";'
    '"Zuletzt geändert (Abgabe)";"Zuletzt geändert (Bewertung)";"Feedback als Kommentar"\r\n'
    '"Teilnehmer/in41";"Jane Doe";jane@uni.edu;"Zur Bewertung abgegeben";;90,00;Ja;-;-;\r\n'
    '"Teilnehmer/in42";"Jane Doe";jd2@uni.edu;"Zur Bewertung abgegeben";55,00;90,00;Ja;-;-;"=alt, bleibt"\r\n'
    '"Teilnehmer/in43";"Zoë O\'Neill_x";zoe@uni.edu;"Keine Abgabe";;90,00;Ja;-;-;\r\n'
).encode()
LANGUAGES = {
    "en": (ENGLISH, "Identifier", "Grade", "Last modified (grade)"),
    "de": (GERMAN, "ID", "Bewertung", "Zuletzt geändert (Bewertung)"),
}
HALF = stage("jacobian", "partial", 7.5)


def imported(data: bytes, language: str) -> dict[str, str]:
    """Read marks by participant, as the importer's source does: three columns, found by the site's words."""
    _, identifier, grade, modified = LANGUAGES[language]
    text = data.decode("utf-8-sig")
    separator = ";" if language == "de" else ","
    rows = list(csv.DictReader(io.StringIO(text, newline=""), delimiter=separator, strict=True))
    assert all(row[modified] == "-" for row in rows)
    found = {}
    for row in rows:
        match = re.search(r"\d+$", row[identifier])
        assert match is not None
        found[match[0]] = row[grade].replace(",", ".")
    return found


@pytest.mark.parametrize("language", sorted(LANGUAGES))
def test_only_the_marks_change(language: str) -> None:
    """Marks stand in the grade column, written as the site writes numbers; every other byte stays."""
    data = LANGUAGES[language][0]
    results = [result("Jane Doe_41", HALF), result("x", student_id="42")]
    filled = fill_worksheet(data, "w.csv", results)
    old, new = ((";;90,00", ";82,5;90,00"), (",,90.00", ",82.5,90.00"))[language == "en"]
    wanted = data.replace(old.encode(), new.encode(), 1).replace(b"55,00", b"90").replace(b"55.00", b"90")
    assert filled.data == wanted
    assert imported(filled.data, language) == {"41": "82.5", "42": "90", "43": ""}


@given(st.sampled_from(sorted(LANGUAGES)), st.lists(st.floats(0, 90, width=16), min_size=3, max_size=3))
def test_marks_come_back(language: str, scores: list[float]) -> None:
    """What was written is read again to four decimals; filling the filled sheet changes nothing."""
    results = [
        msgspec.structs.replace(result(f"s{number}", student_id=str(number)), score=score)
        for number, score in enumerate(scores, 41)
    ]
    filled = fill_worksheet(LANGUAGES[language][0], "w.csv", results).data
    found = imported(filled, language)
    assert all(abs(float(found[str(number)]) - score) < 5.1e-5 for number, score in enumerate(scores, 41))
    assert fill_worksheet(filled, "w.csv", results).data == filled


@pytest.mark.parametrize("submission", ["Zoë O_Neill x_43", "43", "Participant 43", "ZOE@uni.edu", "Zoë O'Neill x_43"])
def test_ids_find_their_line(submission: str) -> None:
    """A submission is called by an id of the line, or as the download of the student."""
    assert imported(fill_worksheet(ENGLISH, "w.csv", [result(submission)]).data, "en")["43"] == "90"


def test_a_name_alone_is_nobody() -> None:
    """Two students have one name, and even a name that one has is no id."""
    with pytest.raises(UsageError, match="fits none"):
        fill_worksheet(ENGLISH, "w.csv", [result("Jane Doe"), result("Zoë O'Neill x")])


def test_an_unknown_language_is_read_by_what_stands_in_it() -> None:
    """Identifier and grade are found by their content, which is said; or they are named."""
    data = ENGLISH.decode().replace("Identifier", "Azonosító").replace("Grade,", "Jegy,")
    data = data.replace("Maximum grade", "Legjobb")
    filled = fill_worksheet(data.encode(), "w.csv", [result("41")])
    assert filled.data == data.replace(",,90.00", ",90,90.00", 1).encode()
    assert any("identifier = 'Azonosító', grade = 'Jegy'" in note for note in filled.notes)
    named = {"identifier": "Azonosító", "grade": "Jegy", "maximum": "Legjobb"}
    assert fill_worksheet(data.encode(), "w.csv", [result("41")], headings=named).data == filled.data


def test_comments_are_html_and_harmless() -> None:
    """A comment is escaped text in a tag, in the column of comments."""
    bad = stage("jacobian", "error", message="raised ValueError: <script>alert(1)</script>\n=cmd|x")
    comments = {"41": f"=1+1 & {bad.message}"}
    filled = fill_worksheet(ENGLISH, "w.csv", [result("41", bad)], comments=comments)
    rows = list(csv.DictReader(io.StringIO(filled.data.decode())))
    assert rows[0]["Feedback comments"].startswith("<pre>=1+1 &amp; raised ValueError: &lt;script&gt;")
    assert rows[1]["Feedback comments"] == "=old, kept"


def test_a_comment_that_is_there_stays() -> None:
    """Somebody wrote it; our own is written again without a word."""
    comments = {"41": "Well done.", "42": "Well done."}
    results = [result("41"), result("42")]
    filled = fill_worksheet(ENGLISH, "w.csv", results, comments=comments)
    rows = list(csv.DictReader(io.StringIO(filled.data.decode())))
    assert [row["Feedback comments"] for row in rows] == ["<pre>Well done.</pre>", "=old, kept", ""]
    assert [row["Grade"] for row in rows] == ["90", "90", ""]
    (note,) = (note for note in filled.notes if "comment" in note)
    assert note.startswith("Have another comment already: 42; it stays.")
    assert fill_worksheet(filled.data, "w.csv", results, comments=comments).data == filled.data


@pytest.mark.parametrize("language", sorted(LANGUAGES))
def test_a_line_that_cannot_be_changed_stays_and_is_listed(language: str) -> None:
    """Moodle would skip it without a word: the mark is locked or overridden there."""
    data = LANGUAGES[language][0]
    locked = data.replace(b'90.00,Yes,-,-,"=old', b'90.00,No,-,-,"=old').replace(b'Ja;-;-;"=alt', b'Nein;-;-;"=alt')
    assert locked != data
    comments = {"41": "Well done.", "42": "Well done."}
    filled = fill_worksheet(locked, "w.csv", [result("41"), result("42")], comments=comments)
    assert imported(filled.data, language) == {"41": "90", "42": imported(data, language)["42"], "43": ""}
    assert filled.data.splitlines()[2] == locked.splitlines()[2]
    assert "Cannot be changed in Moodle: 42; the line stays as it was." in filled.notes
    assert not any("comment" in note for note in filled.notes)


def test_the_column_of_locked_lines_may_be_named() -> None:
    """Its heading is not known in every language, its answer is."""
    dutch = ENGLISH.replace(b"Grade can be changed", b"Wijzigen").replace(
        b'90.00,Yes,-,-,"=old', b'90.00,Nee,-,-,"=old'
    )
    filled = fill_worksheet(dutch, "w.csv", [result("41"), result("42")], headings={"changeable": "Wijzigen"})
    assert imported(filled.data, "en") == {"41": "90", "42": "55.00", "43": ""}


@pytest.mark.parametrize(
    ("folder", "line"),
    [
        ("Zoë ONeill_43", '"Participant 43","Zoë O\'Neill",zoe@uni.edu,,90.00'),
        ("Team 1-Zoë ONeill_43", '"Participant 43","Zoë O\'Neill",zoe@uni.edu,,90.00'),
        ("Participant_43", '"Participant 43",Participant 43,,,90.00'),
    ],
    ids=["a name that Moodle cleans", "a group", "blind marking"],
)
def test_with_a_roster_the_number_of_the_upload_finds_the_line(folder: str, line: str, tmp_path: Path) -> None:
    """The result carries the roster's id, which Moodle does not know; the participant's number stands beside it."""
    work = {f"{folder}_assignsubmission_file_/slam1d.py": CODE, "Ann Lee_8_assignsubmission_file_/slam1d.py": CODE}
    uploads = collect([write(tmp_path / "class", work)])
    said = {one.id: "s1003" for one in uploads if "43" in one.id} if "Participant" in folder else {}
    assigned = assign(uploads, People([Student("s1003", "Zoë O'Neill"), Student("s1004", "Ann Lee")], None), said)
    results = [
        result(one.id, student_id=assigned[one.id].student_id, by=assigned[one.id].by, account=assigned[one.id].account)
        for one in uploads
    ]
    assert {one.student_id for one in results} == {"s1003", "s1004"}
    sheet = f'Identifier,"Full name","Email address",Grade,"Maximum grade"\n{line}\n"Participant 8",Ann Lee,,,90.00\n'
    rows = list(csv.DictReader(io.StringIO(fill_worksheet(sheet.encode(), "w.csv", results).data.decode())))
    assert [row["Grade"] for row in rows] == ["90", "90"]


@pytest.mark.parametrize("maximum", ['"1,000.00"', '"1.000,00"', "1'000.00", ""])
def test_another_maximum_is_seen_however_it_is_written(maximum: str) -> None:
    """A hundred points are not written out of a thousand."""
    sheet = f'Identifier,"Full name",Grade,"Maximum Grade"\n"Participant 43","Jane Doe",,{maximum}\n'
    with pytest.raises(UsageError, match="is out of 1000 points|states no maximum"):
        fill_worksheet(sheet.encode(), "w.csv", [result("43")])


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (ENGLISH.replace(b"Participant 41", b"jane"), "line 2: 'jane' is no identifier of a participant"),
        (ENGLISH.replace(b"Participant 42", b"Participant 41"), "lines 2 and 3: they have the same id"),
        (ENGLISH.replace(b"90.00", b"100.00"), "is out of 100 points, and the results are out of 90"),
        (re.sub(rb"Participant 4", b"Participant 77", ENGLISH), "fits none of the 1 results"),
        (ENGLISH.replace(b"Maximum grade", b"Scale"), "is graded on a scale"),
        (b"name,points\nann,\nann,\n", "no column that is known as the identifier (name, points)"),
        (b"Identifier,points\nParticipant 1,\n", "no column that is known as the grade"),
        (ENGLISH.replace(b"Yes,-,-", b"Yes,-"), "line 3: it has 9 cells, expected 10"),
        (ENGLISH.split(b"\n")[0], "has no participant"),
        (b"", "is empty"),
        (ENGLISH.replace(b"Status", b"Grade"), "has 2 columns that could be the grade"),
    ],
)
def test_a_bad_file_ends_in_a_sentence(data: bytes, words: str) -> None:
    """What cannot be filled in without a guess is refused, and says what to do."""
    with pytest.raises(UsageError) as error:
        fill_worksheet(data, "w.csv", [result("a", student_id="41")])
    assert words in str(error.value)


def found_by_moodle(path: str, participants: set[int]) -> int | None:
    """Find the participant of a path, as the importer's source does: by the parts between underscores."""
    for part in path.split("/"):
        info = part.split("_", 4)
        if (
            len(info) >= 4
            and info[1].isdigit()
            and int(info[1]) in participants
            and info[2:4] == ["assignsubmission", "file"]
        ):
            return int(info[1])
    return None


def test_the_feedback_archive_has_the_folders_that_moodle_imports() -> None:
    """Each page lies in the folder of its own student, whatever the name holds."""
    results = [result("41"), result("42"), result("43")]
    filled = fill_worksheet(ENGLISH, "w.csv", results)
    pages = {one.submission: f"page of {one.submission}".encode() for one in results}
    with zipfile.ZipFile(io.BytesIO(feedback_archive(filled.folders, filled.pairs.by_line, pages))) as archive:
        found = {found_by_moodle(name, {41, 42, 43}): archive.read(name) for name in archive.namelist()}
    assert found == {41: b"page of 41", 42: b"page of 42", 43: b"page of 43"}

"""Canvas's gradebook: marks go in, everything else stays, and what is doubtful is refused."""

from __future__ import annotations

import csv
import io
import re

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.exports.canvas.gradebook import fill_gradebook
from tests.reports.examples import result, stage

GRADEBOOK = (
    "\ufeffStudent,ID,SIS User ID,SIS Login ID,Section,Notes,Quiz (11),1D SLAM (77),Current Score,Final Score\r\n"
    "    Points Possible,,,,,,10,90,(read only),(read only)\r\n"
    '"Doe, Jane",101,u101,jdoe@uni.edu,"A ""one"", two",  =x ,7.5,,75.00,50.00\r\n'
    '"Doe, Jane",102,u102,janed@uni.edu,B,,EX,12,,\r\n'
    '"Müller, Zoë",103,,zmuller,B,,,EX,,\r\n'
    '"Student, Test",199,,a1b2c3,A,,,,,\r\n'
).encode()


def imported(data: bytes, title: str = "1D SLAM") -> dict[str, str]:
    """Read marks by ID, as the importer's documented rules say; nothing of the code under test is used."""
    text = data.decode("utf-8-sig")
    separator = ";" if text.split("\n")[0].count(";") > text.split("\n")[0].count(",") else ","
    rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True))
    header = rows[0]
    assert "Student" in header[0]
    assert "ID" in header[1]
    (column,) = [
        index for index, heading in enumerate(header) if re.fullmatch(rf"{re.escape(title)} \(\d+\)", heading.strip())
    ]
    return {row[1]: row[column].replace(",", ".") for row in rows[1:] if row and row[1]}


def test_only_our_column_changes() -> None:
    """Marks stand in the column of the assignment; every other byte is as Canvas wrote it."""
    results = [result("doejane_101"), result("x", stage("jacobian", "partial", 7.5), student_id="102")]
    filled = fill_gradebook(GRADEBOOK, "g.csv", results, assignment="1D SLAM")
    wanted = GRADEBOOK.replace(b"7.5,,75.00", b"7.5,90,75.00").replace(b"EX,12,", b"EX,82.5,")
    assert filled.data == wanted
    assert imported(filled.data) == {"101": "90", "102": "82.5", "103": "EX", "199": ""}


@given(st.lists(st.floats(0, 90, width=16), min_size=3, max_size=3), st.permutations([101, 102, 199]))
def test_marks_come_back(scores: list[float], ids: list[int]) -> None:
    """What was written is read again to four decimals; filling the filled file changes nothing."""
    gradebook = GRADEBOOK.replace(b"Student, Test", b"Student, Tess")
    results = [
        replace_score(result(f"s{number}", student_id=str(number)), score)
        for number, score in zip(ids, scores, strict=True)
    ]
    filled = fill_gradebook(gradebook, "g.csv", results, assignment="77").data
    found = imported(filled)
    assert all(abs(float(found[str(number)]) - score) < 5.1e-5 for number, score in zip(ids, scores, strict=True))
    assert fill_gradebook(filled, "g.csv", results, assignment="77").data == filled


def replace_score(one, score):
    """Give a result another score."""
    return msgspec.structs.replace(one, score=score)


@pytest.mark.parametrize(
    "submission", ["doejane_101", "101", "u101", "JDOE@uni.edu", "Doe_Jane_101"], ids=lambda text: text
)
def test_ids_find_their_line(submission: str) -> None:
    """A submission is called by any id of one line, or as Canvas names the download."""
    if submission == "Doe_Jane_101":  # not as Canvas writes it: nothing is guessed
        with pytest.raises(UsageError, match="fits none"):
            fill_gradebook(GRADEBOOK, "g.csv", [result(submission)], assignment="77")
    else:
        filled = fill_gradebook(GRADEBOOK, "g.csv", [result(submission)], assignment="77")
        assert imported(filled.data)["101"] == "90"


def test_two_students_with_one_name_are_told_apart_or_left_alone() -> None:
    """A name that two have belongs to nobody; a human says whose it is."""
    results = [result("doejane_101"), result("doejane")]
    filled = fill_gradebook(GRADEBOOK, "g.csv", results, assignment="77")
    assert imported(filled.data)["102"] == "12"
    assert any("Not in g.csv: doejane;" in note for note in filled.notes)
    filled = fill_gradebook(GRADEBOOK, "g.csv", results, assignment="77", given={"doejane": "102"})
    assert imported(filled.data)["102"] == "90"


def test_semicolons_and_decimal_commas_are_kept() -> None:
    """A file with semicolons gets marks as its own numbers are written."""
    text = "Student;ID;SIS Login ID;Section;1D SLAM (77)\n Points Possible;;;;90,00\nDoe, Jane;101;jdoe;A;\n"
    text = text.replace(" Points", "    Points")
    half = [result("jdoe", stage("jacobian", "partial", 7.5))]
    filled = fill_gradebook(text.encode(), "g.csv", half)
    assert filled.data == text.replace("jdoe;A;", "jdoe;A;82,5").encode()


def test_what_is_left_alone_is_said() -> None:
    """Excused students, our own faults, strangers and absentees keep their cells, and are named."""
    results = [
        result("zmuller"),
        result("doejane_101", status="grader_error"),
        result("doejane_102", status="rejected", score=0.0),
        result("stranger"),
    ]
    filled = fill_gradebook(GRADEBOOK, "g.csv", results, assignment="1D SLAM (77)")
    assert imported(filled.data) == {"101": "", "102": "0", "103": "EX", "199": ""}
    said = "\n".join(filled.notes)
    assert "Student, Test" not in said
    for words in ("stranger", "our fault: doejane_101", "scored 0: doejane_102", "Excused in Canvas"):
        assert words in said


@pytest.mark.parametrize("sis", ["", "u199"])
def test_canvas_s_test_student_is_nobody(sis: str) -> None:
    """Its work gets no mark and nobody waits for it; a student of that name whom the institution knows is one."""
    gradebook = GRADEBOOK.replace(b'Test",199,,', f'Test",199,{sis},'.encode())
    own = result("studenttest_199", account="Canvas 199")
    filled = fill_gradebook(gradebook, "g.csv", [result("101"), own], assignment="77")
    assert imported(filled.data)["199"] == ("90" if sis else "")
    assert any("studenttest_199" in note for note in filled.notes) != bool(sis)
    alone = fill_gradebook(gradebook, "g.csv", [result("101")], assignment="77")
    assert any("Student, Test" in note for note in alone.notes) == bool(sis)


@pytest.mark.parametrize("points", ["", '"1,000.00"', "1'000.00", '"1,000"'])
def test_a_maximum_that_cannot_be_read_or_does_not_fit_is_refused(points: str) -> None:
    """A row of possible points that is missing says nothing, and that is no consent."""
    row = b"    Points Possible,,,,,,10,90,"
    gradebook = GRADEBOOK.replace(row, row.replace(b"90,", f"{points},".encode()))
    if not points:
        gradebook = b"".join(line for line in GRADEBOOK.splitlines(True) if b"Points Possible" not in line)
    with pytest.raises(UsageError, match=r"is out of 1000 points|has the maximum '1,000', which|states no maximum"):
        fill_gradebook(gradebook, "g.csv", [result("101")], assignment="77")
    filled = fill_gradebook(gradebook, "g.csv", [result("101")], assignment="77", any_maximum=True)
    assert imported(filled.data)["101"] == "90"


def without(column: str) -> bytes:
    """Take a column out of the gradebook."""
    rows = list(csv.reader(io.StringIO(GRADEBOOK.decode("utf-8-sig"))))
    index = rows[0].index(column)
    file = io.StringIO()
    csv.writer(file).writerows([row[:index] + row[index + 1 :] for row in rows])
    return file.getvalue().encode()


@pytest.mark.parametrize(
    ("data", "assignment", "words"),
    [
        (without("ID"), "77", "g.csv has no column ID, so whose line is whose cannot be told"),
        (without("Section"), "77", "no column Section"),
        (GRADEBOOK, "", "2 assignments; say which with --assignment (Quiz (11), 1D SLAM (77))"),
        (GRADEBOOK, "Project", "has no assignment 'Project'; it has Quiz (11), 1D SLAM (77). Create it in Canvas"),
        (GRADEBOOK, "11", "the column 'Quiz (11)' is out of 10 points, and the results are out of 90"),
        (GRADEBOOK.replace(b"Quiz", b"1D SLAM"), "1D SLAM", "give the number instead: 11 and 77"),
        (GRADEBOOK.replace(b",102,", b",101,"), "77", "lines 3 and 4: they have the same id"),
        (re.sub(rb",1\d\d,", b",,", GRADEBOOK), "77", "has no line with an ID"),
        (GRADEBOOK.replace(b",B,,EX,12,,", b",B,,EX"), "77", "line 4: it has 7 cells, expected 10"),
        (GRADEBOOK.replace(b"101", b"901").replace(b"103", b"903"), "77", "fits none of the 1 results"),
        (b"name,mark\nann,1\n", "77", "does not begin with the headings Student, ID, ..., Section"),
        (b"", "77", "does not begin with the headings"),
    ],
)
def test_a_bad_file_ends_in_a_sentence(data: bytes, assignment: str, words: str) -> None:
    """What cannot be filled in without a guess is refused, and says what to do."""
    with pytest.raises(UsageError) as error:
        fill_gradebook(data, "g.csv", [result("doejane_101", student_id="101")], assignment=assignment)
    assert words in str(error.value)


def test_two_submissions_of_one_student_are_refused() -> None:
    """Which of two counts is for a human to say."""
    with pytest.raises(UsageError, match="both belong to line 3"):
        fill_gradebook(GRADEBOOK, "g.csv", [result("101"), result("u101")], assignment="77")


def test_another_maximum_can_be_allowed() -> None:
    """A teacher may want the points as they are."""
    filled = fill_gradebook(GRADEBOOK, "g.csv", [result("101")], assignment="11", any_maximum=True)
    assert imported(filled.data, "Quiz")["101"] == "90"

"""The course file is read and checked; every error names the key and its line."""

from __future__ import annotations

import re
import shlex
import tomllib
from pathlib import Path
from typing import Any

from autograder.course.lines import line_of
from autograder.course.schema import KEYS, NAMED, Setting, suggestion
from autograder.course.settings import DEFAULT_POINTS, QUESTION_POINTS, Course
from autograder.errors import UsageError

MAX_FILE = 64 << 10  # bytes


def load_course(path: Path | None) -> Course:
    """Read a course file; without one the defaults hold.

    Raises
    ------
    UsageError
        Where the file cannot be read, is no TOML, or has a key or value that is not known; it names key and line.
    """
    if path is None:
        return Course()
    text = _read(path)
    try:
        data = tomllib.loads(text)
    except (RecursionError, ValueError) as error:
        raise UsageError(f"{path}{_toml_reason(error)}") from None
    values: dict[str, Any] = {}
    points = dict(DEFAULT_POINTS)
    questions: dict[str, float] = {}
    named: dict[str, Any] = {}
    for section, key, value in _settings(data, path, text):
        setting = _setting(section, key)
        if not setting.accepts(value):
            raise _complaint(path, text, section, key, f"is {_shown(value)}, expected {setting.expected}")
        if section == "points":
            points[key] = float(value)
        elif section in NAMED:
            named.setdefault(setting.field, {})[key] = setting.convert(value)
        elif setting.field == "question_points":
            questions[key.removeprefix("question_")] = setting.convert(value)
        else:
            values[setting.field] = setting.convert(value)
    if questions:
        values["question_points"] = _shares(path, questions, points["written"])
    course = Course(**values, **named, points=points)
    if course.max_score <= 0:
        raise UsageError(f"{path}: the stages in use have no points; give at least one of them points in [points].")
    if "bonus_cap" in values and course.bonus_cap < course.max_score:
        told = f"is {course.bonus_cap:g}, below the {course.max_score:g} points that there are without bonus"
        raise _complaint(path, text, "grading", "bonus_cap", told)
    return course


def _setting(section: str, key: str) -> Setting:
    return NAMED[section] if section in NAMED else KEYS[section][key]


def _shares(path: Path, questions: dict[str, float], whole: float) -> dict[str, float]:
    """Return the points of each question; those that are named must leave something sensible for the rest."""
    rest = [number for number in QUESTION_POINTS if number not in questions]
    left = whole - sum(questions.values())
    if left < -1e-9 or (not rest and left > 1e-9):
        told = " and ".join(f"question_{number} = {value:g}" for number, value in questions.items())
        raise UsageError(f"{path}: [written] {told} do not add up to the {whole:g} points of written in [points].")
    unit = sum(QUESTION_POINTS[number] for number in rest)
    filled = {**questions, **{number: left * QUESTION_POINTS[number] / unit for number in rest}}
    return {number: filled[number] for number in QUESTION_POINTS}


def _settings(data: dict[str, Any], path: Path, text: str) -> list[tuple[str, str, Any]]:
    """List (section, key, value), every one of them known."""
    found: list[tuple[str, str, Any]] = []
    for name, value in data.items():
        if name in KEYS[""]:
            found.append(("", name, value))
        elif name not in KEYS or not name:
            raise _complaint(path, text, "", name, f"is not known{suggestion(name, '')}")
        elif not isinstance(value, dict):
            raise _complaint(path, text, "", name, f"is {_shown(value)}, expected a section that begins with [{name}]")
        else:
            for key in value:
                if key not in KEYS[name] and name not in NAMED:
                    raise _complaint(path, text, name, key, f"is not known{suggestion(key, name)}")
            found += [(name, key, inner) for key, inner in value.items()]
    return found


def _complaint(path: Path, text: str, section: str, key: str, problem: str) -> UsageError:
    line = line_of(text, (section, key) if section else (key,))
    where = f"{path}, line {line}" if line else str(path)
    shown = key if re.fullmatch(r"[\w-]{1,60}", key) else repr(key[:60])
    end = "" if problem.endswith("?") else "."
    return UsageError(f"{where}: {f'[{section}] ' if section else ''}{shown} {problem}{end}")


def _read(path: Path) -> str:
    try:
        if not path.is_file():
            words = "is no file" if path.exists() else "does not exist"
            raise UsageError(
                f"The course file {path} {words}; `autograder init {shlex.quote(str(path))}` writes one to start from."
            )
        with path.open("rb") as file:
            data = file.read(MAX_FILE + 1)
    except OSError as error:
        raise UsageError(f"The course file {path} cannot be read ({error.strerror}); check its permissions.") from None
    if len(data) > MAX_FILE:
        raise UsageError(f"The course file {path} is larger than 64 KiB, expected a few dozen lines of TOML.")
    try:
        return data.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise UsageError(f"{path}, line {line}: is not UTF-8; save the course file as UTF-8.") from None


def _toml_reason(error: Exception) -> str:
    """Put the line that the parser names in front, as in our own messages."""
    if isinstance(error, RecursionError):
        return ": is nested too deeply for a course file."
    found = re.fullmatch(r"(.*) \(at (?:line (\d+), column \d+|end of document)\)", str(error).split("\n")[0])
    if found is None:
        return f": is no valid TOML ({str(error)[:200]})."
    return f"{f', line {found[2]}' if found[2] else ''}: is no valid TOML ({found[1][:200]})."


def _shown(value: Any) -> str:
    """Show a value as it stands in the file, as far as a message has room."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "a section"
    text = f'"{value}"' if isinstance(value, str) else str(value)
    return text if len(text) <= 80 else f"{text[:77]}..."

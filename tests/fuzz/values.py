"""Grades submissions that return anything at all, by the real command, and holds every page against what is true.

    python -m tests.fuzz.values --count 3000

No grader error, no failed explanation, and each message is right about shapes, kinds and exceptions. The seed is
printed; `--seed` repeats a run, and a submission that shows a fault is kept.
"""

from __future__ import annotations

import argparse
import ast
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from autograder.attempts import STRICT
from autograder.exports.gradescope.results import results_json
from autograder.verdicts import decode
from tests.fuzz.anything import ARGUMENTS, PARTS, REPORTED, Behaviour, Drawn, Value, drawn

ROOT = Path(__file__).resolve().parents[2]
_TAG = re.compile(r"<[^>]*>")
SHAPE = r"\([\d, ]*\)"
CALL = r"(?:(\w+) of )?(\w+)(?:\((?:x \+ dx\(x\), graph|[\w, ]+)\))?"  # which part of which function, in which round
CLAIMS = {
    "shape": re.compile(CALL + rf" returned shape ({SHAPE}), expected ({SHAPE})\."),
    "odd": re.compile(CALL + r" returned (nan|inf), expected finite numbers"),
    "words": re.compile(CALL + r" returned ((?!shape|nan|inf|\w*\[).*?)(?:; expected an array of real|\.$)"),
    "raised": re.compile(CALL + r" raised (\w+)"),
    "unfinished": re.compile(CALL + r" is unfinished: it raises NotImplementedError"),
    "memory": re.compile(CALL + r" needs more memory"),
    "forbidden": re.compile(CALL + r" uses the module scipy"),
}
FUNCTION = {"second_step": "gauss_newton_step"}


def grade(seed: int, count: int, folder: Path, examples: int) -> list[str]:
    """Grade so many submissions in one run, and return every fault in a sentence."""
    submissions = {f"s{number:05d}": drawn(f"{seed} {number}") for number in range(count)}
    uploads, out = folder / "uploads", folder / "out"
    uploads.mkdir()
    for name, each in submissions.items():
        (uploads / f"{name}.py").write_text(each.text, encoding="utf-8")
    words = [sys.executable, "-m", "autograder", "grade", str(uploads), "-o", str(out), "--examples", str(examples)]
    # What fails is to be seen as a user sees it.
    environment = {name: value for name, value in os.environ.items() if name != STRICT}
    ran = subprocess.run(
        [*words, "--feedback", "full"], cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    faults = [f"the command ended with {ran.returncode}: {ran.stderr[-2000:]}"] * (ran.returncode != 0)
    if "Warning" in ran.stderr:
        faults.append(f"a warning reached the terminal: {ran.stderr[-2000:]}")
    for name, each in submissions.items():
        faults += [f"{name}: {fault}" for fault in examined(out, name, each)]
    if len((out / "grades.csv").read_text("utf-8").splitlines()) != count + 1:
        faults.append("grades.csv has not one row a submission")
    if not (out / "report.html").is_file():
        faults.append("there is no report.html")
    return faults


def examined(out: Path, name: str, submission: Drawn) -> list[str]:
    """Say what is wrong with the result and the pages of one submission."""
    data = (out / "results" / f"{name}.json").read_bytes()
    result = json.loads(data)
    if result["status"] != "graded":
        return [f"is {result['status']}: {result['message']}"]
    faults = [f"an explanation failed: {flag}" for flag in result["flags"]]
    page = letters(html.unescape(_TAG.sub("", (out / "feedback" / f"{name}.html").read_text("utf-8"))))
    lost = [stage for stage in result["stages"] if stage["status"] not in {"passed", "awaiting_mark"}]
    faults += [
        f"the page does not say of {stage['name']}: {stage['message']}"
        for stage in lost
        if letters(stage["message"]) not in page
    ]
    try:
        for policy in ("full", "hint", "score"):
            json.loads(results_json(decode(data), policy))
    except Exception as error:  # noqa: BLE001 - whatever an export raises is the fault that is looked for
        faults.append(f"cannot be exported: {type(error).__name__}: {error}")
    for stage in result["stages"]:
        faults += [f"{stage['name']}: {fault}" for fault in stage_faults(stage, submission)]
        if stage["name"] in {"answers", "written"}:
            faults += [f"{stage['name']}: {fault}" for fault in answer_faults(stage, submission)]
    return faults


def answer_faults(stage: dict[str, Any], submission: Drawn) -> list[str]:
    """Hold what is said of the reported answers of one stage against what was reported."""
    said = stage["message"].replace("question 2 and 3:", "question 2: no answer. question 3:")
    names = ("iterates", "conclusion") if stage["name"] == "answers" else ("written_2", "written_3")
    reported = {name: submission.answers[name] for name in names if name in submission.answers}
    return [f"{name} = {value.code}: {said}" for name, value in reported.items() if not said_of(name, value, said)]


def said_of(name: str, value: Value, message: str) -> bool:
    """Whether a message says of a reported answer what it is."""
    if value.code == "None":
        return f"{name} is unfinished" in message or f"question {name[-1]}: no answer" in message
    if name != "iterates":
        return value.code == "'abc'" or f"{name}: got " in message or "conclusion is 'abc'" in message
    if value.words:
        return f"iterates: got {value.words}"[:40] in message
    if value.odd:
        return "iterates holds nan or inf" in message
    assert value.shape is not None
    shape = value.shape(REPORTED)
    if shape != REPORTED:
        return f"iterates has shape {shape}, expected" in message or f"iterates: got shape {shape}" in message
    return "of iterates, x^(" in message or "iterates" not in message


def letters(text: str) -> str:
    """Keep the letters and digits of a text: spaces, signs and formulas are set otherwise on a page."""
    return "".join(letter for letter in text if letter.isascii() and letter.isalnum())


def stage_faults(stage: dict[str, Any], submission: Drawn) -> list[str]:
    """Hold the marks and the words of one stage against what its function may have returned."""
    faults = []
    for check in stage["checks"]:
        behaviour = submission.behaviours.get(_function(stage["name"], check["name"]))
        if behaviour is None:
            continue
        may = behaviour.may(_size(check["counterexample"]))
        if check["passed"]:
            if not any(value.right is not False for value in behaviour.values):
                faults.append(f"{check['name']} is passed by {[value.code for value in behaviour.values]}")
        elif not check["message"]:
            faults.append(f"{check['name']} failed without a word")
        elif "it took longer" not in check["message"] and not true_of(check["message"], behaviour, may):
            faults.append(f"{check['name']}: {check['message']!r} of {behaviour.rule} {[each.code for each in may]}")
    rights = [submission.behaviours.get(_function(stage["name"], check["name"])) for check in stage["checks"]]
    always_right = all(each is not None and all(value.right for value in each.values) for each in rights)
    if rights and always_right and stage["status"] != "passed":
        faults.append(f"is right and has {stage['status']}: {stage['message']}")
    return faults


def _function(stage: str, check: str) -> str:
    if stage == "range_factor":
        return "range_residual" if check == "distances" else "range_jacobian"
    return FUNCTION.get(stage, stage)


def _size(example: dict[str, Any] | None) -> int | None:
    """Return the number of poses of a counterexample, as the rule of a behaviour counts them."""
    if not example:
        return None
    if "graph" in example:
        return int(example["graph"]["n_poses"])
    return len(example["J"][0]) if "J" in example else len(example["x"])


def true_of(message: str, behaviour: Behaviour, may: tuple[Value, ...]) -> bool:
    """Whether a message is true of a function that may have returned one of these values."""
    for kind, pattern in CLAIMS.items():
        found = pattern.search(message)
        if found and found[2] in ARGUMENTS:
            return found[2] == behaviour.function and any(_claimed(kind, found, behaviour, value) for value in may)
    return any(value.shape is not None and not value.odd for value in may)


def _claimed(kind: str, found: re.Match[str], behaviour: Behaviour, value: Value) -> bool:
    if kind == "shape":
        wanted = ast.literal_eval(found[4])
        return (
            _part(found[1], behaviour) and value.shape is not None and value.shape(wanted) == ast.literal_eval(found[3])
        )
    if kind == "odd":
        return _part(found[1], behaviour) and value.odd == found[3]
    if kind == "words":
        said = bool(value.words) and found[3].startswith(value.words.partition(", expected")[0])
        return said and (found[1] is None if behaviour.part < 0 else _part(found[1], behaviour))
    raised = {"unfinished": "NotImplementedError", "memory": "MemoryError", "forbidden": "forbidden"}.get(kind)
    return value.raised == (raised or found[3])


def _part(name: str | None, behaviour: Behaviour) -> bool:
    """Whether the part that a message names is the one that may be wrong."""
    parts = PARTS.get(behaviour.function)
    return name is None if parts is None else behaviour.part >= 0 and name == parts[behaviour.part]


def main() -> None:
    """Read the command line and run."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=3000)
    parser.add_argument("--seed", type=int, default=time.time_ns() % 1_000_000)
    parser.add_argument("--examples", type=int, default=10)
    told = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix="anything-"))
    began = time.perf_counter()
    faults = grade(told.seed, told.count, folder, told.examples)
    print("\n".join(faults))
    seconds = time.perf_counter() - began
    print(f"{told.count} submissions with seed {told.seed} in {seconds:.0f} s: {len(faults)} faults.", end=" ")
    print(f"Everything is kept in {folder}." if faults else "No page is wrong.")
    if not faults:
        shutil.rmtree(folder)
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()

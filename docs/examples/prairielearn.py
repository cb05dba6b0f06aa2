"""What an external grader of PrairieLearn runs: grade /grade/student, write /grade/results/results.json.

Set it as the entry point of an image in which this grader is installed (`pip install .`). The points are shares of
the question's points on PrairieLearn.
"""

import json
import subprocess
import sys
from pathlib import Path

FAULT = "The grader could not grade this submission. This is no fault of yours; the course staff can see why."


def converted(result: dict) -> dict:
    """Write a result of `autograder grade --json` as PrairieLearn wants it."""
    if result["score"] is None:
        return {"gradable": False, "message": FAULT}
    if result["status"] == "rejected":
        return {"gradable": False, "format_errors": [result["message"]]}
    tests = [
        {
            "name": f"{stage['name']}: {check['name']}".replace("_", " "),
            "points": check["points"],
            "max_points": check["max_points"],
            "message": "" if check["passed"] else check["message"],
        }
        for stage in result["stages"]
        for check in stage["checks"]
    ]
    return {"gradable": True, "score": min(result["score"] / result["max_score"], 1.0), "tests": tests}


def main(root: Path) -> None:
    """Grade the one submission that lies in ROOT/student; whatever happens, a results.json is there."""
    target = root / "results" / "results.json"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(json.dumps({"gradable": False, "message": FAULT}), encoding="utf-8")
    command = [sys.executable, "-I", "-m", "autograder", "grade", root / "student", "-o", root / "graded", "--json"]
    done = subprocess.run(command, stdout=subprocess.PIPE, check=False, timeout=600)
    results = [json.loads(line) for line in done.stdout.splitlines()]
    if len(results) == 1:
        target.write_text(json.dumps(converted(results[0])), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "/grade"))

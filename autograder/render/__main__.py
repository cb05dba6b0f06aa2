"""Write the rendered files of a checkout anew: `python -m autograder.render [FOLDER]`."""

from __future__ import annotations

import sys
from pathlib import Path

from autograder.problems.problem import worked_problem
from autograder.render.handout import render_assignment, write_files


def main(arguments: list[str]) -> int:
    """Render the assignment for the worked example into FOLDER/assignment (default: here)."""
    root = Path(arguments[0] if arguments else ".")
    if not (root / "assignment" / "posegraph.py").is_file():
        print(f"expected the folder of a checkout, got {root}: no assignment/posegraph.py in it", file=sys.stderr)
        return 2
    changed = write_files(render_assignment(worked_problem()), root / "assignment")
    print("changed:", ", ".join(changed) if changed else "nothing")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Write the rendered files of a checkout anew: `python -m autograder.render [FOLDER]`."""

from __future__ import annotations

import sys
from pathlib import Path

from autograder.problems.problem import worked_problem
from autograder.render.handout import render_assignment, write_files
from autograder.render.solution import execute, render_solution


def main(arguments: list[str]) -> int:
    """Render assignment and worked solution for the worked example into FOLDER (default: here)."""
    root = Path(arguments[0] if arguments else ".")
    if not (root / "assignment" / "posegraph.py").is_file():
        print(f"expected the folder of a checkout, got {root}: no assignment/posegraph.py in it", file=sys.stderr)
        return 2
    changed = write_files(render_assignment(worked_problem()), root / "assignment")
    solution = render_solution(worked_problem())
    solution["slam1d.ipynb"] = execute(solution["slam1d.ipynb"])
    changed += write_files(solution, root / "reference_solution")
    print("changed:", ", ".join(changed) if changed else "nothing")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""The course file to start from: every setting with its default and what it means."""

from __future__ import annotations

from pathlib import Path

from autograder.course.settings import BONUS, DEFAULT_POINTS, QUESTION_POINTS, STAGES, Course
from autograder.errors import UsageError

_DEFAULT = Course()


def _lines(points: dict[str, float], comment: str = "") -> str:
    width = max(map(len, points))
    return "\n".join(f"{comment}{name:<{width}} = {value:g}" for name, value in points.items())


COURSE_TEMPLATE = f'''\
# Settings of this course. Every command takes this file with --course; what is left out keeps its default.
# The values below are the defaults. Numbers are plain numbers, texts stand in quotes.

title = "{_DEFAULT.title}"    # name of the homework on reports

[points]
# Points of each stage; a stage's checks share them. The maximum is the sum over the stages in use.
{_lines({name: value for name, value in DEFAULT_POINTS.items() if name not in BONUS})}
# Bonus stages, beyond the maximum.
{_lines({name: value for name, value in DEFAULT_POINTS.items() if name in BONUS})}

[grading]
# The stages that this course uses; they are always reported in this order.
stages = [
{chr(10).join(f'    "{stage}",' for stage in STAGES)}
]
# A mistake is paid for once: share of the points, 0 to 1, for a step that is right by itself where an earlier
# function is wrong. It is asked again with right functions in the place of the student's own.
follow_through = {_DEFAULT.follow_through:g}
# What a score may reach when bonus points are added.
bonus_cap = {_DEFAULT.bonus_cap:g}
# Drawn cases a stage. More find rarer mistakes and take longer.
examples = {_DEFAULT.examples}
# Seed of the draw, a whole number: the same seed gives the same cases and the same marks. Without this line
# the command line decides (--seed), and 0 holds where it does not.
# seed = 2026

[limits]
# CPU time that a check may take, in seconds. The wall clock gets three times, a submission four times as much.
time = {_DEFAULT.time_limit:g}
# Memory that a submission may take, in MiB.
memory = {_DEFAULT.memory_mib}
# What a submission may print, in MiB; it is thrown away.
output = {_DEFAULT.output_mib}

[feedback]
# What a student is shown of a failed check:
#   "full"   the smallest case that fails, with the value that was expected, and a hint
#   "hint"   the hint only
#   "score"  marks only
policy = "{_DEFAULT.feedback}"
# Until the last due date has passed, extensions and late days included, students may be shown less.
# before_due = "hint"

[late]
# When the homework is due; without this line nothing is late. The time of a submission is what the export of the
# learning platform says (Gradescope, nbgrader); where it says nothing, no penalty is taken.
# due = 2026-11-20T23:59:00+01:00
# The time zone of the course: days end at the hour of the due date there, also where the clock was changed.
# zone = "Europe/Berlin"
# Minutes after the due date that cost nothing.
grace_minutes = {_DEFAULT.grace_minutes:g}
# Per cent of the maximum that each begun day costs.
per_day = {_DEFAULT.late_per_day:g}
# After so many days a submission scores 0; without this line it is taken however late.
# days = 3

[extensions]
# Other due dates, by name of the submission or by student id; a name with blanks or accents stands in quotes.
# ada_lindqvist = 2026-11-27T23:59:00+01:00

[written]
# Points of the written answers; together they are those of written in [points]. Without these lines they share
# them in the proportion {" : ".join(f"{value:g}" for value in QUESTION_POINTS.values())}.
{chr(10).join(f"# question_{number} = {value:g}" for number, value in QUESTION_POINTS.items())}
# Marking guide, as markdown; without this line it is that of the worked solution.
# guide = """Question 2, 1 point: ..."""

[variants]
# The families that personal variants are drawn from, for `autograder release`; one that stands twice is drawn twice
# as often.
#   "W"  one loop, equal variances        "B"  a loop that begins at pose 1
#   "A"  one loop, unequal variances      "C"  two overlapping loops
#   "D"  twelve poses, code only          "L"  landmarks
#   "E"  the worked example, the same for everybody
families = ["{'", "'.join(_DEFAULT.families)}"]

[confinement]
# The least confinement under which this course is graded; `autograder doctor` says what this machine gives.
#   "full"     system call filter and Landlock
#   "seccomp"  system call filter
#   "none"     time-outs only; grade only code that you trust
minimum = "{_DEFAULT.min_confinement}"
'''


def write_course(path: Path) -> None:
    """Write the course file to start from; raises UsageError where something is there already."""
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(COURSE_TEMPLATE)
    except FileExistsError:
        raise UsageError(f"{path} is there already and was not changed; give another name or remove it.") from None
    except FileNotFoundError:
        raise UsageError(f"{path} cannot be written: its folder does not exist; create it first.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise UsageError(f"{path} cannot be written ({reason}); give a path that you may write to.") from None

"""The course file: what a teacher may set, its defaults, and errors that name key and line."""

from autograder.course.loading import load_course
from autograder.course.settings import BONUS, DEFAULT_POINTS, STAGES, Course, Feedback, Level
from autograder.course.template import COURSE_TEMPLATE, write_course

__all__ = [
    "BONUS",
    "COURSE_TEMPLATE",
    "DEFAULT_POINTS",
    "STAGES",
    "Course",
    "Feedback",
    "Level",
    "load_course",
    "write_course",
]

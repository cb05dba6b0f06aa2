"""Moodle: the grading worksheet, and feedback files in the folders that an assignment imports."""

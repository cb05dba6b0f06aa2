"""The problems: drawn graphs for the grader, personal variants for the students."""

"""Otter: the master notebook from which `otter assign` makes the student's notebook and an autograder.zip."""

"""Gradescope: an autograder.zip that grades with this program, and the results.json that it writes."""

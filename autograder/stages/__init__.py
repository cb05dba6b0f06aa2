"""What is asked and how it is judged: one file, one stage."""

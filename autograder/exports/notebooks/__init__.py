"""What notebooks for other graders have in common: the questions, their hidden tests, and the code that judges."""

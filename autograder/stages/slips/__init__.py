"""Known mistakes, one file a stage: each is a wrong implementation with a name and a hint."""

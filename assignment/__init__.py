"""What a student receives: the problem model, the stubs and the handout. No answers."""

"""What is right, shaped like a submission."""

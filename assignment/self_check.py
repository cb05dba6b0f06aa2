"""Self-check."""

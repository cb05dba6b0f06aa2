"""Problem families: one file is one family, found by being here."""

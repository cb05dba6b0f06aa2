"""Marking at a desk: a page on this machine, for one reader, whose every mark is stored at once."""

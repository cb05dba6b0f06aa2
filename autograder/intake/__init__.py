"""Uploads as they come (files, folders, archives, exports of an LMS) become submissions.

Nothing here executes or parses what a student wrote: sources are read as text within bounds, and
go to the locked child as text. What cannot be read is said in one sentence and stops nobody else.
"""

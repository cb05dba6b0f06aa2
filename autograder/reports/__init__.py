"""What grading found, written for a terminal, a spreadsheet and a browser: one file a format."""

"""Canvas: the gradebook's CSV file, and feedback files under the names of the uploads."""

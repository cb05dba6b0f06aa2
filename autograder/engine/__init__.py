"""From submissions to results: the drawn cases, the judging, the processes, the store."""

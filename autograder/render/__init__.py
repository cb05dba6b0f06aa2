"""What students are handed, written from templates, the problem's numbers and the reference's signatures."""

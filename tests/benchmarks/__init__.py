"""Measurements: run with `make bench`, never by the tests."""

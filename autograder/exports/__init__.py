"""Exports: files that other systems import. One system is one module or one folder."""

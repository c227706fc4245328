"""The report of the math functions."""

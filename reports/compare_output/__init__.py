"""Compares outputs of programs, field by field: how many digits agree, where they part, and whose error it is."""

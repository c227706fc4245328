"""Reads what a run left, JSON by its schemas and CSV, and the numbers, types and steps in it."""

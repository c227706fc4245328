"""The report of the scenes."""

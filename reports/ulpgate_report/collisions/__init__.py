"""The report of collisions."""

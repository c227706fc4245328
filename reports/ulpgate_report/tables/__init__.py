"""What a table is, and each format that one is written in."""

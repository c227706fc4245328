"""What tests share: synthetic records, damaged input, LaTeX."""

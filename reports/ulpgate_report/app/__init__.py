"""The program: command line, exit codes, and all files of a report."""

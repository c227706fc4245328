"""What can end a comparison early, each with the exit code that it stands for."""

PASS, DIFFERENT, BAD_INPUT, NOTHING, ENVIRONMENT = 0, 1, 2, 3, 4


class Problem(Exception):
    """Says what is wrong and where; `code` is the exit code of the program."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code

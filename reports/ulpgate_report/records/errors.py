"""The expected failures of a report and the exit code of each."""


class ReportError(Exception):
    """A failure that the caller can act on; the message says what and where."""

    exit_code = 4


class InvalidInput(ReportError):
    """A record or the usage is wrong; the message names file and line."""

    exit_code = 2


class NothingMeasured(ReportError):
    """The directory holds no record."""

    exit_code = 3


class Incomplete(ReportError):
    """Less is there than the run says it did."""

    exit_code = 3


class OutputFailure(ReportError):
    """The result cannot be written."""

    exit_code = 4

"""What the night shares with the scripts for many machines: exit codes, failures with one, locks, files that are never torn."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir, "cluster"))
from shards import (  # noqa: E402, F401
    BAD_INPUT,
    ENVIRONMENT,
    INCOMPLETE,
    PASS,
    REGRESSION,
    ROOT,
    Failure,
    lock,
    main_of,
    whole,
    write_aside,
)


def more_serious(a, b):
    """Of two exit codes: 4, 2 and 3 say that there is no verdict, 1 that there is a bad one."""
    order = (PASS, REGRESSION, INCOMPLETE, BAD_INPUT, ENVIRONMENT)
    return max(
        a, b, key=lambda code: order.index(code) if code in order else len(order)
    )

"""Commands as a page or a help shows them, at a size that takes a second."""

import re

# What is replaced, in this order.
_SMALLER = [
    (r"--samples \d+", "--samples 60"),
    (r"--seconds \d+", "--seconds 1"),
    (r"--evaluations \d+", "--evaluations 500"),
    (r"--types all", "--types float,double"),
    (r"--steps \d+", "--steps 20"),
    (r"--repeats \d+", "--repeats 2"),
    (r"--snapshots \S+", "--snapshots 0"),
    # Five rounds of timing otherwise.
    (r"ulpgate work-precision (?!.*--repeats)", "ulpgate work-precision --repeats 1 "),
    (r"ulpgate math (?!.*--functions)", "ulpgate math --functions exp "),
    (
        r"ulpgate kernels (?!--audit|.*--kernels)",
        "ulpgate kernels --kernels sphere_sphere ",
    ),
    # What it finds goes nowhere but into the test's own directory.
    (r"--worst-cases ci/worst_cases", "--worst-cases ."),
]


def smaller(command):
    """The same command at a small size."""
    for large, small in _SMALLER:
        command = re.sub(large, small, command)
    return command

"""The command line of the paper: RUNS to OUT, or the check of what was written."""
import argparse
import sys
from pathlib import Path

from ulpgate_report.paper import check, reproduce, write
from ulpgate_report.records.errors import ReportError

EXIT_OK, EXIT_REGRESSION = 0, 1


def _parser():
    parser = argparse.ArgumentParser(
        prog="reports/paper.py",
        description="Tables, figures, findings and a LaTeX document from the runs that scripts/paper made.",
        epilog="exit codes: 0 ok, 1 a number has no record or a finding is not shown again, 2 bad usage or invalid input, 3 nothing measured, 4 I/O failure",
    )
    parser.add_argument("runs", metavar="RUNS", type=Path, help="the runs")
    parser.add_argument(
        "--out", metavar="OUT", type=Path, required=True, help="where the paper stands"
    )
    parser.add_argument(
        "--history", metavar="FILE", type=Path, help="runs of `ulpgate history --add`"
    )
    parser.add_argument(
        "--check",
        action="store_true",
        help="trace every number of OUT to a record of RUNS and write nothing but OUT/trace.csv",
    )
    parser.add_argument(
        "--ulpgate",
        metavar="PROGRAM",
        help="with --check: run the command of every finding again with this program",
    )
    return parser


def main(argv):
    """Write a paper or check one; returns the exit code."""
    options = _parser().parse_args(argv)

    def tell(text):
        print(f"paper: {text}", file=sys.stderr, flush=True)

    try:
        if options.check:
            said, untraced = check.check(options.runs, options.out, options.history)
            if options.ulpgate:
                count, others = reproduce.run(
                    options.ulpgate, options.out, options.runs
                )
                untraced += others
                said += f"; {count - len(others)} of {count} commands of findings show what the finding says"
            for line in untraced:
                print(f"paper: {line}", file=sys.stderr)
            print(said)
            return EXIT_REGRESSION if untraced else EXIT_OK
        for sentence in write.write(options.runs, options.out, options.history, tell):
            tell(f"left out: {sentence}")
    except ReportError as error:
        print(f"paper: {error}", file=sys.stderr)
        return error.exit_code
    return EXIT_OK

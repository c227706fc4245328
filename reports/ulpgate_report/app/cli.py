"""The command line of the reports: arguments, messages and exit codes."""
import argparse
import dataclasses
import os
import sys
from pathlib import Path

from ulpgate_report.app import build
from ulpgate_report.history import history_file
from ulpgate_report.libraries import beside
from ulpgate_report.records import records, suite
from ulpgate_report.records.errors import InvalidInput, OutputFailure, ReportError
from ulpgate_report.tables import table_text
from ulpgate_report.standing import standing
from ulpgate_report.work_precision import axes

EXIT_OK = 0


def _pair(text):
    try:
        return axes.pair(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _parser():
    parser = argparse.ArgumentParser(
        prog="report",
        description="Tables, figures and a page from the records that `ulpgate` wrote to DIR: of math functions, of DEM kernels, "
        "of scenes, of collisions, of the pendulum, of integrators, of stiff and extreme cases and of error against run time, whichever are there; "
        "DIR may also be a directory of such directories.",
        epilog="exit codes: 0 ok, 2 bad usage or invalid input, 3 nothing measured, 4 I/O failure",
    )
    parser.add_argument(
        "directories",
        metavar="DIR",
        nargs="+",
        help="the records; several: functions of libraries side by side, LABEL=DIR names one",
    )
    parser.add_argument(
        "--axes",
        metavar="X,Y",
        action="append",
        default=[],
        type=_pair,
        help="draw error against run time with these axes, two of "
        f"{', '.join(axes.QUANTITIES)}; may be given more than once (default: {','.join(axes.DEFAULT)})",
    )
    parser.add_argument(
        "--history",
        metavar="FILE",
        type=Path,
        help="also the trends of the runs that `ulpgate history --add` put into FILE",
    )
    parser.add_argument(
        "--gate",
        metavar="FILE",
        type=Path,
        help="what `ulpgate gate DIR --json` printed: the page says first whether the run passed",
    )
    parser.add_argument(
        "--before",
        metavar="DIR",
        type=Path,
        help="an earlier run: the page says which rows are others now",
    )
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--out", metavar="OUT", type=Path, help="write the report there")
    what.add_argument(
        "--print",
        dest="to_terminal",
        action="store_true",
        help="print the main tables",
    )
    return parser


def _named(text):
    """("LABEL", DIR) of LABEL=DIR, (None, DIR) of a directory."""
    label, equals, path = text.partition("=")
    if equals and label and not Path(text).is_dir():
        return label, Path(path)
    return None, Path(text)


def _load(words):
    """The run of one directory, or the functions of several side by side."""
    named = [_named(word) for word in words]
    if len(named) == 1 and named[0][0] is None:
        return suite.load(named[0][1])
    runs = [records.load(path) for _, path in named]
    for (_, path), run in zip(named, runs):
        if not run.math:
            raise InvalidInput(f"{path}: no functions, which alone stand side by side")
    found = beside.of(runs, [label for label, _ in named])
    complete = all(run.context.get("complete", True) for run in runs)
    context = {**runs[0].context, "complete": complete}
    return records.Run(context, [], {}, libraries=found)


def _print_tables(parts):
    shown = [table for kind, data in parts for table in kind.printed(data)]
    try:
        sys.stdout.write("\n".join(map(table_text.render, shown)))
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader, `head` say, has seen enough. Python would flush once more at exit and complain.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        # What stays in the buffer would fail a second time when the interpreter ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise OutputFailure(f"cannot print: {error.strerror}") from error


def main(argv):
    """Run one report; returns the exit code."""
    arguments = _parser().parse_args(argv)
    try:
        run = _load(arguments.directories)
        # Each pair once, as it was given first.
        run = dataclasses.replace(run, axes=tuple(dict.fromkeys(arguments.axes)))
        if arguments.history is not None:
            run = dataclasses.replace(run, history=history_file.load(arguments.history))
        if arguments.gate is not None:
            run = dataclasses.replace(run, gate=standing.load_gate(arguments.gate))
        if arguments.before is not None:
            run = dataclasses.replace(run, before=records.load(arguments.before))
        parts = build.parts_of(run)
        if not run.context.get("complete", True):
            print(
                "report: the run is incomplete; missing samples are not judged",
                file=sys.stderr,
            )
        if arguments.to_terminal:
            _print_tables(parts)
        else:
            said = build.write_report(run.context, parts, arguments.out, run.notes)
            for sentence in said:
                print(f"report: {sentence}", file=sys.stderr)
    except ReportError as error:
        print(f"report: {error}", file=sys.stderr)
        return error.exit_code
    return EXIT_OK

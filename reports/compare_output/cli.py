"""ulpgate compare-output: two outputs of a program, field by field, and a third that tells whose error a difference is.

REF is what is trusted so far, OUT what is judged, WIDE the same run in more digits.  Each is a file (CSV or other text in
columns, legacy or XML VTK, HDF5 where h5py is there), or a directory of such files, compared by their names, in which the
type of the numbers may differ (packing_float_30000.csv and packing_double_30000.csv).  Fields go by name and rows by a
key: columns --key names, else the first of id, body, particle, step ... that tells all rows apart, else by their place.

Limits (--field NAME=LIMIT, NAME may hold * and ?; a file of limits has them in a table [fields]):
  exact            the same number or text; what whole numbers and texts are held to unless told otherwise
  ulp:N[:TYPE]     within N units in the last place of a TYPE (float, double, long_double, float128)
  norm:E           within E of the largest value of the field
  derived[:F]      nearer to WIDE than F times REF is (F is 4): the tolerance is REF's own error, and nobody's guess
  noise            reported, not judged
Without WIDE every field is exact unless a limit is given, with WIDE numbers are derived.

Exit codes: 0 all fields within their limits, 1 one beyond, or a row, field or file that only one has, 2 bad usage or input
(file and line are named), 3 nothing to compare, 4 a file cannot be read or written."""
import argparse
import os
import sys
from dataclasses import dataclass, field
from pathlib import Path

from compare_output import bless, judge, limits, show
from compare_output.file_names import counterparts
from compare_output.problem import (
    BAD_INPUT,
    DIFFERENT,
    ENVIRONMENT,
    NOTHING,
    PASS,
    Problem,
)
from compare_output.read import SUFFIXES, read


@dataclass
class Pair:
    """A file of REF and of OUT, and of WIDE where there is one."""

    ref: Path
    out: Path | None
    wide: Path | None = None
    missing: str = ""
    comparisons: list = field(default_factory=list)


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Problem(BAD_INPUT, f"{message} (ulpgate compare-output --help)")


def options_of(words):
    p = _Parser(
        prog="ulpgate compare-output",
        description=__doc__.split("\n", 1)[1].strip(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
        epilog="examples:\n"
        "  ulpgate compare-output good/series.csv new/series.csv --field 'energy*=norm:1e-9'\n"
        "  ulpgate compare-output float.csv double.csv --wide float128.csv",
    )
    p.add_argument("ref", metavar="REF", type=Path)
    p.add_argument("out", metavar="OUT", type=Path)
    p.add_argument("more", metavar="WIDE", type=Path, nargs="?")
    p.add_argument("--wide", metavar="WIDE", type=Path, help="as the third word")
    p.add_argument(
        "--key", metavar="NAME,...", default="", help="fields that tell rows apart"
    )
    p.add_argument("--field", metavar="NAME=LIMIT", action="append", default=[])
    p.add_argument("--limits", metavar="FILE", type=Path, help="a TOML file of limits")
    p.add_argument("--json", action="store_true")
    p.add_argument(
        "--bless", action="store_true", help="make OUT the new REF, after comparing"
    )
    p.add_argument(
        "--reason", metavar="TEXT", help="why, kept beside REF (REF.blessed.jsonl)"
    )
    p.add_argument(
        "--new", action="store_true", help="with --bless: there is no REF yet"
    )
    options = p.parse_args(words)
    if options.wide and options.more:
        raise Problem(BAD_INPUT, "WIDE is given twice")
    options.wide = options.wide or options.more
    for flag in ("reason", "new"):
        if getattr(options, flag) and not options.bless:
            raise Problem(BAD_INPUT, f"--{flag} is for --bless")
    return options


def rules_of(options):
    rules = limits.read_file(options.limits) if options.limits else []
    for text in options.field:
        name, separator, limit = text.rpartition("=")
        if not separator or not name:
            raise Problem(BAD_INPUT, f"--field '{text}': NAME=LIMIT is wanted")
        rules.append((name, limits.parse(limit, "--field")))
    return rules


def _files(directory):
    return {
        f.relative_to(directory)
        for f in directory.rglob("*")
        if f.is_file() and f.suffix in SUFFIXES
    }


def pairs_of(options):
    ref, out, wide = options.ref, options.out, options.wide
    if not out.exists():
        raise Problem(BAD_INPUT, f"{out}: no such file or directory")
    if wide is not None and not wide.exists():
        raise Problem(BAD_INPUT, f"{wide}: no such file or directory")
    if not ref.exists() and not (options.bless and options.new):
        raise Problem(BAD_INPUT, f"{ref}: no such file or directory")
    if not out.is_dir():
        if ref.is_dir() or (wide is not None and wide.is_dir()):
            raise Problem(
                BAD_INPUT, "REF, OUT and WIDE are all files or all directories"
            )
        return [Pair(ref, out, wide)]
    if (ref.exists() and not ref.is_dir()) or (wide is not None and not wide.is_dir()):
        raise Problem(BAD_INPUT, "REF, OUT and WIDE are all files or all directories")
    of_ref = _files(ref) if ref.exists() else set()
    of_out = _files(out)
    of_wide = _files(wide) if wide is not None else set()
    if options.bless:
        # A file becomes the new one of its own name.
        partner = {name: name for name in of_ref & of_out}
    else:
        partner = counterparts(of_ref, of_out)
    third = {**counterparts(of_out, of_wide), **counterparts(of_ref, of_wide)}

    def wide_of(name):
        return wide / third.get(name, name) if wide is not None else None

    pairs = []
    for name in of_ref:
        if name in partner:
            pairs.append(Pair(ref / name, out / partner[name], wide_of(name)))
        else:
            pairs.append(Pair(ref / name, None, wide_of(name), f"OUT has no {name}"))
    for name in of_out - set(partner.values()):
        missing = f"REF has no {name}"
        pairs.append(Pair(ref / name, out / name, wide_of(name), missing))
    return sorted(pairs, key=lambda pair: pair.ref)


def compare_pair(pair, rules, key):
    """Fills in the comparisons of a pair of files that are both there."""
    ref, out = read(pair.ref), read(pair.out)
    wide = read(pair.wide) if pair.wide is not None else {}
    for name in [*ref, *(n for n in out if n not in ref)]:
        if name not in ref or name not in out:
            who = "OUT" if name not in out else "REF"
            pair.missing += ("; " if pair.missing else "") + f"{who} has no {name}"
            continue
        third = wide.get(name)
        if pair.wide is not None and third is None:
            raise Problem(BAD_INPUT, f"{pair.wide}: no {name or 'table'} in it")
        pair.comparisons.append(
            judge.compare(name, ref[name], out[name], third, rules, key)
        )


def run(words):
    options = options_of(words)
    if options.bless:
        bless.check(options.ref, options)
    rules = limits.Limits(rules_of(options), options.wide is not None)
    key = [k.strip() for k in options.key.split(",") if k.strip()]
    pairs = pairs_of(options)
    for pair in pairs:
        if not pair.missing and pair.ref.exists():
            compare_pair(pair, rules, key)
        elif pair.out is not None:
            read(pair.out)  # what cannot be read becomes no reference
    fields = [f for p in pairs for c in p.comparisons for f in c.fields]
    if rules.unused() and fields:
        raise Problem(
            BAD_INPUT,
            f"no field fits {', '.join(rules.unused())}; there are {', '.join(sorted({f.name for f in fields}))}",
        )
    first = options.bless and options.new
    if not first or fields:
        print(show.json_of(pairs) if options.json else show.text_of(pairs))
    bad = any(p.missing or any(c.failed for c in p.comparisons) for p in pairs)
    if options.bless:
        changed = bless.bless(options.ref, options.out, pairs, options.reason.strip())
        print(
            f"compare-output: {len(changed)} files are the new reference; the reason stands in {bless.log_of(options.ref)}"
            if changed
            else "compare-output: the same bytes: nothing to bless",
            file=sys.stderr,
        )
        return PASS
    if bad:
        return DIFFERENT
    if not any(f.rows for f in fields if f.limit.kind != "noise"):
        print(
            "compare-output: nothing was judged: no rows, or all of it noise",
            file=sys.stderr,
        )
        return NOTHING
    return PASS


def main(words):
    try:
        code = run(words)
        sys.stdout.flush()
        return code
    except Problem as problem:
        print(f"compare-output: {problem}", file=sys.stderr)
        return problem.code
    except OSError as e:
        # A closed pipe or a full disk: what was found may not have arrived.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        print(
            f"compare-output: {e.filename or 'standard output'}: {e.strerror}",
            file=sys.stderr,
        )
        return ENVIRONMENT

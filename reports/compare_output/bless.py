"""Makes OUT the new REF, for a reason that is kept beside it."""
import hashlib
import json
import os
import shutil

from compare_output.problem import BAD_INPUT, ENVIRONMENT, Problem
from compare_output.show import summary


def log_of(ref):
    """Where the reasons stand: one JSON object a line, the oldest first."""
    return (
        ref / "blessed.jsonl"
        if ref.is_dir()
        else ref.with_name(ref.name + ".blessed.jsonl")
    )


def _sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.exists() else None


def check(ref, options):
    """Before anything is compared: a new reference is never made by silence or by a name that was mistyped."""
    reason = (options.reason or "").strip()
    if not reason:
        raise Problem(
            BAD_INPUT, "--bless takes --reason TEXT, which is kept beside the reference"
        )
    if any(ord(c) < 32 for c in reason):
        raise Problem(
            BAD_INPUT, "--reason: a line of text without control characters is wanted"
        )
    if not ref.exists() and not options.new:
        raise Problem(
            BAD_INPUT,
            f"{ref}: there is no such reference to replace; --new says that it is the first",
        )
    if ref.exists() and options.new:
        raise Problem(
            BAD_INPUT, f"{ref}: is there already, and --new is for a first reference"
        )


def bless(ref, out, pairs, reason):
    """Copies OUT over REF, each file at once or not at all, and notes why; returns the files that changed."""
    gone = [str(p.ref) for p in pairs if p.out is None]
    if gone:
        raise Problem(
            BAD_INPUT,
            f"{gone[0]}: OUT has no such file: remove it from the reference first",
        )
    changed = []
    files = [(p.ref, p.out) for p in pairs if p.out is not None]
    try:
        for old, new in files:
            before, after = _sha256(old), _sha256(new)
            if before == after:
                continue
            old.parent.mkdir(parents=True, exist_ok=True)
            aside = old.with_name(old.name + ".part")
            shutil.copyfile(new, aside)
            os.replace(aside, old)
            changed.append({"file": str(old), "before": before, "after": after})
        if changed:
            entry = {"reason": reason, "found": summary(pairs), "files": changed}
            with log_of(ref).open("a") as log:
                log.write(json.dumps(entry, sort_keys=True) + "\n")
    except OSError as e:
        raise Problem(ENVIRONMENT, f"{e.filename or ref}: {e.strerror}")
    return changed

"""What a finished job left: checksums of its records, by which a night knows what is done and two nights are the same."""

import hashlib
import json

from night_common import write_aside

# Files that hold times, or what a killed run goes on from.
NOT_RECORDS = ("timing.jsonl", "context.json", "lock", ".lock", "done")
KEPT_APART = ("units", "checkpoints")


def record_files(place):
    """The files of a job's records that depend on its plan alone, sorted."""
    if place.is_file():
        return [place]
    files = []
    for file in sorted(place.rglob("*")):
        inside = file.relative_to(place)
        if (
            file.is_file()
            and not set(inside.parts[:-1]) & set(KEPT_APART)
            and file.name not in NOT_RECORDS
        ):
            files.append(file)
    return files


def checksums(out, place):
    """{path below OUT: SHA-256} of a job's records."""
    sums = {}
    for file in record_files(place):
        digest = hashlib.sha256()
        with open(file, "rb") as stream:
            while block := stream.read(1 << 20):
                digest.update(block)
        sums[str(file.relative_to(out))] = digest.hexdigest()
    return sums


class Seals:
    """OUT/done/<name>.json, written last: what a finished job ended with and the checksums of its records."""

    def __init__(self, out):
        self.out = out

    def file(self, job):
        return self.out / "done" / f"{job.name}.json"

    def write(self, job, facts):
        file = self.file(job)
        file.parent.mkdir(parents=True, exist_ok=True)
        facts = {
            **facts,
            "name": job.name,
            "records": checksums(self.out, self.out / job.name),
        }
        write_aside(file, json.dumps(facts, indent=1) + "\n")
        return facts

    def read(self, job):
        """None where the job is not done, its seal is torn or its records are no longer what was sealed."""
        try:
            facts = json.loads(self.file(job).read_text())
            if facts["records"] and facts["records"] == checksums(
                self.out, self.out / job.name
            ):
                return facts
        except (OSError, ValueError, KeyError, TypeError):
            pass
        return None


def set_aside(out, job):
    """Moves records that are no longer what was sealed to OUT/spoiled, so that the job begins anew; where they are now."""
    place = out / job.name
    target = out / "spoiled" / job.name
    number = 1
    while target.exists():
        number += 1
        target = out / "spoiled" / f"{job.name}.{number}"
    target.parent.mkdir(parents=True, exist_ok=True)
    place.rename(target)
    return target


def write_manifest(out, done):
    """OUT/records.sha256, as of sha256sum: the same bytes for the same plan, however often the night was killed."""
    lines = {
        f"{digest}  {path}"
        for facts in done
        for path, digest in facts["records"].items()
    }
    write_aside(
        out / "records.sha256",
        "".join(line + "\n" for line in sorted(lines, key=lambda l: l.split("  ")[1])),
    )

"""What a night has done, does and has left: status.json for programs, status.txt and a line for people."""

import json
import time

from night_common import write_aside


def clock(seconds):
    """'1 h 05 min', '3 min 20 s', '12 s'."""
    seconds = int(seconds + 0.5)
    if seconds >= 3600:
        return f"{seconds // 3600} h {seconds % 3600 // 60:02} min"
    if seconds >= 60:
        return f"{seconds // 60} min {seconds % 60:02} s"
    return f"{seconds} s"


def stamp(at):
    """A time of day as ISO 8601, in UTC."""
    return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(at))


class Status:
    """Written anew whenever something changes; a full disk takes nothing from the night but this file."""

    def __init__(self, out, say):
        self.out = out
        self.say = say
        self.unwritable = ""

    def write(self, facts):
        try:
            write_aside(self.out / "status.json", json.dumps(facts, indent=1) + "\n")
            write_aside(self.out / "status.txt", line_of(facts) + "\n")
            self.unwritable = ""
        except OSError as e:
            if str(e) != self.unwritable:
                self.say(f"status: {e}; the night goes on")
            self.unwritable = str(e)


def line_of(facts):
    """'17 of 60 jobs done (1 red), running math/real_double for 3 min 20 s, 42 left, to end by ...'."""
    done = facts["done"]
    red = [d for d in done if d["verdict"] != "pass"]
    line = f"{len(done)} of {facts['jobs']} jobs done"
    if red:
        line += f" ({len(red)} not passed: {', '.join(d['name'] for d in red[:3])}{' ...' if len(red) > 3 else ''})"
    if facts["running"]:
        running = ", ".join(
            f"{r['name']} for {clock(r['seconds'])}" for r in facts["running"]
        )
        line += f", running {running}"
    if facts["left"]:
        line += f", {len(facts['left'])} left"
    if facts["state"] == "running" and facts["expected_end"]:
        line += f", should end {'at' if not facts['without_estimate'] else 'not before'} {facts['expected_end']}"
    if facts["state"] != "running":
        line += f"; {facts['state']}"
    return line

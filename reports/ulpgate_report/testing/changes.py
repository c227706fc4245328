"""Changes to a line of a run's files, for tests of what is refused."""
import json


def edit_line(directory, name, number, change):
    """Pass line `number`, from 1, of a file through `change`."""
    path = directory / name
    lines = path.read_text("utf-8").split("\n")
    lines[number - 1] = change(lines[number - 1])
    path.write_text("\n".join(lines), "utf-8")


def with_fields(**fields):
    """A change that sets fields of a JSON line; None as a value stands for null."""
    return lambda line: json.dumps({**json.loads(line), **fields})


def without(name):
    """A change that takes a field out of a JSON line."""
    return lambda line: json.dumps(
        {k: v for k, v in json.loads(line).items() if k != name}
    )

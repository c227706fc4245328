"""Checksums of a run's directory: whether context and records are still what the run wrote."""
from ulpgate_report.records import reading
from ulpgate_report.records.errors import InvalidInput

CONTEXT = "context.json"
# The last key of the context; all bytes before it are what it is of.
_OWN = ',\n  "checksum": "'
_MASK = (1 << 64) - 1


def fnv1a(text):
    """FNV-1a of the UTF-8 bytes of a text, 64 bits, as 16 hexadecimal digits."""
    number = 0xCBF29CE484222325
    for byte in text.encode("utf-8"):
        number = ((number ^ byte) * 0x100000001B3) & _MASK
    return f"{number:016x}"


def sealed(context_text):
    """The text of a context, an object of at least one key as `json.dumps(..., indent=2)` writes it, with its checksum."""
    body = context_text.rstrip().removesuffix("\n}").split(_OWN)[0]
    return f'{body}{_OWN}{fnv1a(body)}"\n}}\n'


def check(directory, context):
    """Refuse a directory that was changed since; a context without checksums is one that no run wrote."""
    if "checksum" in context:
        text = reading.read(directory / CONTEXT)
        if sealed(text) != text:
            raise InvalidInput(f"{CONTEXT}: not as the run wrote it: other checksum")
    for name, wanted in context.get("records_checksum", {}).items():
        path = directory / name
        if not path.exists():
            raise InvalidInput(f"{name}: not there, though {CONTEXT} speaks of it")
        found = fnv1a(reading.read(path))
        if found != wanted:
            raise InvalidInput(
                f"{name}: not as the run wrote it: its checksum is {found}, {CONTEXT} has {wanted}"
            )

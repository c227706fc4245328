"""The command that shows everything about a function at an argument, in the library it was judged in."""
import functools
import re

# The line of a plan that says how to call code that is not the program's own.
_CODE = re.compile(r"^code (\S+) (\S+)( --library .*?) path=", re.MULTILINE)


@functools.lru_cache(maxsize=32)
def _options(plan_text):
    """{(type, function): the options that call it}."""
    return {(m[1], m[2]): m[3] for m in _CODE.finditer(plan_text)}


def options_of(context, function, token):
    """Options that choose other code than the program's own, as in ` --library libm.so.6 --symbol sin`; "" for its own."""
    return _options(context.get("plan_text", "")).get((token, function), "")


def command_of(context, function, token, argument):
    """`ulpgate at` with the argument's words, of a run with this context."""
    words = " ".join(("ulpgate at", function, token, *argument))
    return words + options_of(context, function, token)

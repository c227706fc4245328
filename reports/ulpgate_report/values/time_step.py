"""A scene's time step: its text as a number of seconds, for order and scale, and as a label."""
import ast
import math
import operator

_OPERATIONS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def _value(node):
    if isinstance(node, ast.Expression):
        return _value(node.body)
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        return float(node.value)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_value(node.operand)
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATIONS:
        return _OPERATIONS[type(node.op)](_value(node.left), _value(node.right))
    raise ValueError("no arithmetic of numbers")


def seconds(dt):
    """The number of seconds of `1e-5` or `(1e-5)/2`, or None where the text is no such arithmetic."""
    if not isinstance(dt, str):
        return float(dt)
    try:
        found = _value(ast.parse(dt.strip(), mode="eval"))
    except (ValueError, SyntaxError, ZeroDivisionError, RecursionError, MemoryError):
        return None
    return found if math.isfinite(found) and found > 0 else None


def ordered(steps):
    """Each step once: the largest first, what has no value last, by its text."""
    known = {str(dt): seconds(dt) for dt in steps}
    return sorted(
        known, key=lambda t: (known[t] is None, -known[t] if known[t] else 0, t)
    )


def label(dt):
    """The step with its unit for an axis or a legend: 10^-5 s, 5 x 10^-6 s, or its text."""
    value = seconds(dt)
    if value is None:
        return f"{dt} s".replace("$", r"\$")
    mantissa, exponent = f"{value:.5e}".split("e")
    mantissa = f"{float(mantissa):g}"
    factor = "" if mantissa == "1" else rf"{mantissa} \times "
    return rf"${factor}10^{{{int(exponent)}}}$ s"

"""The energy account of a series: its parts, and how far their sum is from its start."""
import decimal

_NOT_ENERGY = ("step", "time_s", "mean_x_m", "mean_y_m", "mean_z_m", "angle_product")
# Angles of a chain, and how far the sum is off: no parts of it.
_NOT_ENERGY_ENDS = ("_rad", "energy_error_J")
# Of the velocities as a simulation holds them: half a step before the positions, or of their instant.
KINETIC = ("kinetic_half_step_J", "kinetic_on_step_J")
# More digits than any type in use has; sums of the parts are exact.
_DIGITS = 2000


def parts(columns):
    """{name: values} of the account in the order of the file, without its sum."""
    found = {}
    for name, values in columns.items():
        short = name.removesuffix("_J")
        other = name in _NOT_ENERGY or name.endswith(_NOT_ENERGY_ENDS)
        if not other and short != "sum":
            found[short] = values
    # An account has velocities of the instant of its positions, so the others' energy is no part of it.
    if "translational_on_step" in found:
        for name in KINETIC:
            found.pop(name.removesuffix("_J"), None)
    return found


def balance(columns):
    """(times, |sum - sum at the start|), or None where there is no account beside the kinetic energy."""
    account = parts(columns)
    total = columns.get("sum_J", columns.get("sum"))
    # What is infinite or NaN gives NaN, which is not drawn.
    with decimal.localcontext(decimal.Context(prec=_DIGITS, traps=[])):
        if total is None:
            if len(account) < 2:
                return None
            total = [sum(values) for values in zip(*account.values())]
        # A step's energies are of its middle: before the first step there may be no account yet.
        first = int(len(total) > 1 and not any(v[0] for v in account.values()))
        if not total:
            return None
        errors = [float(abs(value - total[first])) for value in total[first:]]
        return columns["time_s"][first:], errors

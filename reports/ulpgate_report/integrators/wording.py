"""What captions say of the orders: where the runs end, which curves hide others, which have no place on the axes."""
import math

# Curves whose errors differ by less lie within the width of a line.
_WIDTH = 1.1


def power_of_two(value):
    """A step or an end exactly: 2^-22 where it is a power of two, else its digits."""
    mantissa, exponent = math.frexp(value)
    if mantissa == 0.5 and exponent != 1:
        return f"2^{exponent - 1}"
    return f"{value:.6g}"


def listed(texts):
    """a, b and c."""
    *most, last = texts
    return f"{', '.join(most)} and {last}" if most else last


def _orders(mine, every):
    """Orders of those that there are: a range where it leaves none out."""
    mine = sorted(mine)
    between = [order for order in every if mine[0] <= order <= mine[-1]]
    if len(mine) > 2 and mine == between:
        return f"orders {mine[0]:g} to {mine[-1]:g}"
    return f"order{'s' * (len(mine) > 1)} {listed([f'{order:g}' for order in mine])}"


def ends(rows):
    """The sentence on the times that the errors are of, "" where no record tells any."""
    at = {}
    for row in rows:
        if "t_end" in row:
            at.setdefault(row["t_end"], set()).add(row["order"])
    if not at:
        return ""
    if len(at) == 1:
        return f"Every error is that at the time {power_of_two(*at)}. "
    every = sorted(set().union(*at.values()))
    told = [f"{power_of_two(end)} for {_orders(at[end], every)}" for end in sorted(at)]
    return f"The end time differs by order: {listed(told)}. "


def _coincide(one, other):
    """Whether two curves of a type lie on each other where they are clear of roundings."""
    mine, its = (c.clear or c.drawn for c in (one, other))
    return [dt for dt, _ in mine] == [dt for dt, _ in its] and all(
        max(a, b) <= _WIDTH * min(a, b) for (_, a), (_, b) in zip(mine, its)
    )


def coinciding(convergences):
    """Groups of curves of a type that lie on each other, each in the order drawn; those alone are left out."""
    groups = []
    for one in convergences:
        for group in groups:
            if _coincide(group[0], one):
                group.append(one)
                break
        else:
            groups.append([one])
    return [group for group in groups if len(group) > 1]


def _of_types(of_type, found):
    """The texts that `found` has of each type; one that is not of all types names its own."""
    tokens = {}
    for token, convergences in of_type.items():
        for text in found(convergences):
            tokens.setdefault(text, []).append(token)
    return [
        text if len(mine) == len(of_type) else f"{text} (in {listed(mine)})"
        for text, mine in tokens.items()
    ]


def hidden(of_type):
    """The sentence on curves that lie under others."""
    told = _of_types(
        of_type,
        lambda convergences: [
            f"{listed([c.integrator for c in under])} under {top.integrator}"
            for *under, top in coinciding([c for c in convergences if c.drawn])
        ],
    )
    if not told:
        return ""
    return f"Where curves coincide, the last one hides the others, whose markers are larger and open: {listed(told)}. "


def zeros(of_type):
    """The sentence on errors of exactly 0, which a logarithmic axis has no place for."""
    every = [c for convergences in of_type.values() for c in convergences]
    if all(len(c.drawn) == len(c.points) for c in every):
        return ""
    told = _of_types(
        of_type,
        lambda convergences: [
            c.integrator for c in convergences if c.points and not c.drawn
        ],
    )
    alone = f"; of {listed(told)} every error is 0" if told else ""
    return f"Errors of exactly 0 are not drawn, as the axis is logarithmic{alone}. "

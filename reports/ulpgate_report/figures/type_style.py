"""The colour and the marker of a type where no context gives them."""
from ulpgate_report.figures import figure_style
from ulpgate_report.values import type_order


def _place(token, tokens):
    known = type_order.KNOWN
    others = [t for t in tokens if t not in known]
    return known.index(token) if token in known else len(known) + others.index(token)


def line_style(token, tokens):
    """(colour, marker) of a type; a known one has the same in every figure."""
    place = _place(token, tokens)
    return figure_style.colour(place), figure_style.marker(place)

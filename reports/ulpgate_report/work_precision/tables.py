"""The tables of error against run time as plain data."""
from ulpgate_report.tables.table import Column, Table, columns_of
from ulpgate_report.values import numbers
from ulpgate_report.work_precision import (
    axes,
    figure_subjects,
    reproducer,
    settings,
)

_SUBJECT = columns_of("text", subject="of")
_NAME_TYPE = columns_of("code", name="name", type="type")
_ABOUT = (*_SUBJECT, *_NAME_TYPE, *columns_of("code", integrator="integrator"))
_END = columns_of("text", end="end")
_STEP = columns_of("real", dt="step")
_TOLERANCE = columns_of("real", tolerance="tolerance")
_COUNTS = columns_of("count", steps="steps", evaluations="evaluations")
_ERRORS = columns_of(
    "real",
    final_error="final error",
    largest_error="largest error",
    energy_error="energy error",
    t_s="t_s (s)",
)
_ENERGY = "Energy stands for what a problem conserves: of a reaction its mass."
_SECONDS = columns_of("rough", seconds="time (s)")
_COMMAND = columns_of("command", command="command")


def _values(row, told):
    """The fields of a setting, numbers as such; of planned steps the tolerance, and its command."""
    made = {
        "integrator": lambda one: settings.method(one) or None,
        "tolerance": settings.tolerance,
        "command": reproducer.command,
    }
    found = []
    for column in told:
        make = made.get(column.name)
        value = make(row) if make else row.get(column.name)
        found.append(
            numbers.signed(value) if column.kind in ("real", "rough") else value
        )
    return tuple(found)


def front_rows(measured):
    """[(setting, whether it is on the front of all types too)] of problems and scenes: the best of each type."""
    found = []
    kinds = [kind for kind in settings.KINDS if kind not in settings.OF_SUBJECTS]
    for subject in measured.subjects(kinds):
        rows = measured.of_kind(*subject)
        for pair, _, _ in settings.drawn_pairs(measured, rows)[:1]:
            best = {id(row) for row in settings.front(rows, pair)}
            for token in measured.type_tokens:
                mine = [row for row in rows if row["type"] == token]
                front = settings.front(mine, pair)
                found += [(row, id(row) in best) for row in reversed(front)]
    return found


def work_precision_front(measured):
    """Of each problem or scene and type the settings that no other betters in error and time."""
    told = (*_ABOUT, *_STEP, *_COUNTS, *_ERRORS, *_SECONDS)
    rows = [
        (*_values(row, told), "yes" if is_best else "no", *_values(row, _COMMAND))
        for row, is_best in front_rows(measured)
    ]
    told += (*columns_of("text", best="of all types"), *_COMMAND)
    caption = (
        "What an error costs: of each problem or scene and type the settings that no other of this type betters in error "
        "and time (Pareto front), the cheapest first, and whether they are on the front of all types too; an error of 1 and more "
        f"is on none, and a gain of less than {settings.GAIN:.0%} is none. Steps are in the problem's unit of time; of planned ones "
        "it is their mean. " + _ENERGY
    )
    return Table("work_precision_front", caption, told, tuple(rows))


def least_errors(measured):
    """{(subject, name): {type: (place in the table of fronts, setting)}}: the last of each front has the least error."""
    found = {}
    for place, (row, _) in enumerate(front_rows(measured)):
        of_type = found.setdefault((row["subject"], row["name"]), {})
        of_type[row["type"]] = (place, row)
    return found


def work_precision_matrix(measured):
    """The least error of each problem or scene in each type, for the page."""
    tokens = measured.type_tokens
    rows = []
    for (_, name), of_type in least_errors(measured).items():
        best = (of_type[t][1] if t in of_type else None for t in tokens)
        rows.append((name, *(row and axes.value(row, "error") for row in best)))
    told = columns_of("code", name="name") + tuple(
        Column(token, token, "real") for token in tokens
    )
    caption = "The least error that was reached in each type. A cell leads to its setting and the command that measures it again."
    return Table("work_precision_matrix", caption, told, tuple(rows))


def _worst(rows):
    """(largest error, its setting) of some settings that did not fail; (None, None) of none."""
    found = [(axes.value(row, "error"), row) for row in rows]
    found = [one for one in found if one[0] is not None]
    return max(found, key=lambda one: one[0], default=(None, None))


def work_precision_types(measured):
    """What functions and kernels cost in each type, and how exact they are."""
    rows = []
    for kind in settings.OF_SUBJECTS:
        all_rows = measured.of_kind(kind)
        middle = figure_subjects.medians(all_rows, axes.DEFAULT)
        double = middle.get("double", (None, None))[1]
        for token in measured.type_tokens:
            mine = [row for row in all_rows if row["type"] == token]
            if not mine:
                continue
            failed = sum(map(settings.has_failed, mine))
            largest, worst = _worst(mine)
            error, seconds = middle.get(token, (None, None))
            ratio = seconds / double if seconds and double else None
            of_worst = (worst and worst["name"], worst and reproducer.command(worst))
            middles = (error, largest, seconds, ratio)
            rows.append((kind, token, len(mine), failed, *middles, *of_worst))
    told = _SUBJECT + columns_of("code", type="type")
    told += columns_of("count", count="measured", failed="failed")
    told += columns_of(
        "real",
        median_error="median error",
        largest_error="largest error",
        median_seconds="median time (s)",
        slowdown="against double",
    )
    told += columns_of("code", worst="largest error of") + _COMMAND
    caption = (
        "Functions and kernels by type: the median and the largest of their errors, the median of their times, and that "
        "against double; which has the largest error, and the command that measures it again."
    )
    return Table("work_precision_types", caption, told, tuple(rows))


_FITTED = columns_of(
    "real",
    constant="C",
    order="p",
    walk="B",
    drift="D",
    residual="residual",
    best_dt="best step",
    best_error="its error",
    crossing_dt="crossing",
)


def _holds(fit):
    """Whether the law holds; None where none was fitted."""
    if fit["residual"] is None:
        return None
    return "no" if fit.get("bad") else "yes"


def work_precision_fits(measured):
    """The law of the errors of each integrator and type, and the best step that follows."""
    about = _SUBJECT + columns_of(
        "code", name="name", integrator="integrator", type="type"
    )
    rows = [
        (
            *_values(fit, about),
            fit["error"].removesuffix("_error"),
            *_values(fit, _FITTED),
            _holds(fit),
        )
        for fit in measured.fits
    ]
    told = (*about, *columns_of("text", error="error"), *_FITTED)
    told += columns_of("text", holds="holds")
    caption = (
        "Errors fitted as max(C dt^p, B sqrt(n) u, D n u) over n steps with unit roundoff u: time-stepping, unbiased and "
        "biased rounding. Residual: in decades, root mean square; where the law does not hold, the error is of another "
        "form; -: no law was fitted, since too few settings have an error below 1. The best step, in the problem's unit of time, is that of the "
        "least error; crossing: where rounding takes over. " + _ENERGY
    )
    return Table("work_precision_fits", caption, told, tuple(rows))


def work_precision_records(measured):
    """Every setting, failed ones with the reason."""
    told = (*_ABOUT, *_END, *_TOLERANCE, *_STEP, *_COUNTS, *_ERRORS)
    told += columns_of("count", instants="instants")
    told += columns_of(
        "real", correct_digits="correct digits", reference_error="error of the truth"
    )
    told += _SECONDS + columns_of("real", median_s="median (s)", spread_s="spread (s)")
    told += columns_of("real", noise_floor="noise floor")
    told += columns_of("count", repeats="repeats")
    told += columns_of("text", regime="limited by", failure="failure")
    told += columns_of("prose", why="why") + _COMMAND
    rows = [_values(row, told) for row in measured.rows]
    caption = (
        "Every setting: errors against the truth, at the end and the largest of all instants that are compared, largest error "
        "of the energy, time until which a type stays true (t_s), the smallest, the median and the spread of its times, "
        "their noise floor as a share, and what limits the error."
    )
    return Table("work_precision_records", caption, told, tuple(rows))

"""The tables of error against run time as plain data."""
from ulpgate_report.tables.table import Column, Table
from ulpgate_report.values import numbers
from ulpgate_report.work_precision import axes, figure_subjects, settings

_SUBJECT = Column("subject", "of", "text")
_NAME = Column("name", "name", "code")
_TYPE = Column("type", "type", "code")
_INTEGRATOR = Column("integrator", "integrator", "code")
_DT = Column("dt", "step", "real")
_END = Column("end", "end", "text")
_STEPS = Column("steps", "steps", "count")
_EVALUATIONS = Column("evaluations", "evaluations", "count")
_ERRORS = (
    Column("final_error", "final error", "real"),
    Column("largest_error", "largest error", "real"),
    Column("energy_error", "energy error", "real"),
    Column("t_s", "t_s (s)", "real"),
)
_SECONDS = (
    Column("seconds", "time (s)", "real"),
    Column("median_s", "median (s)", "real"),
    Column("spread_s", "spread (s)", "real"),
)


def _numbers(row, columns):
    return tuple(numbers.signed(row.get(column.name)) for column in columns)


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
    columns = (_SUBJECT, _NAME, _TYPE, _INTEGRATOR, _DT, _STEPS, _EVALUATIONS)
    columns += (*_ERRORS, _SECONDS[0], Column("best", "of all types", "text"))
    rows = [
        (
            *(row.get(c.name) for c in columns[:7]),
            *_numbers(row, (*_ERRORS, _SECONDS[0])),
            "yes" if is_best else "no",
        )
        for row, is_best in front_rows(measured)
    ]
    caption = (
        "What an error costs: of each problem or scene and type the settings that no other of this type betters in error "
        "and time (Pareto front), the cheapest first, and whether they are on the front of all types too."
    )
    return Table("work_precision_front", caption, columns, tuple(rows))


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
            errors = [axes.value(row, "error") for row in mine]
            largest = max((e for e in errors if e is not None), default=None)
            error, seconds = middle.get(token, (None, None))
            ratio = seconds / double if seconds and double else None
            rows.append(
                (
                    kind,
                    token,
                    len(mine),
                    sum(settings.has_failed(row) for row in mine),
                    error,
                    largest,
                    seconds,
                    ratio,
                )
            )
    columns = (
        _SUBJECT,
        _TYPE,
        Column("count", "measured", "count"),
        Column("failed", "failed", "count"),
        Column("median_error", "median error", "real"),
        Column("largest_error", "largest error", "real"),
        Column("median_seconds", "median time (s)", "real"),
        Column("slowdown", "against double", "real"),
    )
    caption = (
        "Functions and kernels by type: the median and the largest of their errors, the median of their times, and that "
        "against double."
    )
    return Table("work_precision_types", caption, columns, tuple(rows))


_FITTED = (
    Column("constant", "C", "real"),
    Column("order", "p", "real"),
    Column("walk", "B", "real"),
    Column("drift", "D", "real"),
    Column("residual", "residual", "real"),
    Column("best_dt", "best step", "real"),
    Column("best_error", "its error", "real"),
    Column("crossing_dt", "crossing", "real"),
)


def work_precision_fits(measured):
    """The law of the errors of each integrator and type, and the best step that follows."""
    told = (_SUBJECT, _NAME, _INTEGRATOR, _TYPE, Column("error", "error", "text"))
    columns = (*told, *_FITTED, Column("bad", "holds", "text"))
    rows = [
        (
            *(fit.get(c.name) for c in told[:4]),
            fit["error"].removesuffix("_error"),
            *_numbers(fit, _FITTED),
            "no" if fit.get("bad") else "yes",
        )
        for fit in measured.fits
    ]
    caption = (
        "Errors fitted as max(C dt^p, B sqrt(n) u, D n u) over n steps with unit roundoff u: time-stepping, unbiased and "
        "biased rounding. Residual: in decades, root mean square; where the law does not hold, the error is of another "
        "form. The best step is that of the least error; crossing: where rounding takes over."
    )
    return Table("work_precision_fits", caption, columns, tuple(rows))


def work_precision_records(measured):
    """Every setting, failed ones with the reason."""
    columns = (_SUBJECT, _NAME, _TYPE, _INTEGRATOR, _END, _DT, _STEPS, _EVALUATIONS)
    measures = (
        *_ERRORS,
        Column("correct_digits", "correct digits", "real"),
        Column("reference_error", "error of the truth", "real"),
        *_SECONDS,
        Column("noise_floor", "noise floor", "real"),
    )
    rows = [
        (
            *(row.get(c.name) for c in columns),
            *_numbers(row, measures),
            row.get("repeats"),
            row.get("regime"),
            row.get("failure") or None,
            row.get("why") or None,
        )
        for row in measured.rows
    ]
    columns += (*measures, Column("repeats", "repeats", "count"))
    columns += (
        Column("regime", "limited by", "text"),
        Column("failure", "failure", "text"),
        Column("why", "why", "prose"),
    )
    caption = (
        "Every setting: errors against the truth, largest error of the energy, time until which a type stays true (t_s), "
        "the smallest, the median and the spread of its times, their noise floor as a share, and what limits the error."
    )
    return Table("work_precision_records", caption, columns, tuple(rows))

"""The tables of the pendulum as plain data: how long each type stays true, and how well it keeps the energy."""
from ulpgate_report.pendulum import published
from ulpgate_report.records.pendulum_records import HALF_STEP, OWN_REFERENCE
from ulpgate_report.tables.table import Column, Table, columns_of
from ulpgate_report.values import numbers, time_step, type_order

_SCENE = Column("scene", "scene", "code")
_VARIANT = Column("variant", "variant", "text")
_TYPE = Column("type", "type", "code")
_DT = Column("dt_s", "dt (s)", "text")
_LETTERS = {
    "rounding": "r",
    "time-stepping": "t",
    "the reference": "d",
    "the end of the run": "e",
    "not told": "",
}
_AGAINST = {OWN_REFERENCE: "its own RealHP<4>", HALF_STEP: "half its step"}


def _is_check(row):
    return row["against"] in _AGAINST


def _sorted(rows):
    """By scene and variant, then the types in display order, the checks of a reference last, then by step."""
    types = type_order.ordered(row["type"] for row in rows)
    steps = time_step.ordered(row["dt"] for row in rows)
    return sorted(
        rows,
        key=lambda row: (
            row["scene"],
            row.get("variant", ""),
            _is_check(row) if "against" in row else False,
            types.index(row["type"]),
            row.get("against", ""),
            steps.index(str(row["dt"])),
        ),
    )


def duration_text(row):
    """A duration with the letter of what limits it; `>=` before a lower bound, which only the end of the run limits."""
    if row["to_the_end"]:
        return f">= {row['t_s']:.2f} e"
    return f"{row['t_s']:.2f} {_LETTERS[row['limited_by']]}".rstrip()


def pendulum_divergence(pendulum):
    """How long each type stays true to the reference at each step, the published durations beside."""
    rows = _sorted(pendulum.correlations)
    steps = time_step.ordered(row["dt"] for row in rows)
    lines = {}
    for row in rows:
        key = (row["scene"], row.get("variant", ""), row["type"], row["against"])
        lines.setdefault(key, {})[str(row["dt"])] = row
    made, with_published = [], False
    for (scene, variant, token, against), of_step in lines.items():
        paper = None
        for row in of_step.values():
            found = published.pendulum_t_s(scene, row["dt"], variant, token)
            paper = paper if _is_check(row) or found is None else found
        with_published = with_published or paper is not None
        made.append(
            (
                scene,
                variant or None,
                token,
                _AGAINST.get(against, against),
                *(
                    duration_text(of_step[dt]) if dt in of_step else None
                    for dt in steps
                ),
                paper,
            )
        )
    columns = (
        _SCENE,
        _VARIANT,
        _TYPE,
        Column("against", "against", "text"),
        *(Column(f"t_s_dt_{dt}", f"dt = {dt} s", "text") for dt in steps),
        Column("published_t_s", "published (s)", "real"),
    )
    caption = (
        "How long the angles of the pendulum correlate with the reference run: t_s in s, the start of the first chunk "
        "whose correlation is below the limit, for each time step; >= where no chunk is. Limited by r: rounding, t: "
        "time-stepping (the reference parts from itself at half the step no later), d: the digits of the reference (it parts "
        "from its own RealHP<4> no later), e: the end of the run. The rows against RealHP<4> and half the step judge the "
        "reference itself."
    )
    variants = dict.fromkeys(
        one for row in rows for one in published.overrides(row.get("variant", ""))
    )
    told = [
        f"{v}: {published.MEANINGS[v]}" for v in variants if v in published.MEANINGS
    ]
    caption += "".join(f" {text}." for text in told)
    if with_published:
        caption += f" Published: {published.CITATION}; it prints the end of that chunk, 0.05 s later than its start."
    else:
        made = [line[:-1] for line in made]
        columns = columns[:-1]
    return Table("pendulum_divergence", caption, columns, tuple(made))


def pendulum_correlations(pendulum):
    """Every line of correlation.jsonl, with numbers alone in the columns of numbers."""
    rows = [
        (
            row["scene"],
            row.get("variant") or None,
            row["type"],
            _AGAINST.get(row["against"], row["against"]),
            str(row["dt"]),
            row["t_s"],
            "yes" if row["to_the_end"] else "no",
            row["limited_by"],
            None
            if _is_check(row)
            else published.pendulum_t_s(
                row["scene"], row["dt"], row.get("variant", ""), row["type"]
            ),
            row["plan"],
        )
        for row in _sorted(pendulum.correlations)
    ]
    columns = (
        _SCENE,
        _VARIANT,
        _TYPE,
        Column("against", "against", "text"),
        _DT,
        Column("t_s", "t_s (s)", "real"),
        *columns_of("text", lower_bound="lower bound", limited_by="limited by"),
        Column("published_t_s", "published (s)", "real"),
        Column("plan", "plan", "code"),
    )
    caption = f"Every duration of correlation. Published: {published.CITATION}."
    return Table("pendulum_correlations", caption, columns, tuple(rows))


def pendulum_energy(pendulum):
    """How far the energy ever was from its start, with averaged and with raw velocities, and how the error grows."""
    names = ("max_energy_error", "max_energy_error_raw")
    slopes = ("energy_slope", "energy_slope_raw")
    kept = [r for r in pendulum.records if any(r.get(n) is not None for n in names)]
    rows = [
        (
            record["scene"],
            record.get("variant") or None,
            record["type"],
            str(record["dt"]),
            numbers.signed(record["t_end"]),
            numbers.signed(record.get("energy_start")),
            *(numbers.signed(record.get(name)) for name in (*names, *slopes)),
        )
        for record in _sorted(kept)
    ]
    columns = (
        _SCENE,
        _VARIANT,
        _TYPE,
        _DT,
        *columns_of(
            "real",
            t_end_s="end (s)",
        ),
        *columns_of(
            "rough",
            energy_start_J="energy at start (J)",
            max_energy_error_J="largest error (J)",
            max_energy_error_raw_J="raw (J)",
            energy_slope="slope",
            energy_slope_raw="slope, raw",
        ),
    )
    caption = (
        "Largest distance of the energy from its start, with the mean of the velocities of two half steps and, raw, with "
        "one of them; slope of the logarithm of the distance against that of time: about 1/2 for roundings without bias "
        "(Brouwer's law), near 1 for roundings with one (- where it cannot be fitted)."
    )
    return Table("pendulum_energy", caption, columns, tuple(rows))

"""Why a damped run of few digits comes to rest sooner: decided from the energies of the runs, for captions."""
import numpy

_ELASTIC, _DAMPING = "elastic", "damping"
# Rods are shaken where they hold so many times the elastic energy, and the damping is ahead where it is so many times
# faster; runs of chaos that differ in nothing but their roundings stay far below.
_SHAKEN, _AHEAD = 2.0, 2.0
_CAPTION = (
    " Rounding shakes the rods of %s: on average they hold %.2g times the elastic energy that they hold in %s. The damping "
    "is a share of the magnitude of every component of the acceleration, so that it takes more: %.2g J by %.2g s, in %s "
    "by %.2g s."
)


def _mean(values):
    finite = values[numpy.isfinite(values)]
    return float(finite.mean()) if len(finite) else 0.0


def _reached(series, level):
    """When the damping has taken so much, in s, None where it never does."""
    reached = series.parts[_DAMPING] >= level
    return float(series.part_times[numpy.argmax(reached)]) if reached.any() else None


def explanation(lines, reference):
    """A sentence on the type that rounding shakes most beside the type `reference`, empty where there is none."""
    of_type = {t: s for t, s in lines if _ELASTIC in s.parts and _DAMPING in s.parts}
    if reference not in of_type:
        return ""
    quiet = of_type[reference]
    calm, taken = _mean(quiet.parts[_ELASTIC]), quiet.parts[_DAMPING]
    level = float(taken[numpy.isfinite(taken)].max(initial=0.0)) / 2
    late = _reached(quiet, level)
    found = []
    for token, series in of_type.items():
        soon = _reached(series, level)
        if token == reference or not calm > 0 or not level > 0 or soon is None:
            continue
        ratio = _mean(series.parts[_ELASTIC]) / calm
        if ratio > _SHAKEN and _AHEAD * soon < late:
            said = (token, ratio, reference, level, soon, reference, late)
            found.append((ratio, _CAPTION % said))
    return max(found)[1] if found else ""

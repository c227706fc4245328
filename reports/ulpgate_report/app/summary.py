"""The combined numbers for programs: summary.json, held to its own schema."""
import json

from ulpgate_report.integrators import orders
from ulpgate_report.math import combine
from ulpgate_report.records import reading
from ulpgate_report.values import numbers
from ulpgate_report.work_precision import tables as work_precision_tables


def _cell(combined, row, token):
    cell = combined.cells[row, token]
    paper = combined.paper_cells.get((row, token))
    measured = {
        "max_ulp": cell.max_ulp,
        "mean_ulp": cell.mean_ulp,
        "p50_ulp": cell.p50_ulp,
        "p99_ulp": cell.p99_ulp,
        "max_float_distance": cell.max_float_distance,
        "paper_max_float_distance": paper and paper.max_float_distance,
        "paper_max_ulp": paper and paper.max_ulp,
        "max_ulp_over_condition": cell.max_ulp_over_condition,
    }
    return {
        "function": row.function,
        "part": row.part,
        "class": row.function_class,
        "type": token,
        "samples": cell.samples,
        "judged": cell.judged,
        "max_ulp_stratum": cell.stratum,
        "argmax": list(cell.argmax),
        "correctly_rounded": cell.correctly_rounded,
        "mismatches": cell.mismatches,
        "mismatch": cell.mismatch,
        "oracle_compared": cell.oracle_compared,
        "oracle_disagreed": cell.oracle_disagreed,
        "ns_per_eval": combined.time_ns.get((row.function, token)),
        **{key: numbers.as_record(value) for key, value in measured.items()},
    }


def _kernel_cell(row, token, cell):
    measured = {
        "max_ulp": cell.max_ulp,
        "max_normwise": cell.max_normwise,
        "condition": cell.condition,
        "max_normwise_over_condition": cell.max_normwise_over_condition,
    }
    return {
        "kernel": row.function,
        "quantity": row.part,
        "type": token,
        "samples": cell.samples,
        "max_ulp_stratum": cell.ulp_stratum,
        "max_normwise_stratum": cell.normwise_stratum,
        "verdict": cell.verdict,
        "mismatches": cell.mismatches,
        **{key: numbers.as_record(value) for key, value in measured.items()},
    }


def _all_cells(combined, make):
    return [
        make(row, token)
        for row in combined.rows
        for token in combined.type_tokens
        if (row, token) in combined.cells
    ]


def _order(one):
    return {
        "problem": one.problem,
        "integrator": one.integrator,
        "type": one.type,
        "order": one.order,
        "measured_order": one.measured,
        "smallest_error": one.smallest,
        "floor": one.floor,
    }


def _best(setting, is_best):
    """A setting of the front as its record, with its times, and whether no type betters it."""
    return {**setting, "best_of_all_types": is_best}


def build(
    context,
    combined=None,
    kernels=None,
    scenes=None,
    pendulum=None,
    stress=None,
    work_precision=None,
    collisions=None,
):
    """The summary as an object that its schema accepts; what was not run is left out."""
    found = {"tool": context["tool"], "plan": context["plan"]}
    judged = combined or kernels
    if judged:
        found["seed"] = context["seed"]
        found["complete"] = context["complete"]
        found["strata"] = list(judged.strata)
        found["types"] = list(judged.type_tokens)
    if combined:
        found["paper_strata"] = [s for s in combine.PAPER_STRATA if s in judged.strata]
        found["cells"] = _all_cells(combined, lambda *key: _cell(combined, *key))
    if kernels:
        found["kernels"] = _all_cells(
            kernels, lambda *key: _kernel_cell(*key, kernels.cells[key])
        )
    if scenes:
        found["scenes"] = list(scenes.records)
    if pendulum:
        found["correlations"] = list(pendulum.correlations)
        found["orders"] = [
            _order(c) for c in orders.convergences(pendulum.orders, pendulum.bits)
        ]
    if stress:
        found["stress"] = list(stress.rows)
    if work_precision:
        front = work_precision_tables.front_rows(work_precision)
        found["work_precision_front"] = [_best(*one) for one in front]
        found["work_precision_fits"] = list(work_precision.fits)
    if collisions:
        found["collisions"] = [
            {**run.totals, "scene": run.scene} for run in collisions.runs
        ]
    # A broken summary is a fault of this program, not of its input: let it abort.
    reading.validator("summary").validate(found)
    return found


def render(context, *parts):
    """The whole file; the parts are those of `build`."""
    found = build(context, *parts)
    return json.dumps(found, indent=1, sort_keys=True) + "\n"

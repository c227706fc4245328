"""The combined numbers for programs: summary.json, held to its own schema."""
import json

from ulpgate_report import combine, numbers, records


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


def build(combined):
    """The summary as an object that its schema accepts."""
    context = combined.context
    found = {
        "tool": context["tool"],
        "plan": context["plan"],
        "seed": context["seed"],
        "complete": context["complete"],
        "strata": list(combined.strata),
        "paper_strata": [s for s in combine.PAPER_STRATA if s in combined.strata],
        "types": list(combined.type_tokens),
        "cells": [
            _cell(combined, row, token)
            for row in combined.rows
            for token in combined.type_tokens
            if (row, token) in combined.cells
        ],
    }
    # A broken summary is a fault of this program, not of its input: let it abort.
    records.validator("summary").validate(found)
    return found


def render(combined):
    """The whole file."""
    return json.dumps(build(combined), indent=1, sort_keys=True) + "\n"

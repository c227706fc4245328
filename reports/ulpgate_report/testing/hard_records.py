"""Records of functions with infinite, unjudged and huge values, for the tests."""


def is_at(record, type_token, stratum):
    """Whether a record is of this type and stratum."""
    return record["type"] == type_token and record["stratum"] == stratum


def hard_values(record):
    """Infinite, unjudged and huge values in three columns."""
    if is_at(record, "float", "hard"):
        record["max_ulp"] = record["max_float_distance"] = "inf"
    if record["type"] == "double":
        for name in ("max_ulp", "max_float_distance", "mean_ulp", "p50_ulp", "p99_ulp"):
            record[name] = None
        record.update(judged=0, argmax=[], argmax_index=None)
        record["histogram"] = {"exact": 0, "buckets": []}
        record.update(correctly_rounded=0, mismatch_first={})
        record["mismatch"] = dict.fromkeys(record["mismatch"], 0)
        record["mismatch"]["nan"] = record["samples"]
    if is_at(record, "mpfr150", "uniform"):
        record["max_float_distance"] = 10**400

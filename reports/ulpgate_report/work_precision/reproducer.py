"""The command that measures a setting, or all of one function, kernel, problem or scene in a type, again."""
import shlex

from ulpgate_report.work_precision import settings


def command(row):
    """What measures one setting again."""
    name = row.get("case", row["name"])
    words = ["ulpgate work-precision"]
    if row["subject"] in settings.OF_SUBJECTS:
        words += ["--subjects", shlex.quote(name), "--types", row["type"]]
        return " ".join(words)
    words += ["--cases", shlex.quote(name), "--integrators", row["integrator"]]
    words += ["--types", row["type"], *_steps(row)]
    return " ".join([*words, "--until", shlex.quote(row["end"])])


def _steps(row):
    """How the steps of a setting are asked for."""
    if row["subject"] == "scene" or settings.tolerance(row) is not None:
        return ["--dt", shlex.quote(row["dt_text"])]
    return ["--steps", str(row["steps"])]

"""Tests of the files for GitHub Actions, GitLab CI and Docker: they are YAML of the shape that is read there, and do no more than call scripts that are here."""

import os
import pathlib
import re
import shutil
import subprocess

import jsonschema
import pytest

yaml = pytest.importorskip("yaml")
ROOT = pathlib.Path(__file__).resolve().parents[1]
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
GITLAB = ROOT / ".gitlab-ci.yml"
# What a step may do besides calling a script of ours: install what brings the sources, and hand on what a script wrote.
AROUND = re.compile(r"apt-get |test ! -s |test \$\? -eq 3$")

# The part of https://json.schemastore.org/github-workflow.json that these files use; a key that is misspelt is refused.
STEP = {
    "type": "object",
    "properties": {k: {} for k in ("name", "uses", "with", "run", "env", "if")},
    "additionalProperties": False,
    "oneOf": [{"required": ["uses"]}, {"required": ["run"]}],
}
JOB = {
    "type": "object",
    "required": ["runs-on", "steps", "timeout-minutes"],
    "properties": {
        "runs-on": {"type": "string"},
        "container": {"enum": ["debian:12", "debian:13"]},
        # GitHub ends a job after six hours.
        "timeout-minutes": {"type": "integer", "minimum": 1, "maximum": 360},
        "steps": {"type": "array", "items": STEP, "minItems": 1},
    },
    "additionalProperties": False,
}
WORKFLOW = {
    "type": "object",
    "required": ["name", "on", "permissions", "jobs"],
    "properties": {
        "name": {"type": "string"},
        "on": {"type": "object"},
        "permissions": {"const": {"contents": "read"}},
        "concurrency": {"type": "object"},
        "jobs": {"type": "object", "additionalProperties": JOB, "minProperties": 1},
    },
    "additionalProperties": False,
}
# Of https://gitlab.com/gitlab-org/gitlab/-/blob/master/app/assets/javascripts/editor/schema/ci.json.
GITLAB_JOB = {
    "type": "object",
    "required": ["stage", "script", "rules"],
    "properties": {
        "image": {"const": "debian:13"},
        "stage": {"enum": ["gate", "night"]},
        "timeout": {"type": "string", "pattern": r"^\d+ (minutes|hours)$"},
        "interruptible": {"type": "boolean"},
        "rules": {"type": "array", "items": {"required": ["if"]}},
        "cache": {"type": "object"},
        "script": {"type": "array", "items": {"type": "string"}, "minItems": 1},
        "allow_failure": {"type": "object", "required": ["exit_codes"]},
        "artifacts": {"type": "object", "required": ["when"]},
    },
    "additionalProperties": False,
}


def read(file):
    # YAML 1.1 reads the key `on` as true.
    facts = yaml.safe_load(file.read_text())
    return {("on" if key is True else key): value for key, value in facts.items()}


def github_commands():
    for file in WORKFLOWS:
        for job in read(file)["jobs"].values():
            for step in job["steps"]:
                if "run" in step:
                    yield file.name, step["run"]


def gitlab_jobs():
    known = ("image", "stages", "variables", "default")
    return {k: v for k, v in read(GITLAB).items() if k not in known}


def commands():
    yield from github_commands()
    for name, job in gitlab_jobs().items():
        for line in read(GITLAB)["default"]["before_script"] + job["script"]:
            yield f"{GITLAB.name}: {name}", line


def test_each_pipeline_has_a_merge_on_both_releases_a_sanitizer_a_night_and_the_fuzz_targets():
    github = {job for file in WORKFLOWS for job in read(file)["jobs"]}
    assert (
        github
        == set(gitlab_jobs())
        == {"gate", "gate_debian13", "asan", "nightly", "fuzz"}
    )


@pytest.mark.parametrize("file", [*WORKFLOWS, GITLAB], ids=lambda f: f.name)
def test_yamllint(file):
    if shutil.which("yamllint") is None:
        pytest.skip("no yamllint")
    rules = "{extends: default, rules: {document-start: disable, truthy: {check-keys: false}, line-length: {max: 120}, "
    rules += "brackets: {max-spaces-inside: 1}}}"
    done = subprocess.run(
        ["yamllint", "--strict", "-d", rules, file], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("file", WORKFLOWS, ids=lambda f: f.name)
def test_github_reads_the_workflows(file):
    jsonschema.validate(read(file), WORKFLOW)


def test_gitlab_reads_its_jobs():
    facts = read(GITLAB)
    for name, job in gitlab_jobs().items():
        jsonschema.validate(job, GITLAB_JOB)
        assert job["stage"] in facts["stages"], name


@pytest.mark.parametrize("where, command", list(commands()))
def test_a_step_calls_a_script_that_is_here(where, command):
    for part in re.split(r"\s*(?:&&|\|\|)\s*", command):
        if AROUND.match(part) or part.startswith("cat out/"):
            continue
        script = ROOT / part.split()[0]
        assert part.startswith("ci/") and os.access(script, os.X_OK), f"{where}: {part}"


@pytest.mark.parametrize("where, command", list(commands()))
def test_the_options_of_a_step_are_those_of_its_script(where, command):
    for part in re.split(r"\s*(?:&&|\|\|)\s*", command):
        if not part.startswith(("ci/gate", "ci/nightly", "ci/fuzz")):
            continue
        script = (ROOT / part.split()[0]).read_text()
        if "nightly" in part.split()[0]:
            script = "".join(
                f.read_text() for f in (ROOT / "scripts/night").glob("*.py")
            )
        for option in re.findall(r" (--[a-z-]+)", part):
            assert re.search(
                rf"{option}\b", script
            ), f"{where}: {part.split()[0]} has no {option}"


def test_the_artifacts_of_a_job_are_what_its_scripts_write():
    for name, job in gitlab_jobs().items():
        text = " ".join(job["script"])
        paths = job["artifacts"].get("paths", []) + list(
            job["artifacts"].get("reports", {}).values()
        )
        for path in paths:
            assert path in text, f"{name}: nothing writes {path}"


def test_docker_runs_the_two_commands_of_the_readme():
    lines = (ROOT / "Dockerfile").read_text().splitlines()
    assert "FROM debian:12" in lines
    assert "RUN scripts/run" in lines and 'CMD ["scripts/test"]' in lines
    for script in ("scripts/run", "scripts/test"):
        assert os.access(ROOT / script, os.X_OK)
        assert f"\n{script} " in (ROOT / "README.md").read_text()

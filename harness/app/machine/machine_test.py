"""Tests of what surrounds a run: floating-point environment, identity of the machine, instruction sets."""

import json
import os
import pathlib
import signal
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from preloaded import (
    CC,
    X86,
    interrupted,
    library,
    needs_x86,
    run,
    sin_run,
    spinning,
)  # noqa: E402, F401, E501
from program import ULPGATE  # noqa: E402

# The environment


@needs_x86
@pytest.mark.parametrize(
    "kind,words",
    [
        ("mxcsr", "MXCSR rounding upward"),
        ("flush", "MXCSR flushing"),
        ("x87", "x87 precision of 53 bits"),
    ],
)
def test_a8_a_function_that_changes_the_environment_is_named(
    tmp_path, library, kind, words
):
    code, _, err = sin_run(tmp_path / "out", "--threads", "1", preload=library(kind))
    assert code == 4, err
    assert "sin double uniform" in err and words in err and "void" in err
    assert "tan" not in err, "the successor is not to blame"
    code, out, err = run("at", "sin", "double", "1.5", preload=library(kind))
    assert code == 4 and words in err and "sin double" in err
    assert out == ""
    code, _, err = run(
        "search", "sin", "double", "--evaluations", "1000", preload=library(kind)
    )
    assert code == 4 and words in err and "sin double" in err


@needs_x86
@pytest.mark.parametrize(
    "setting",
    [
        "_mm_setcsr(_mm_getcsr() | 0x4000);",
        'unsigned short w = 0x027f; __asm__ volatile("fldcw %0" : : "m"(w));',
    ],
)
def test_a8_a_changed_environment_at_the_start_is_refused(tmp_path, setting):
    source = tmp_path / "start.c"
    source.write_text(
        "#include <xmmintrin.h>\n__attribute__((constructor)) static void start(void) {"
        + setting
        + "}\n"
    )
    subprocess.run(
        [CC, "-shared", "-fPIC", "-o", tmp_path / "start.so", source], check=True
    )
    for words in (
        ["at", "sin", "double", "1"],
        ["scene", "run", "pendulum3", "--steps", "10"],
    ):
        code, _, err = run(*words, preload=tmp_path / "start.so")
        assert code == 4 and "floating-point environment is" in err, (words, err)


# Identity


def context_of(out):
    return json.loads((out / "context.json").read_text())


FACTS = ["cpu", "loaded", "libm_variants", "instruction_sets"]


def has(*sets):
    flags = pathlib.Path("/proc/cpuinfo").read_text() if X86 else ""
    return all(s in flags for s in sets)


MASK = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA"}


@pytest.mark.skipif(not has(" avx2", " fma"), reason="a processor with AVX2 and FMA")
def test_a9_masked_instruction_sets_are_another_machine(tmp_path):
    shard = tmp_path / "0"
    assert sin_run(shard, "--shard", "0/2")[0] == 0
    here = context_of(shard)
    assert sin_run(tmp_path / "again", "--shard", "0/2")[0] == 0
    assert all(
        context_of(tmp_path / "again")[f] == here[f] for f in FACTS
    ), "the same in each run"
    code, _, err = sin_run(tmp_path / "1", "--shard", "1/2", **MASK)
    assert code in (0, 1), err
    masked = context_of(tmp_path / "1")
    assert masked["libm_variants"] != here["libm_variants"]
    assert masked["instruction_sets"] != here["instruction_sets"]
    merged = tmp_path / "merged"
    code, _, err = run("merge", shard, tmp_path / "1", "--out", merged)
    assert code == 2 and "--allow-other-machine" in err and str(tmp_path / "1") in err
    assert not merged.exists()
    code, _, err = run(
        "merge", shard, tmp_path / "1", "--out", merged, "--allow-other-machine"
    )
    assert code == 0 and "note" in err
    assert any("libm_variants" in text for text in context_of(merged)["other_machines"])


@needs_x86
def test_a9_a_resumed_run_refuses_other_code(tmp_path, library):
    out = tmp_path / "out"
    interrupted(out, library, signal.SIGTERM)
    code, _, err = sin_run(out, "--resume")
    assert code == 2 and ("libm_variants" in err or "loaded" in err)


def test_a9_the_identity_names_processor_and_libraries(tmp_path):
    assert sin_run(tmp_path)[0] == 0
    facts = context_of(tmp_path)
    for name in ("libm.so", "libmpfr.so", "libgmp.so"):
        (library,) = [v for k, v in facts["loaded"].items() if k.startswith(name)]
        assert pathlib.Path(library["path"]).is_file()
        assert len(library["build_id"]) >= 16
    if X86:
        assert (
            "family" in facts["cpu"]
            and "model" in facts["cpu"]
            and "stepping" in facts["cpu"]
        )


def test_a9_the_gate_says_that_budgets_are_of_another_machine(tmp_path):
    assert sin_run(tmp_path / "o", samples=200)[0] == 0
    gate = ["gate", tmp_path / "o", "--budgets", tmp_path / "b"]
    assert run(*gate, "--update")[0] == 0
    code, _, err = run(*gate)
    assert code == 0 and "another machine" not in err
    file = tmp_path / "b/double.toml"
    text = file.read_text()
    cpu = context_of(tmp_path / "o")["cpu"]
    assert f'"cpu" = "{cpu}"' in text
    file.write_text(text.replace(f'"cpu" = "{cpu}"', '"cpu" = "an older one"'))
    code, _, err = run(*gate)
    assert code == 0
    assert f"double: measured on another machine than the budgets: cpu '{cpu}'" in err
    assert "libm_variants" not in err
    file.write_text(text.replace('"libm_variants" = ', '"libm_variants" = 3 #'))
    code, _, err = run(*gate)
    assert code == 2 and "double.toml:" in err and "[machine] libm_variants" in err


@needs_x86
def test_a8_a_thread_of_a_step_that_changes_the_environment_voids_it(tmp_path, library):
    words = ["scene", "run", spinning(tmp_path), "--types", "double", "--threads"]
    code, _, err = run(*words, "2", preload=library("worker"))
    assert code == 4, err
    assert "spinning double step" in err and "MXCSR rounding upward" in err
    assert run(*words, "1", preload=library("worker"))[0] == 0


def test_fewer_instructions_give_the_same_records(tmp_path):
    records = []
    for instructions in ("baseline", "avx2", ""):
        out = tmp_path / (instructions or "best")
        done = subprocess.run(
            [
                ULPGATE,
                "math",
                "--functions",
                "sin,log",
                "--types",
                "float,double",
                "--samples",
                "2000",
                "--out",
                out,
            ],
            env={**os.environ, "ULPGATE_INSTRUCTIONS": instructions},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        records.append((out / "math.jsonl").read_bytes())
    assert records[0] == records[1] == records[2]


def test_unknown_instructions_are_bad_input():
    done = subprocess.run(
        [ULPGATE, "at", "sin", "double", "1"],
        env={**os.environ, "ULPGATE_INSTRUCTIONS": "sse9"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert (
        done.stderr
        == "ulpgate: ULPGATE_INSTRUCTIONS is 'sse9'; it may be baseline, avx2 or avx512\n"
    )

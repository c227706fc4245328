"""Tests of what surrounds a run: floating-point environment, identity of the machine, functions that do not come back, signals.
Libraries that misbehave are compiled here and preloaded."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
CC = shutil.which("cc") or shutil.which("gcc")
X86 = os.uname().machine == "x86_64"
needs_cc = pytest.mark.skipif(CC is None, reason="no C compiler")
needs_x86 = pytest.mark.skipif(
    not X86 or CC is None, reason="registers of x86-64, and a C compiler"
)

HEAD = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>
#include <xmmintrin.h>
static double true_sin(double x) {
  static double (*f)(double);
  if (!f) f = (double (*)(double))dlsym(RTLD_NEXT, "sin");
  return f(x);
}
"""
BODIES = {
    "mxcsr": "_mm_setcsr(_mm_getcsr() | 0x4000); return true_sin(x);",
    "flush": "_mm_setcsr(_mm_getcsr() | 0x8000); return true_sin(x);",
    "x87": 'unsigned short w = 0x027f; __asm__ volatile("fldcw %0" : : "m"(w)); return true_sin(x);',
    "hang": "if (x > 1 && x < 2) for (;;) usleep(1000); return true_sin(x);",
    "reference": "for (;;) usleep(1000);",
    "other": "return true_sin(x);",
    "worker": "*s = x, *c = 1; if (gettid() != getpid()) _mm_setcsr(_mm_getcsr() | 0x4000);",
    "endless": "*s = x, *c = 1; static int calls; if (++calls > 2000) for (;;) usleep(1000);",
}

# What turns the bodies of a scene calls the sine and the cosine at once.
SINCOS = "void sincos(double x, double *s, double *c) {"
HEADS = {
    "reference": "long double erfcl(long double x) {",
    "worker": SINCOS,
    "endless": SINCOS,
}


@pytest.fixture(scope="session")
def library(tmp_path_factory):
    folder = tmp_path_factory.mktemp("preloaded")

    def build(kind):
        made = folder / f"{kind}.so"
        if not made.exists():
            source = folder / f"{kind}.c"
            source.write_text(
                HEAD + HEADS.get(kind, "double sin(double x) {") + BODIES[kind] + "}\n"
            )
            command = [CC, "-O1", "-shared", "-fPIC", "-o", made, source, "-ldl", "-lm"]
            subprocess.run([str(c) for c in command], check=True)
        return made

    return build


def run(*words, preload=None, timeout=60, **environment):
    env = dict(os.environ) | environment
    if preload:
        env["LD_PRELOAD"] = str(preload)
    done = subprocess.run(
        [ULPGATE, *map(str, words)],
        capture_output=True,
        text=True,
        env=env,
        timeout=timeout,
    )
    return done.returncode, done.stdout, done.stderr


# hypot stands before sin and is finished when that misbehaves, tan behind it.
SIN_RUN = "math --functions hypot,sin,tan --types double --strata uniform --timing off".split()


def sin_run(out, *words, samples=4000, **how):
    return run(*SIN_RUN, "--samples", samples, "--out", out, *words, **how)


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


def spinning(tmp_path):
    """A scene of 1500 spheres that turn, which two threads share."""
    sphere = "[[sphere]]\nposition = [{}, 0, 0]\nradius = 0.3\nangular_velocity = [1, 2, 3]\n"
    text = 'name = "spinning"\n[[material]]\nname = "m"\n' + "".join(
        sphere.format(i) for i in range(1500)
    )
    file = tmp_path / "spinning.toml"
    file.write_text(text + '[run]\ndt = 1e-4\nuntil = 0.1\nrecord = ["rotation"]\n')
    return file


@needs_x86
def test_a8_a_thread_of_a_step_that_changes_the_environment_voids_it(tmp_path, library):
    words = ["scene", "run", spinning(tmp_path), "--types", "double", "--threads"]
    code, _, err = run(*words, "2", preload=library("worker"))
    assert code == 4, err
    assert "spinning double step" in err and "MXCSR rounding upward" in err
    assert run(*words, "1", preload=library("worker"))[0] == 0


# What does not end


@needs_x86
@pytest.mark.parametrize("threads", ["1", "2"])
@pytest.mark.parametrize("verb", ["run", "compare", "speed", "explain"])
def test_b5_a_scene_whose_step_never_ends_is_named(tmp_path, library, verb, threads):
    words = ["scene", verb, spinning(tmp_path), "--types", "double", "--threads"]
    code, _, err = run(*words, threads, "--timeout", "1", preload=library("endless"))
    assert code == 4, err
    assert re.search(
        "spinning double steps? .* has not come back in 1 s", err
    ), "the scene, its type, the steps"


@needs_x86
@pytest.mark.parametrize("threads", ["1", "2"])
def test_b5_a_function_that_never_returns_is_named_with_its_argument(
    tmp_path, library, threads
):
    out = tmp_path / "out"
    start = time.monotonic()
    code, _, err = sin_run(
        out, "--timeout", "1.5", "--threads", threads, preload=library("hang")
    )
    assert code == 4, err
    assert time.monotonic() - start < 30
    (line,) = [text for text in err.splitlines() if "has not come back" in text]
    assert "sin double uniform at 0x1." in line
    x = float.fromhex(line.split(" at ")[1].split()[0])
    assert 1 < x < 2
    assert (out / "units/log.txt").read_bytes().count(
        b"\n"
    ) > 2, "finished units are kept"


@needs_x86
def test_b5_at_and_search_are_watched(tmp_path, library):
    hang = library("hang")
    code, _, err = run("--timeout", "0.5", "at", "sin", "double", "1.5", preload=hang)
    assert code == 4 and "sin double at 0x1.8p+0 has not come back" in err
    code, _, err = run(
        "search", "sin", "double", "--timeout", "0.7", "--seconds", "100", preload=hang
    )
    assert (
        code == 4 and "sin double search at 0x1." in err and "has not come back" in err
    )


@needs_x86
def test_b5_kernels_and_integrators_are_watched(tmp_path, library):
    words = ["--types", "double", "--timeout", "1", "--out"]
    endless = library("endless")
    rotation = ["kernels", "--kernels", "rotation", "--strata", "uniform", "--samples"]
    code, _, err = run(*rotation, "4000", *words, tmp_path / "k", preload=endless)
    assert code == 4 and "rotation double uniform at " in err, err
    assert "has not come back in 1 s" in err
    pendulum = ["integrators", "--problems", "pendulum", *words, tmp_path / "i"]
    code, _, err = run(*pendulum, preload=library("hang"))
    assert code == 4 and "pendulum double has not come back in 1 s" in err, err


@needs_x86
def test_b5_a_hang_in_the_scan_of_narrow_is_named_with_its_argument(tmp_path, library):
    words = ["math", "--functions", "sin", "--types", "double", "--strata", "narrow"]
    words += ["--samples", "64", "--timing", "off", "--timeout", "1.5"]
    code, _, err = run(*words, "--out", str(tmp_path / "out"), preload=library("hang"))
    assert code == 4, err
    (line,) = [text for text in err.splitlines() if "has not come back" in text]
    assert 1 < float.fromhex(line.split(" at ")[1].split()[0]) < 2


def test_b5_a_function_that_takes_a_minute_is_named():
    words = ["at", "cpow", "mpfr150", "1e300000", "1", "1", "1e300000"]
    code, _, err = run("--timeout", "0.5", *words)
    assert code == 4 and "cpow mpfr150 at 0x1.58" in err and "has not come back" in err


@needs_x86
def test_b5_a_reference_that_never_returns_is_named_as_such(tmp_path, library):
    # Double's erfc is one that the long double of libm judges.
    words = "math --functions erfc --types double --strata uniform --timing off".split()
    words += ["--samples", "4000", "--out", tmp_path, "--timeout", "1.5"]
    code, _, err = run(*words, preload=library("reference"))
    assert code == 4 and "the reference of erfc double uniform at" in err


@pytest.mark.parametrize(
    "words",
    [
        ["search", "sin", "double", "--seconds", "nan"],
        ["search", "sin", "double", "--seconds", "inf"],
        ["scene", "run", "pendulum3", "--checkpoint-seconds", "nan"],
        ["math", "--timeout", "nan", "--out", "x"],
        ["math", "--timeout", "-1", "--out", "x"],
        ["--timeout", "0", "at", "sin", "double", "1"],
    ],
)
def test_b5_times_that_are_none_are_refused(words):
    code, _, err = run(*words)
    option = next(w for w in words if w.startswith("--"))
    assert code == 2 and option in err


def interrupted(out, library, *signals):
    """A run that hangs in its second half, ended by signals; returns the code and the seconds that it lived on."""
    env = dict(os.environ) | {"LD_PRELOAD": str(library("hang"))}
    words = [*SIN_RUN, "--samples", "4000", "--threads", "1", "--out", str(out)]
    process = subprocess.Popen(
        [ULPGATE, *words], env=env, stderr=subprocess.PIPE, text=True
    )
    log = out / "units/log.txt"
    for _ in range(600):
        if log.exists() and log.read_bytes().count(b"\n") > 2:
            break
        time.sleep(0.05)
    time.sleep(0.5)
    for s in signals:
        process.send_signal(s)
        time.sleep(0.8)
    if len(signals) < 2:
        process.kill()
    err = process.communicate(timeout=20)[1]
    return process.returncode, err


@needs_x86
@pytest.mark.parametrize(
    "first,second",
    [
        (signal.SIGINT, signal.SIGINT),
        (signal.SIGTERM, signal.SIGTERM),
        (signal.SIGHUP, signal.SIGTERM),
    ],
)
def test_b5_a_second_signal_ends_at_once_and_keeps_what_is_finished(
    tmp_path, library, first, second
):
    code, err = interrupted(tmp_path / "out", library, first, second)
    assert code == 3 and "ended at once" in err
    assert (tmp_path / "out/units/log.txt").read_bytes().count(b"\n") > 2


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

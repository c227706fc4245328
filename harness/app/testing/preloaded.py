"""Programs that are run with a misbehaving function preloaded, which is compiled here: what tests of the machine share."""

import os
import shutil
import signal
import subprocess
import time

import program
import pytest

CC = shutil.which("cc") or shutil.which("gcc")
X86 = os.uname().machine == "x86_64"
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
    return program.run(*words, timeout=timeout, env=env)


# hypot stands before sin and is finished when that misbehaves, tan behind it.
SIN_RUN = "math --functions hypot,sin,tan --types double --strata uniform --timing off".split()


def sin_run(out, *words, samples=4000, **how):
    return run(*SIN_RUN, "--samples", samples, "--out", out, *words, **how)


def spinning(tmp_path):
    """A scene of 1500 spheres that turn, which two threads share."""
    sphere = "[[sphere]]\nposition = [{}, 0, 0]\nradius = 0.3\nangular_velocity = [1, 2, 3]\n"
    text = 'name = "spinning"\n[[material]]\nname = "m"\n' + "".join(
        sphere.format(i) for i in range(1500)
    )
    file = tmp_path / "spinning.toml"
    file.write_text(text + '[run]\ndt = 1e-4\nuntil = 0.1\nrecord = ["rotation"]\n')
    return file


def interrupted(out, library, *signals):
    """A run that hangs in its second half, ended by signals; returns its exit code and what it said on stderr."""
    env = dict(os.environ) | {"LD_PRELOAD": str(library("hang"))}
    words = [*SIN_RUN, "--samples", "4000", "--threads", "1", "--out", str(out)]

    def hears():
        # What ignores a signal, as all below nohup do SIGHUP, leaves that to its children.
        for s in signals:
            signal.signal(s, signal.SIG_DFL)

    process = subprocess.Popen(
        program.command(*words),
        env=env,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=hears,
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

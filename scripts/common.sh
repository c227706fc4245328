# Shared by the scripts: where the project is, how to say what failed, which Python to use.
# shellcheck shell=bash
set -euo pipefail
ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
JOBS="${ULPGATE_JOBS:-$(nproc)}"

step() { printf '\n== %s\n' "$*" >&2; }
fail() {
  printf '%s: FAILED: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Debian's python3 has the packages that setup installs; another python3 may come first on PATH.
DEBIAN_PYTHON="${ULPGATE_DEBIAN_PYTHON:-/usr/bin/python3}" # the variable is for tests
find_python() {
  local python
  for python in "${ULPGATE_PYTHON:-python3}" "$DEBIAN_PYTHON"; do
    if "$python" -c 'import matplotlib, numpy, jinja2, jsonschema, mpmath, pytest' 2>/dev/null; then
      printf '%s\n' "$python"
      return
    fi
  done
  fail "no python3 with matplotlib, numpy, jinja2, jsonschema, mpmath and pytest; run scripts/setup"
}

# Says it where a failure in DIR is that of a full disk.
if_full() { # DIR
  local free
  free="$(df -Pk "$1" | awk 'NR == 2 { print $4 }')"
  [ "${free:-65537}" -gt 65536 ] || printf ' (%s has %s KiB left: make room, then run this again)' "$1" "$free"
}

# build PRESET [cmake option...]; of TARGETS alone where the variable says so.
build() {
  local preset="$1" targets=()
  shift
  [ -z "${TARGETS:-}" ] || read -ra targets <<<"--target $TARGETS"
  step "build ($preset)"
  cmake -S "$ROOT" --preset "$preset" "$@" >"$ROOT/build/$preset.configure.log" 2>&1 ||
    { cat "$ROOT/build/$preset.configure.log" >&2; fail "cmake --preset $preset$(if_full "$ROOT/build")"; }
  cmake --build "$ROOT/build/$preset" --parallel "$JOBS" "${targets[@]}" || fail "the $preset build$(if_full "$ROOT/build")"
}

# build_with_tests PRESET: a build as the tests and the pipelines want it.
build_with_tests() {
  # The sanitised build has native types and one with memory of its own: the code of the others is theirs, and
  # compiling it under a sanitizer takes minutes a type.
  case "$1" in
    asan) build asan -DULPGATE_BUILD_TESTS=ON "-DULPGATE_TYPES=float;double;mpfr62" ;;
    *) build "$1" -DULPGATE_BUILD_TESTS=ON ;;
  esac
}

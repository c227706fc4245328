# What this machine has: sourced by scripts/setup.  Each has_... is true or false and may print anything.
# shellcheck shell=bash

os_release() { # KEY
  # shellcheck disable=SC1090
  (. "${ULPGATE_OS_RELEASE:-/etc/os-release}" 2>/dev/null && printf '%s\n' "${!1:-}") || true
}
system_name() {
  local name
  name="$(os_release PRETTY_NAME)"
  printf '%s\n' "${name:-an unknown system}"
}

# 12 or 13 where packages can be installed by their names in that release of Debian, else nothing.
debian_release() {
  local version
  version="$(os_release VERSION_ID)"
  command -v apt-get >/dev/null || return 0
  [ "$(os_release ID)" = debian ] || return 0
  case "$version" in 12 | 13) printf '%s\n' "$version" ;; esac
}

# Boosts exclude each other in Debian, so one that is installed and new enough is the one; else the newest of the release.
boost_package() { # RELEASE
  local package status
  while read -r package status; do
    [[ $package =~ ^libboost1\.([0-9]+)-dev$ && $status = installed && ${BASH_REMATCH[1]} -ge 81 ]] || continue
    printf '%s\n' "$package"
    return
  done < <(dpkg-query -W -f '${Package} ${db:Status-Status}\n' 'libboost1.*-dev' 2>/dev/null)
  case "$1" in
    12) printf 'libboost1.81-dev\n' ;;
    13) printf 'libboost1.88-dev\n' ;;
    *) printf 'libboost-dev\n' ;;
  esac
}

# has_program NAME [VERSION]
has_program() {
  command -v "$1" || return 1
  [ $# -eq 1 ] && return
  local version
  version="$("$1" --version | grep -oE '[0-9]+(\.[0-9]+)+' | head -n 1)"
  [ "$(printf '%s\n%s\n' "$2" "$version" | sort -V | head -n 1)" = "$2" ]
}
compiles() { # C++ on standard input; further words are the compiler's
  "${CXX:-c++}" -std=gnu++20 -x c++ "$@" -
}
has_compiler() {
  compiles -fsyntax-only <<<$'#include <ranges>\n#include <span>\n#include <mutex>\nstatic_assert(__cpp_lib_ranges > 0);'
}
clang_links() { # SOURCE FLAG...
  local program code=0 source="$1"
  shift
  program="$(mktemp)"
  clang++ "$@" -x c++ - -o "$program" <<<"$source" || code=1
  rm -f "$program"
  return "$code"
}
has_fuzzer() {
  clang_links 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' -fsanitize=fuzzer,address
}
has_sanitizers() { clang_links 'int main() {}' -fsanitize=address,undefined; }
has_clang_openmp() { clang_links $'#include <omp.h>\nint main() { return omp_get_max_threads() < 1; }' -fopenmp; }
has_header() { compiles -fsyntax-only <<<"#include <$1>"; }
has_library() { # NAME HEADER
  local program code=0
  program="$(mktemp)"
  "${CXX:-c++}" -std=gnu++20 -x c++ - -o "$program" "-l$1" <<<"#include <cstdio>
#include <$2>
int main() {}" || code=1
  rm -f "$program"
  return "$code"
}
has_boost() {
  compiles -fsyntax-only <<<$'#include <boost/multiprecision/mpfr.hpp>\n#include <boost/version.hpp>\nstatic_assert(BOOST_VERSION >= 108100);'
}
has_python_itself() { has_python 'sys; assert sys.version_info >= (3, 11)'; }
# One Python must have all: two that have a half each are none.  Packages of Debian serve Debian's alone.
has_python() { # MODULE
  (find_python) && return
  local python="${ULPGATE_PYTHON:-python3}"
  [ -z "$(debian_release)" ] || python="$DEBIAN_PYTHON"
  "$python" -c "import $1"
}
has_tex() { [ -n "$(kpsewhich "$1")" ]; }

# Installs Debian's packages with a line of progress, and says how to go on where that fails: sourced by scripts/setup.
# shellcheck shell=bash

# Reads apt's status lines; on a terminal one line that changes, else a line every ten percent.
show_progress() {
  local kind percent text tens shown=-1 terminal=0
  [ -t 2 ] && terminal=1
  while IFS=: read -r kind _ percent text; do
    case "$kind" in
      dlstatus) kind="fetch" ;;
      pmstatus) kind="install" ;;
      *) continue ;;
    esac
    percent="${percent%%.*}"
    tens="$kind $((percent / 10))"
    if [ "$terminal" = 1 ]; then
      printf '\r\033[K   %-7s %3d %%  %.70s' "$kind" "$percent" "$text" >&2
    elif [ "$tens" != "$shown" ]; then
      printf '   %-7s %3d %%\n' "$kind" "$percent" >&2
      shown="$tens"
    fi
  done
  if [ "$terminal" = 1 ]; then printf '\r\033[K' >&2; fi
}

# What to do about a failure of apt-get, by its own words in LOG.
advice() { # LOG COMMAND
  if grep -qiE 'no space left|enough free space' "$1"; then
    printf 'the disk is full: make room (apt-get clean empties the cache of packages; df -h tells), then run this again'
  elif grep -qE 'could not get lock|Could not get lock|Unable to acquire' "$1"; then
    printf 'another program is installing packages: run this again when it is done'
  elif grep -q 'dpkg was interrupted' "$1"; then
    printf 'an earlier installation was cut off: as root, dpkg --configure -a, then run this again'
  elif grep -qE 'remove is disabled' "$1"; then
    printf 'other packages would have to go (a Boost below 1.81 and what needs it, as a rule); if they may, as root: %s' "$2"
  elif grep -qE 'fix-broken|Unmet dependencies' "$1"; then
    printf 'packages on this machine do not fit together: as root, apt-get --fix-broken install, then run this again'
  elif grep -qE 'Temporary failure|Could not (resolve|connect)|Failed to fetch|Connection (failed|timed out)|Unable to fetch' "$1"; then
    printf 'the mirrors of packages cannot be reached: see to the network or to the proxy of apt, or run this where there is one: %s' "$2"
  elif grep -q 'Unable to locate package' "$1"; then
    printf 'the sources of apt lack a package (are they those of this release, and was the list fetched?)'
  else
    printf 'apt-get failed: its words are above'
  fi
}

# apt_install PACKAGE...
apt_install() {
  local command="apt-get update && apt-get install --no-install-recommends $*" log as_root=()
  step "install $# packages (a few minutes): $*"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "not root, and there is no sudo; as root: $command"
    sudo -n true 2>/dev/null || [ -t 0 ] ||
      fail "not root, and sudo would ask for a password, but there is no terminal; as root: $command"
    as_root=(sudo)
  fi
  log="$(mktemp "${TMPDIR:-/tmp}/ulpgate_setup.XXXXXX")" || fail "cannot write to ${TMPDIR:-/tmp}; is the disk full?"
  # Lists that cannot be fetched may still be good enough; if not, installing says so.
  "${as_root[@]}" env LC_ALL=C.UTF-8 apt-get update -q >"$log" 2>&1 || printf '   the lists of packages could not all be fetched\n' >&2
  # Nothing is removed for ulpgate's sake.  A lock that another program holds is waited for.
  # shellcheck disable=SC2016
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 sh -c 'exec apt-get install -y -q --no-install-recommends \
      --no-remove -o DPkg::Lock::Timeout=300 -o APT::Status-Fd=3 "$@" 3>&1 1>&2' sh "$@" 2>>"$log" </dev/null | show_progress; then
    grep -E '^(E|W|dpkg: error.*): ?|REMOVED' -A 1 "$log" | grep -v '^--' | tail -n 12 >&2 || tail -n 12 "$log" >&2
    fail "$(advice "$log" "$command") (all that was said: $log)"
  fi
  rm -f "$log"
}

// Crash report.
#include "harness/app/shell/crash_report.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

// Plain characters in thread-local storage: a signal handler may read nothing else.
thread_local std::array<char, 160> place{};

void append(const char* text) {
  const ssize_t ignored = ::write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(ignored);
}

void on_crash(int signal) {
  append("ulpgate: crashed with signal ");
  append(signal == SIGSEGV   ? "SIGSEGV"
         : signal == SIGFPE  ? "SIGFPE"
         : signal == SIGILL  ? "SIGILL"
         : signal == SIGABRT ? "SIGABRT"
                             : "SIGBUS");
  if (place[0] != '\0') {
    append(" in ");
    append(place.data());
    append("; reproduce with: ulpgate math --functions F --types T --strata S of that row");
  }
  append("\n");
  ::_exit(static_cast<int>(ExitCode::environment));
}

}  // namespace

void install_crash_report() {
  // Beyond a limit on file sizes a write then fails like one to a full disk, and is reported like one.
  std::signal(SIGXFSZ, SIG_IGN);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (const int s : {SIGSEGV, SIGFPE, SIGILL, SIGABRT, SIGBUS}) std::signal(s, on_crash);
#else
  static_cast<void>(on_crash);  // the sanitizer's own report says more
#endif
}

CrashPlace::CrashPlace(std::string_view function, std::string_view type, std::string_view stratum) {
  std::size_t at = 0;
  for (const auto text : {function, std::string_view(" "), type, std::string_view(" "), stratum}) {
    for (const char c : text) {
      if (at + 1 < place.size()) place[at++] = c;
    }
  }
  place[at] = '\0';
}

CrashPlace::~CrashPlace() {
  place[0] = '\0';
}

}  // namespace ulpgate::app

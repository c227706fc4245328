// Crash report.
#include "harness/app/shell/crash_report.hpp"

#include <gmp.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "harness/app/shell/failure.hpp"
#include "harness/core/watch/heartbeat.hpp"

namespace ulpgate::app {

namespace {

bool ending = false;

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
  if (*WorkPlace::name() != '\0') {
    append(" in ");
    append(WorkPlace::name());
    append("; reproduce with: ulpgate math --functions F --types T --strata S of that row");
  }
  append("\n");
  ::_exit(exit_code(Standing::environment));
}

// GMP has no other way to say it: it would abort, which blames the function at work.
[[noreturn]] void out_of_memory() {
  append("ulpgate: out of memory\n");
  ::_exit(exit_code(Standing::environment));
}
void* allocated(void* block) {
  if (block == nullptr) out_of_memory();
  return block;
}

[[noreturn]] void on_terminate() {
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    out_of_memory();
  } catch (...) {
    append("ulpgate: an exception that nobody caught\n");
  }
  std::abort();
}

// Before main Boost computes constants of its functions, some 100 MB for all types: where that is too much
// nobody else could say so.
[[gnu::constructor(101)]] void before_all() {
  std::set_terminate(on_terminate);
}

void on_exit_of_another() {
  if (ending) return;
  append("ulpgate: ended by a library that could not go on: see above\n");
  ::_exit(exit_code(Standing::environment));
}

}  // namespace

void install_crash_report() {
  std::atexit(on_exit_of_another);
  mp_set_memory_functions(
      [](std::size_t n) { return allocated(std::malloc(n)); },
      [](void* block, std::size_t, std::size_t n) { return allocated(std::realloc(block, n)); },
      [](void* block, std::size_t) { std::free(block); });
  // Beyond a limit on file sizes a write then fails like one to a full disk, and is reported like one.
  std::signal(SIGXFSZ, SIG_IGN);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (const int s : {SIGSEGV, SIGFPE, SIGILL, SIGABRT, SIGBUS}) std::signal(s, on_crash);
#else
  static_cast<void>(on_crash);  // the sanitizer's own report says more
#endif
}

void ends_by_itself() {
  ending = true;
}

}  // namespace ulpgate::app

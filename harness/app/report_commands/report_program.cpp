// Starts the programs of reports/.
#include "harness/app/report_commands/report_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

std::string find_python(const std::vector<std::string>& modules) {
  const char* chosen = std::getenv("ULPGATE_PYTHON");
  for (const auto& python :
       {std::string(chosen != nullptr ? chosen : "python3"), std::string("/usr/bin/python3")}) {
    if (run_program({python, "-c", fmt::format("import {}", fmt::join(modules, ", "))}, true) == 0)
      return python;
  }
  throw Failure(Standing::environment,
                fmt::format("no python3 with {}: install Debian's python3-{}, or name one in ULPGATE_PYTHON",
                            fmt::join(modules, ", "), fmt::join(modules, " python3-")));
}

std::filesystem::path find_report_program(std::string_view name) {
  if (const char* named = std::getenv("ULPGATE_REPORTS")) return std::filesystem::path(named) / name;
  std::error_code code;
  for (auto d = std::filesystem::read_symlink("/proc/self/exe", code); d.has_relative_path();
       d = d.parent_path()) {
    // Of the source tree, or where they are installed.
    for (const char* folder : {"reports", "share/ulpgate/reports"})
      if (auto program = d.parent_path() / folder / name; std::filesystem::exists(program)) return program;
  }
  throw Failure(
      Standing::environment,
      fmt::format("reports/{} is not found above the program; name its folder in ULPGATE_REPORTS", name));
}

int run_program(const std::vector<std::string>& words, bool silent) {
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (const auto& w : words) argv.push_back(const_cast<char*>(w.c_str()));
  argv.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0)
    throw Failure(Standing::environment, fmt::format("cannot start {}: {}", words[0], std::strerror(errno)));
  if (child == 0) {
#ifdef __linux__
    // Ends with this program, which may have ended before it was asked for.
    if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || ::getppid() != parent) ::_exit(127);
#endif
    if (silent && (std::freopen("/dev/null", "w", stderr) == nullptr)) ::_exit(127);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace ulpgate::app

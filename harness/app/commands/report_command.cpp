// ulpgate report: starts the report program of reports/ with an interpreter that has what it needs.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <csignal>
#include <cstdlib>
#include <cstring>

#include "harness/app/commands/commands.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

namespace {

// Runs a program and waits; 127 where it cannot be started.
int run_program(const std::vector<std::string>& words, bool silent) {
  std::vector<char*> argv;
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

// The first python3 on PATH may be one without matplotlib; Debian's has its packages.
std::string find_python() {
  const char* chosen = std::getenv("ULPGATE_PYTHON");
  for (const auto& python :
       {std::string(chosen != nullptr ? chosen : "python3"), std::string("/usr/bin/python3")}) {
    if (run_program({python, "-c", "import matplotlib, numpy, jinja2, jsonschema"}, true) == 0) return python;
  }
  throw Failure(
      Standing::environment,
      "no python3 with matplotlib, numpy, jinja2 and jsonschema: install Debian's python3-matplotlib "
      "python3-numpy python3-jinja2 python3-jsonschema, or name one in ULPGATE_PYTHON");
}

// reports/report.py beside the sources: found from the program upwards, or named in ULPGATE_REPORTS.
std::filesystem::path find_report() {
  if (const char* named = std::getenv("ULPGATE_REPORTS")) return std::filesystem::path(named) / "report.py";
  std::error_code code;
  for (auto d = std::filesystem::read_symlink("/proc/self/exe", code); d.has_relative_path();
       d = d.parent_path()) {
    if (std::filesystem::exists(d.parent_path() / "reports/report.py"))
      return d.parent_path() / "reports/report.py";
  }
  throw Failure(Standing::environment,
                "reports/report.py is not found above the program; name its folder in ULPGATE_REPORTS");
}

struct ReportOptions {
  std::string directory;
  std::string out;
  bool print = false;
  std::vector<std::string> axes;  // "X,Y" each; the report program knows the names and refuses others
};

// The report program either writes or prints; both are two runs of it.
Verdict run_report(const ReportOptions& o) {
  const std::vector<std::string> words = {find_python(), find_report().string(), o.directory};
  std::vector<std::vector<std::string>> options;
  if (!o.out.empty()) {
    options.push_back({"--out", o.out});
    for (const auto& pair : o.axes) options.back().push_back("--axes=" + pair);
  }
  if (o.print) options.push_back({"--print"});
  for (const auto& chosen : options) {
    std::vector<std::string> all = words;
    all.insert(all.end(), chosen.begin(), chosen.end());
    const int status = run_program(all, false);
    if (status != 0) return standing_of(status);
  }
  return Standing::pass;
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
  auto* report = app.add_subcommand("report", "Make tables, figures and a page from records");
  auto o = std::make_shared<ReportOptions>();
  report->add_option("DIR", o->directory, "directory of the records")->required();
  auto* out = report->add_option("--out", o->out, "directory of the report");
  report->add_flag("--print", o->print, "print the ULP table");
  report
      ->add_option("--axes", o->axes,
                   "X,Y: draw error against run time with these axes, again for another pair; two of error, "
                   "largest_error, energy_error, seconds, steps, evaluations, dt (without: error,seconds)")
      ->allow_extra_args(false)
      ->needs(out);
  report->callback([=, &action] {
    action = [=] {
      if (o->out.empty() && !o->print)
        throw Failure(Standing::bad_input, "report: give --out DIR, --print or both");
      return run_report(*o);
    };
  });
}

}  // namespace ulpgate::app

// ulpgate: parses the command line, runs the verb, turns failures into messages and exit codes.
#include <fmt/format.h>

#include "harness/app/commands/commands.hpp"
#include "harness/app/machine/build_facts.hpp"
#include "harness/app/machine/ending.hpp"
#include "harness/app/machine/watchdog.hpp"
#include "harness/app/shell/crash_report.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::app {
namespace {

int run(int argc, char** argv) {
  const ulpgate::MpfrThread mpfr;
  CLI::App app("ulpgate measures, explains and gates floating-point error.", "ulpgate");
  app.set_version_flag("--version", fmt::format("ulpgate {}", build_facts::version));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 pass, 1 accuracy regression, 2 bad usage or input, 3 nothing measured or incomplete,\n"
      "4 crash, time-out or I/O failure.");
  Action action;
  double timeout_s = 60;
  add_all_commands(app, action, timeout_s);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const bool asked = e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    const std::string wrong = asked ? "" : wrong_verb(app, argc, argv);
    if (wrong.empty()) {
      app.exit(e);
    } else {
      fmt::print(stderr, "ulpgate: {} (ulpgate --help)\n", wrong);
    }
    return exit_code(asked ? Standing::pass : Standing::bad_input);
  }
  const Ending ending = end_of(action, timeout_s);
  if (!ending.message.empty()) fmt::print(stderr, "ulpgate: {}\n", ending.message);
  return exit_code(ending.standing);
}

}  // namespace
}  // namespace ulpgate::app

int main(int argc, char** argv) {
  ulpgate::app::install_crash_report();
  const int code = ulpgate::app::run(argc, argv);
  ulpgate::app::ends_by_itself();
  return code;
}

// ulpgate: parses the command line, runs the verb, turns failures into messages and exit codes.
#include <fmt/format.h>

#include <sstream>

#include "harness/app/commands/commands.hpp"
#include "harness/app/machine/build_facts.hpp"
#include "harness/app/machine/ending.hpp"
#include "harness/app/machine/watchdog.hpp"
#include "harness/app/shell/crash_report.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::app {
namespace {

int run(int argc, char** argv) {
  const ulpgate::MpfrThread mpfr;
  CLI::App app("ulpgate measures, explains and gates floating-point error.", "ulpgate");
  app.set_version_flag("--version", fmt::format("ulpgate {}", build_facts::version));
  app.require_subcommand(1);
  set_foot(app, {"ulpgate list functions", "ulpgate at sin double 1e22"},
           "Each verb has a --help of its own: ulpgate math --help");
  Action action;
  double timeout_s = 60;
  add_all_commands(app, action, timeout_s);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const bool asked = e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    const std::string wrong = asked ? "" : wrong_verb(app, argc, argv);
    if (wrong.empty()) {
      std::ostringstream out;
      std::ostringstream err;
      app.exit(e, out, err);
      show_text(out.str());
      fmt::print(stderr, "{}", err.str());
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

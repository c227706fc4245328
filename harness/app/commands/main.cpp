// ulpgate: parses the command line, runs the verb, turns failures into messages and exit codes.
#include <fmt/format.h>

#include <cstdio>

#include "harness/app/commands/commands.hpp"
#include "harness/app/shell/crash_report.hpp"
#include "harness/app/store/build_facts.hpp"
#include "harness/app/store/context.hpp"

int main(int argc, char** argv) {
  using namespace ulpgate::app;
  install_crash_report();
  const ulpgate::MpfrThread mpfr;
  CLI::App app("ulpgate measures, explains and gates floating-point error.", "ulpgate");
  app.set_version_flag("--version", fmt::format("ulpgate {}", build_facts::version));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 pass, 1 accuracy regression, 2 bad usage or input, 3 nothing measured or incomplete,\n"
      "4 crash, time-out or I/O failure.");
  Action action;
  add_list_command(app, action);
  add_math_command(app, action);
  add_kernels_command(app, action);
  add_integrators_command(app, action);
  add_scene_command(app, action);
  add_at_command(app, action);
  add_search_command(app, action);
  add_merge_command(app, action);
  add_gate_command(app, action);
  add_report_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const bool asked = e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    app.exit(e);
    return static_cast<int>(asked ? ExitCode::pass : ExitCode::bad_input);
  }
  try {
    assert_floating_point_environment();
    const ExitCode code = action();
    // What was written before has left its mark where it failed.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw Failure(ExitCode::environment, "cannot write to standard output");
    return static_cast<int>(code);
  } catch (const Failure& e) {
    fmt::print(stderr, "ulpgate: {}\n", e.what());
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    fmt::print(stderr, "ulpgate: internal error: {}\n", e.what());
    return static_cast<int>(ExitCode::environment);
  }
}

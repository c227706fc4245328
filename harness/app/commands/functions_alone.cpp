// The verbs of a program of functions alone (ULPGATE_FUNCTIONS_ONLY), added in the order of its help.
#include <fmt/format.h>

#include <array>

#include "harness/app/claims/claims_command.hpp"
#include "harness/app/commands/commands.hpp"
#include "harness/app/machine/watchdog.hpp"
#include "harness/app/report_commands/report_commands.hpp"
#include "harness/app/shell/strict_options.hpp"
#include "harness/core/verdict/verdict.hpp"

namespace ulpgate::app {

namespace {

// Known, so that whoever asks for one learns why it is not there; not in the help.
void add_absent(CLI::App& app, Action& action, const char* verb) {
  auto* absent = app.add_subcommand(verb, "");
  absent->group("")->allow_extras();
  absent->callback([&action, verb] {
    action = [verb]() -> Verdict {
      throw Failure(Standing::bad_input,
                    fmt::format("{} is no verb of this program, which was built for functions alone: "
                                "configure it with -DULPGATE_FUNCTIONS_ONLY=OFF",
                                verb));
    };
  });
}

}  // namespace

void add_all_commands(CLI::App& app, Action& action, double& timeout_s) {
  add_list_command(app, action);
  add_math_command(app, action);
  add_at_command(app, action);
  add_search_command(app, action);
  add_claims_command(app, action);
  add_merge_command(app, action);
  add_report_command(app, action);
  add_compare_output_command(app, action);
  for (const char* verb : {"kernels", "integrators", "scene", "stress", "work-precision", "advise", "gate",
                           "history", "compare"})
    add_absent(app, action, verb);
  add_timeout_option(app, timeout_s);
  make_options_strict(app);
}

}  // namespace ulpgate::app

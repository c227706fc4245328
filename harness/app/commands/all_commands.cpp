// All verbs of ulpgate, added to the command line in the order of its help.
#include "harness/app/claims/claims_command.hpp"
#include "harness/app/commands/commands.hpp"
#include "harness/app/history_commands/history_commands.hpp"
#include "harness/app/machine/watchdog.hpp"
#include "harness/app/report_commands/report_commands.hpp"
#include "harness/app/shell/strict_options.hpp"
#include "harness/app/stress_commands/stress_commands.hpp"

namespace ulpgate::app {

void add_all_commands(CLI::App& app, Action& action, double& timeout_s) {
  add_list_command(app, action, listings_of_scenes());
  add_math_command(app, action);
  add_kernels_command(app, action);
  add_integrators_command(app, action);
  add_scene_command(app, action);
  add_stress_command(app, action);
  add_work_precision_command(app, action);
  add_advise_command(app, action);
  add_at_command(app, action);
  add_search_command(app, action);
  add_claims_command(app, action);
  add_merge_command(app, action);
  add_gate_command(app, action);
  add_report_command(app, action);
  add_compare_output_command(app, action);
  add_history_command(app, action);
  add_compare_command(app, action);
  add_timeout_option(app, timeout_s);
  make_options_strict(app);
}

}  // namespace ulpgate::app

// The verbs of the command line that are not about functions alone; each adds its subcommand and runs when it
// was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "harness/app/function_commands/function_commands.hpp"
#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

// What `ulpgate list` knows besides functions: kernels, scenes and integrators.
[[nodiscard]] std::vector<Listing> listings_of_scenes();
void add_kernels_command(CLI::App& app, Action& action);
void add_integrators_command(CLI::App& app, Action& action);
void add_scene_command(CLI::App& app, Action& action);
void add_gate_command(CLI::App& app, Action& action);

// Every verb of this program, --timeout (written to `timeout_s`) and strictness.
void add_all_commands(CLI::App& app, Action& action, double& timeout_s);

}  // namespace ulpgate::app

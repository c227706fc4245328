// The verbs of the command line; each adds its subcommand and runs when it was chosen.
#pragma once

#include <CLI/CLI.hpp>

#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

class Ranks;

void add_list_command(CLI::App& app, Action& action);
// The ranks of an MPI job, asked for when the verb runs; nullptr where the process is alone.
using RanksOfJob = std::function<Ranks*()>;

void add_math_command(CLI::App& app, Action& action, const RanksOfJob& ranks = {});
void add_kernels_command(CLI::App& app, Action& action);
void add_integrators_command(CLI::App& app, Action& action);
void add_scene_command(CLI::App& app, Action& action);
void add_at_command(CLI::App& app, Action& action);
void add_search_command(CLI::App& app, Action& action);
void add_merge_command(CLI::App& app, Action& action);
void add_gate_command(CLI::App& app, Action& action);

// Every verb, --timeout (written to `timeout_s`) and strictness.
void add_all_commands(CLI::App& app, Action& action, double& timeout_s);

}  // namespace ulpgate::app

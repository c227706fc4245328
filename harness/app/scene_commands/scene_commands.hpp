// The sub-verbs of `ulpgate scene`; each adds itself to the verb and runs when it was chosen.
#pragma once

#include <CLI/CLI.hpp>

#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

void add_scene_run_command(CLI::App& scene, Action& action);
void add_scene_explain_command(CLI::App& scene, Action& action);
void add_scene_compare_command(CLI::App& scene, Action& action);
void add_scene_ladder_command(CLI::App& scene, Action& action);
void add_scene_correlate_command(CLI::App& scene, Action& action);
void add_scene_speed_command(CLI::App& scene, Action& action);

}  // namespace ulpgate::app

// The verbs about stiff and extreme cases, and about error against run time.
#pragma once

#include <CLI/CLI.hpp>

#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

void add_stress_command(CLI::App& app, Action& action);
void add_work_precision_command(CLI::App& app, Action& action);
void add_advise_command(CLI::App& app, Action& action);

}  // namespace ulpgate::app

// The verbs about more runs than one.
#pragma once

#include <CLI/CLI.hpp>

#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

void add_history_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);

}  // namespace ulpgate::app

// The verbs that programs of reports/ carry out.
#pragma once

#include <CLI/CLI.hpp>

#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

void add_report_command(CLI::App& app, Action& action);
void add_compare_output_command(CLI::App& app, Action& action);

}  // namespace ulpgate::app

// The verb `claims`.
#pragma once

#include <CLI/CLI.hpp>

#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

void add_claims_command(CLI::App& app, Action& action);

}  // namespace ulpgate::app

// Budget files: one TOML file per type, DIR/<token>.toml.
#pragma once

#include <filesystem>

#include "harness/core/gate/budgets.hpp"

namespace ulpgate::app {

// Errors name file, line and key.  A directory without budget files gives an empty set, none at all a
// Failure. A file tells the plan of its limits, and no limit is infinite.
[[nodiscard]] Budgets read_budgets(const std::filesystem::path& directory);
// Every file is read back before any old one is replaced.
void write_budgets(const std::filesystem::path& directory, const Budgets& budgets);

}  // namespace ulpgate::app

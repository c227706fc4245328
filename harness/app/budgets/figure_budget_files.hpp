// Budget files of rows with named figures: one TOML file per scene, problem or kind of case, DIR/<name>.toml.
#pragma once

#include <filesystem>

#include "harness/core/gate/figure_budgets.hpp"

namespace ulpgate::app {

// Of a directory that exists; every row limits something of its kind, by finite numbers.
[[nodiscard]] FigureBudgets read_figure_budgets(const std::filesystem::path& directory, RowKind of);
// Every file is read back before any old one is replaced; numbers that are not finite are refused.
void write_figure_budgets(const std::filesystem::path& directory, RowKind of, const FigureBudgets& budgets);

}  // namespace ulpgate::app

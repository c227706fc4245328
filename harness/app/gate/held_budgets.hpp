// The budgets that hold for records: the base, and what a platform lays over it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/budgets/budget_files.hpp"
#include "harness/app/budgets/figure_budget_files.hpp"
#include "harness/app/budgets/platform_budgets.hpp"
#include "harness/app/gate/gate_suite.hpp"
#include "harness/app/machine/machine_facts.hpp"
#include "harness/core/gate/platform_rows.hpp"

namespace ulpgate::app {

// The platform of the records, as the rules say; nothing where the budgets know none, or only the base is
// asked for.
[[nodiscard]] std::optional<PlatformBudgets> platform_for(const std::string& records,
                                                          const std::string& budgets,
                                                          const nlohmann::ordered_json& context,
                                                          const GateRules& rules);

// Files of one kind of budgets: how they are read and written.
struct SampleFiles {
  using All = Budgets;
  [[nodiscard]] static All read(const std::filesystem::path& directory) { return read_budgets(directory); }
  static void write(const std::filesystem::path& directory, const All& all) { write_budgets(directory, all); }
};
struct FigureFiles {
  using All = FigureBudgets;
  RowKind of = RowKind::scene;
  [[nodiscard]] All read(const std::filesystem::path& directory) const {
    return read_figure_budgets(directory, of);
  }
  void write(const std::filesystem::path& directory, const All& all) const {
    write_figure_budgets(directory, of, all);
  }
};

template <class Files>
struct HeldBudgets {
  using All = typename Files::All;
  All base;
  All overlay;
  [[nodiscard]] All held() const { return overlaid(base, overlay); }
};

// Throws a Failure of bad_input where rows of a platform are of another plan than the base.
void check_overlay(const Budgets& base, const Budgets& overlay, const std::filesystem::path& directory);
inline void check_overlay(const FigureBudgets& /*base*/, const FigureBudgets& /*overlay*/,
                          const std::filesystem::path& /*directory*/) {}

template <class Files>
[[nodiscard]] HeldBudgets<Files> read_held(const Files& files, const std::string& budgets,
                                           const std::optional<PlatformBudgets>& platform) {
  HeldBudgets<Files> held;
  held.base = files.read(budgets);
  if (!platform) return held;
  const auto directory = platform->overlay_directory();
  if (directory.empty() || !std::filesystem::is_directory(directory)) return held;
  held.overlay = files.read(directory);
  check_overlay(held.base, held.overlay, directory);
  return held;
}

}  // namespace ulpgate::app

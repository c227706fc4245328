// The records of a directory as rows with figures: what each verb leaves, for one judgement of all.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/app/reading/run_context.hpp"
#include "harness/core/gate/figure_budgets.hpp"

namespace ulpgate::app {

struct MeasuredRows {
  RowKind of = RowKind::scene;
  Json context;
  std::vector<MeasuredRow> rows;
};

// Whether `directory` holds records that have figures rather than samples: scenes, orders, drift, stress or
// work and precision.
[[nodiscard]] bool has_measured_rows(const std::filesystem::path& directory);
// Of a whole run.  Throws a Failure that names file and line for what no run wrote, incomplete where the run
// is not.
[[nodiscard]] MeasuredRows read_measured_rows(const std::filesystem::path& directory);

}  // namespace ulpgate::app

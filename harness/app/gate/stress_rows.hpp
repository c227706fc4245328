// Records of stiff and extreme cases as the gate reads them.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/app/reading/run_context.hpp"
#include "harness/core/gate/figure_budgets.hpp"

namespace ulpgate::app {

inline constexpr const char* stress_records_file = "stress.jsonl";

// Of DIR/stress.jsonl.  A row's verdict is its outcome; one that is not as known is a breach.  Throws a
// Failure that names file and line.
[[nodiscard]] std::vector<MeasuredRow> stress_rows(const std::filesystem::path& directory,
                                                   const Json& context);

}  // namespace ulpgate::app

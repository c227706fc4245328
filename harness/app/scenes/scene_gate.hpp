// The gate over records of scenes: scenes.jsonl, correlation.jsonl and collisions.jsonl.
#pragma once

#include <filesystem>

#include "harness/core/gate/figure_budgets.hpp"

namespace ulpgate::app {

// Whether `directory` holds records of scenes.
[[nodiscard]] bool has_scene_records(const std::filesystem::path& directory);
// Of `directory`, which holds a whole run of one plan.  Throws a Failure that names file and line: for rows
// of another plan, negative numbers and second records of a run too.
[[nodiscard]] std::vector<MeasuredRow> read_scene_measurements(const std::filesystem::path& directory);

}  // namespace ulpgate::app

// Records: directories of records.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/app/reading/row_text.hpp"
#include "harness/app/reading/run_context.hpp"
#include "harness/core/plan/plan.hpp"

namespace ulpgate::app {

// The files of a run's directory; a directory holds the records of one plan.
inline constexpr const char* math_records_file = "math.jsonl";
inline constexpr const char* kernel_records_file = "kernels.jsonl";
inline constexpr const char* scene_records_file = "scenes.jsonl";
// Beside them, under no checksum: no two runs have the same.
inline constexpr const char* timing_file = "timing.jsonl";
inline constexpr const char* timing_repeats_file = "timing_repeats.jsonl";

struct RecordSet {
  Json context;
  std::vector<RowRecord> records;
  std::string file;  // name of the file that holds them
  // Rows of an unfinished run that were dealt to its shards and are not there, or not all of their samples.
  std::vector<std::string> absent;
};
// Of math or kernels.  Throws a Failure that names file and line: bad_input for what the run did not write,
// incomplete where nothing was measured or a row of a finished run is absent.
[[nodiscard]] RecordSet read_records(const std::filesystem::path& directory);
// Those of a finished run: also held to the rows of the plan.
[[nodiscard]] RecordSet read_finished_records(const std::filesystem::path& out, const Plan& plan);
// Sorted by (function, part, type, stratum), a JSON object a line.
[[nodiscard]] std::string records_text(std::vector<RowRecord> records);

}  // namespace ulpgate::app

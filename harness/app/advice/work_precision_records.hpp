// Records of work and precision read back: what advice may rest on.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "harness/app/reading/line_kinds.hpp"
#include "harness/core/work_precision/work_precision_row.hpp"

namespace ulpgate::app {

inline constexpr const char* work_precision_file = "work_precision.jsonl";
inline constexpr const char* fits_file = "work_precision_fits.jsonl";
inline constexpr const char* times_file = "work_precision_timing.jsonl";

extern const LineKind work_precision_lines;

struct KnownSetting {
  std::string place;  // "DIR/work_precision.jsonl:12"
  WorkPrecisionRow row;
  std::optional<double> seconds;  // the least; of a setting that was timed
};

// Settings by key.  Throws a Failure that names file and line for what no run wrote, and another_machine
// where times were taken on another machine or by another program.
[[nodiscard]] std::map<std::string, KnownSetting> read_work_precision(const std::filesystem::path& directory);

}  // namespace ulpgate::app

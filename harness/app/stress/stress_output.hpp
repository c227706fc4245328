// What `ulpgate stress` writes: records, a table for people, verdicts.
#pragma once

#include <string>
#include <vector>

#include "harness/app/shell/files.hpp"
#include "harness/app/stress/stress_job.hpp"

namespace ulpgate::app {

constexpr const char* stress_file = "stress.jsonl";

// A row and back, nothing lost.  stress_row_of throws std::invalid_argument where `j` is none.
[[nodiscard]] Json stress_json(const StressRow& row);
[[nodiscard]] StressRow stress_row_of(const Json& j);

// The line of stress.jsonl of a complete measurement; empty where its case does not exist in the type.
[[nodiscard]] std::string stress_line(const StressMeasurement& m, const std::string& plan);
// A line for each case: the letters of its verdicts by type, with a mark where one is not as known.
[[nodiscard]] std::string stress_table(const StressJob& job);

struct StressFindings {
  std::size_t judged = 0;
  std::vector<std::string> unexplained;  // verdicts that are not as known, with their reproducers
};
[[nodiscard]] StressFindings judge_stress_job(const StressJob& job);
[[nodiscard]] Json to_json(const StressFindings& findings);
// Throws a Failure where `j` is none; `place` stands in its message.
[[nodiscard]] StressFindings stress_findings_of(const Json& j, const std::string& place);

}  // namespace ulpgate::app

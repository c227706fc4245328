// Outputs of the gate: texts that are made from its results, for people and for other programs.
#pragma once

#include <string>
#include <vector>

#include "harness/core/gate/findings/gate_result.hpp"

namespace ulpgate::app {

// The lines of stdout: failing rows, the worst first, each with what reproduces it; then what can be lowered.
[[nodiscard]] std::string text_report(const std::vector<GateResult>& results);
// The same as an object: "exit_code" and "verdict" of the gate, "sets" of records with theirs, "findings".
[[nodiscard]] std::string json_report(const std::vector<GateResult>& results);

// JUnit XML: a suite for each directory of records, in it one test case for the directory and one a row of a
// type.  What is beyond a budget is a failure, what was not judged an error.
[[nodiscard]] std::string junit_report(const std::vector<GateResult>& results);
// GitHub-flavoured Markdown of less than 1 MiB, the limit of a step's summary: the worst 20, then counts.
[[nodiscard]] std::string markdown_report(const std::vector<GateResult>& results);
// OpenMetrics 1.0 text: what was measured, its budget and their ratio by row; counts of findings.
[[nodiscard]] std::string openmetrics_report(const std::vector<GateResult>& results);
// SARIF 2.1.0: failing rows, located where their budget stands.
[[nodiscard]] std::string sarif_report(const std::vector<GateResult>& results);

// Where outputs go; empty: nowhere.
struct OutputFiles {
  std::string junit, markdown, openmetrics, sarif;
};
// Throws a Failure of bad_input where two are the same file.
void check_output_files(const OutputFiles& files);
// Each is complete or not there.  Writes all that can be written, then throws a Failure of environment for
// the first that could not.
void write_outputs(const OutputFiles& files, const std::vector<GateResult>& results);

}  // namespace ulpgate::app

// What ulpgate compare prints: differences as text, Markdown and JSON.
#pragma once

#include <string>

#include "harness/app/history/run_differences.hpp"

namespace ulpgate::app {

// Two directories and what tells them apart.
struct Comparison {
  const RunSummary& before;
  const RunSummary& after;
  const RunDifferences& found;
};

// Rows that differ, one a line, at most `most` of a kind; then what the platforms differ in and the counts.
[[nodiscard]] std::string comparison_text(const Comparison& c, std::size_t most);
// The same as tables for a page of a pipeline, the worst first.
[[nodiscard]] std::string comparison_markdown(const Comparison& c, std::size_t most);
[[nodiscard]] std::string comparison_json(const Comparison& c);

}  // namespace ulpgate::app

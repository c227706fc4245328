// Files of outputs.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>
#include <set>

#include "harness/app/gate_output/outputs.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

namespace {

struct Output {
  std::string OutputFiles::*file;
  std::string (*text)(const std::vector<GateResult>& results);
};
constexpr std::array<Output, 4> outputs = {{{&OutputFiles::junit, junit_report},
                                            {&OutputFiles::markdown, markdown_report},
                                            {&OutputFiles::openmetrics, openmetrics_report},
                                            {&OutputFiles::sarif, sarif_report}}};

}  // namespace

void check_output_files(const OutputFiles& files) {
  std::set<std::filesystem::path> seen;
  for (const auto& output : outputs) {
    const std::string& file = files.*output.file;
    if (!file.empty() && !seen.insert(std::filesystem::absolute(file).lexically_normal()).second)
      throw Failure(Standing::bad_input, fmt::format("{}: two outputs cannot be one file", file));
  }
}

void write_outputs(const OutputFiles& files, const std::vector<GateResult>& results) {
  std::optional<Failure> first;
  for (const auto& output : outputs) {
    const std::string& file = files.*output.file;
    if (file.empty()) continue;
    try {
      write_file(file, output.text(results));
    } catch (const Failure& failure) {
      if (!first) first = failure;
    }
  }
  if (first) throw Failure(Standing::environment, first->what());
}

}  // namespace ulpgate::app

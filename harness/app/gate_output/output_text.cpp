// Texts that outputs of the gate share.
#include "harness/app/gate_output/output_text.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "harness/app/budgets/toml_text.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

std::string valid_utf8(const std::string& text) {
  using Json = nlohmann::json;
  const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(quoted).get<std::string>();
}

std::string verdict_words(const std::vector<GateResult>& results) {
  const Verdict verdict = verdict_of(results);
  const std::size_t failed = count_of(results, FindingKind::regression);
  const std::size_t other = count_of(results, FindingKind::other_results);
  std::string found = fmt::format("{} findings beyond their budget", failed);
  if (other > 0) found += fmt::format(", {} rows with other results", other);
  switch (exit_code(verdict.standing())) {
    case 0:
      return "passes";
    case 1:
      return failed + other > 0 ? "red: " + found : "red: what was measured contradicts itself";
    case 3:
      return "incomplete: there is no verdict, not all that is budgeted was measured and judged";
    default:
      return failed + other > 0 ? "no verdict, and " + found : "no verdict: nothing could be judged";
  }
}

std::vector<std::pair<std::string, std::string>> details_of(const GateFinding& f) {
  std::vector<std::pair<std::string, std::string>> details;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) details.emplace_back(name, value);
  };
  add("reproduce", f.reproduce);
  std::string arguments;
  for (const auto& a : f.at) arguments += (arguments.empty() ? "" : ", ") + with_decimal(a);
  add("argument", arguments);
  add("got", with_decimal(f.got));
  add("wanted", with_decimal(f.wanted));
  add("whole row", f.again);
  return details;
}

namespace {

// The line of "[budget.<key>]" by key.
std::map<std::string, std::size_t> lines_of(const std::filesystem::path& file) {
  std::map<std::string, std::size_t> found;
  try {
    const auto lines = read_lines(file);
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].starts_with("[budget.") && lines[i].ends_with("]")) found.emplace(lines[i], i + 1);
  } catch (const Failure&) {
    // A file that is not there yet has no lines.
  }
  return found;
}

}  // namespace

std::vector<BudgetPlace> budget_places(const std::vector<PlacedFinding>& findings) {
  std::map<std::filesystem::path, std::map<std::string, std::size_t>> known;
  std::vector<BudgetPlace> places;
  for (const auto& [result, finding] : findings) {
    const std::string name = (finding->budget_file.empty() ? finding->type : finding->budget_file) + ".toml";
    BudgetPlace place{(std::filesystem::path(result->budgets_directory) / name).string(), 1};
    // What a platform lays over the base is what was judged by.
    for (const auto& directory : {result->platform_directory, result->budgets_directory}) {
      if (directory.empty() || finding->budget_key.empty()) continue;
      const auto file = std::filesystem::path(directory) / name;
      const auto [lines, fresh] = known.try_emplace(file);
      if (fresh) lines->second = lines_of(file);
      const auto line = lines->second.find(fmt::format("[budget.{}]", toml_quoted(finding->budget_key)));
      if (line == lines->second.end()) continue;
      place = {file.string(), line->second};
      break;
    }
    places.push_back(std::move(place));
  }
  return places;
}

}  // namespace ulpgate::app

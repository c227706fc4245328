// SARIF 2.1.0 (OASIS standard, "Static Analysis Results Interchange Format").
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "harness/app/gate_output/output_text.hpp"
#include "harness/app/gate_output/outputs.hpp"
#include "harness/app/machine/build_facts.hpp"

namespace ulpgate::app {

namespace {

using Json = nlohmann::ordered_json;

// By FindingKind; what can be lowered fails nothing.
constexpr std::array<const char*, finding_kind_count - 1> descriptions = {
    "A figure is beyond its budget, or what holds whatever a budget says does not",
    "Within every limit, the results are not those that the budget was made of",
    "The points are of another seed or size than those of the budget",
    "A row was measured that has no budget",
    "A budgeted row was not measured",
    "A row was not measured whole",
    "A list of arguments is shorter, or its worst error far below its budget: cases were lost"};

// RFC 3986: what is neither unreserved nor a slash is percent-encoded.
std::string uri_text(const std::string& path) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
  std::string out;
  for (const char c : path) {
    out += plain.find(c) != std::string_view::npos ? std::string(1, c)
                                                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

// Below the working directory, which is the root of the sources where a pipeline runs the gate, relative to
// it.
Json artifact_of(const std::string& file) {
  std::error_code code;
  const auto here = std::filesystem::current_path(code);
  const auto whole = std::filesystem::absolute(file, code).lexically_normal();
  const auto relative = whole.lexically_relative(here);
  if (!relative.empty() && *relative.begin() != "..")
    return {{"uri", uri_text(relative.generic_string())}, {"uriBaseId", "%SRCROOT%"}};
  return {{"uri", "file://" + uri_text(whole.generic_string())}};
}

Json result_of(const PlacedFinding& placed, const BudgetPlace& place) {
  const GateFinding& f = *placed.finding;
  std::string message = fmt::format("{} {}: {}", f.row, f.type, f.message);
  Json properties = {{"records", placed.result->records_directory}, {"of", to_string(f.of)}};
  for (const auto& [name, value] : details_of(f)) {
    message += fmt::format("\n{}: {}", name, value);
    properties[name] = value;
  }
  return {
      {"ruleId", to_string(f.kind)},
      {"ruleIndex", static_cast<std::size_t>(f.kind)},
      {"level", standing_of(f.kind) != Standing::incomplete ? "error" : "warning"},
      {"message", {{"text", message}}},
      {"locations",
       Json::array(
           {{{"physicalLocation",
              {{"artifactLocation", artifact_of(place.file)}, {"region", {{"startLine", place.line}}}}},
             {"logicalLocations",
              Json::array({{{"fullyQualifiedName", fmt::format("{}/{}/{}", to_string(f.of), f.type, f.row)},
                            {"kind", "member"}}})}}})},
      {"partialFingerprints",
       {{"row/v1", fmt::format("{} {} {} {} {}", to_string(f.kind), f.type, f.row, f.stratum, f.what)}}},
      {"properties", properties}};
}

}  // namespace

std::string sarif_report(const std::vector<GateResult>& results) {
  Json rules = Json::array();
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    const std::string id(to_string(static_cast<FindingKind>(k)));
    rules.push_back({{"id", id}, {"shortDescription", {{"text", descriptions[k]}}}});
  }
  const auto findings = worst_first(results);
  const auto places = budget_places(findings);
  Json found = Json::array();
  for (std::size_t i = 0; i < findings.size(); ++i) found.push_back(result_of(findings[i], places[i]));
  Json notifications = Json::array();
  for (const auto& r : results) {
    for (const auto& remark : r.remarks)
      notifications.push_back(
          {{"level", "error"}, {"message", {{"text", fmt::format("{}: {}", r.records_directory, remark)}}}});
  }
  const int code = exit_code(verdict_of(results).standing());
  const Json run = {
      {"tool", {{"driver", {{"name", "ulpgate"}, {"version", build_facts::version}, {"rules", rules}}}}},
      {"invocations", Json::array({{{"executionSuccessful", code == 0 || code == 1},
                                    {"exitCode", code},
                                    {"toolExecutionNotifications", notifications}}})},
      {"results", found},
      {"columnKind", "utf16CodeUnits"}};
  const Json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                    {"version", "2.1.0"},
                    {"runs", Json::array({run})}};
  return log.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ulpgate::app

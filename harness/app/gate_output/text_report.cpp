// What the gate prints.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "harness/app/gate_output/output_text.hpp"
#include "harness/app/gate_output/outputs.hpp"
#include "harness/app/reading/json_fields.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_not_measured = 10;

// All findings: failing ones, then notes.
std::vector<PlacedFinding> with_notes(const std::vector<GateResult>& results) {
  std::vector<PlacedFinding> all = worst_first(results);
  for (const auto& r : results) {
    for (const auto& f : r.findings)
      if (f.kind == FindingKind::could_lower) all.push_back({&r, &f});
  }
  return all;
}

Paint paint_of(FindingKind kind) {
  const bool note = kind == FindingKind::could_lower || kind == FindingKind::missing_record;
  return note ? Paint::note : Paint::bad;
}

// Lines that show a finding again; of what needs none: "".
std::string details_text(const GateFinding& f) {
  if (f.kind == FindingKind::could_lower) return "";
  std::string text;
  for (const auto& [name, value] : details_of(f)) text += fmt::format("{:<12}   {}: {}\n", "", name, value);
  return text;
}

// Places in `all` of findings that the same argument of the same row shows, in the order of the worst of
// each; a group begins with its largest error, if it has one.  A function that is wrong by much is beyond a
// dozen limits at once.
std::vector<std::vector<std::size_t>> shown_together(const std::vector<PlacedFinding>& all) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [result, f] = all[i];
    const std::string details = details_text(*f);
    const auto [group, fresh] = known.try_emplace(
        fmt::format("{}\n{}\n{}\n{}", result->records_directory, f->row, f->type, details), groups.size());
    if (fresh || details.empty()) {
      groups.push_back({i});
    } else {
      auto& places = groups[group->second];
      places.insert(f->what.starts_with("maximum") ? places.begin() : places.end(), i);
    }
  }
  return groups;
}

}  // namespace

std::string text_report(const std::vector<GateResult>& results) {
  const std::vector<PlacedFinding> all = with_notes(results);
  std::string text;
  std::size_t not_measured = 0;
  for (const auto& group : shown_together(all)) {
    for (const std::size_t i : group) {
      const auto& [result, f] = all[i];
      // Records of a few functions held to the budgets of all: a line each would bury what failed.
      if (f->kind == FindingKind::missing_record && ++not_measured > most_not_measured) continue;
      const std::string of = results.size() > 1 ? fmt::format(" [{}]", result->records_directory) : "";
      const std::string label = painted(paint_of(f->kind), fmt::format("{:<12}", label_of(f->kind)));
      text += fmt::format("{} {} {}: {}{}\n", label, f->row, f->type, f->message, of);
      if (i == group.front()) text += details_text(*f);
    }
  }
  if (not_measured > most_not_measured)
    text += fmt::format("{:<12} {} rows more; --only-measured holds what was measured to its budgets alone\n",
                        label_of(FindingKind::missing_record), not_measured - most_not_measured);
  return text;
}

std::string json_report(const std::vector<GateResult>& results) {
  Json rows = Json::array();
  for (const auto& [result, f] : with_notes(results)) {
    rows.push_back({{"kind", label_of(f->kind)},
                    {"function", f->row},
                    {"type", f->type},
                    {"message", f->message},
                    {"args", f->at},
                    {"reproduce", f->reproduce},
                    {"of", to_string(f->of)},
                    {"stratum", f->stratum},
                    {"what", f->what},
                    {"measured", number_or_null(f->measured)},
                    {"budget", number_or_null(f->budget)},
                    {"got", f->got},
                    {"wanted", f->wanted},
                    {"records", result->records_directory}});
  }
  Json sets = Json::array();
  for (const auto& r : results) {
    sets.push_back({{"records", r.records_directory},
                    {"exit_code", exit_code(r.verdict.standing())},
                    {"judged", r.records},
                    {"failed", r.verdict.count(Standing::regression)},
                    {"incomplete", r.verdict.count(Standing::incomplete)},
                    {"remarks", r.remarks}});
  }
  const Json all = {{"exit_code", exit_code(verdict_of(results).standing())},
                    {"verdict", verdict_words(results)},
                    {"sets", sets},
                    {"findings", rows}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ulpgate::app

// StressJob.
#include "harness/app/stress/stress_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/stress/stress_output.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/catalogue/catalogue.hpp"

namespace ulpgate::app {

namespace {

std::vector<std::string> distinct(std::string StressCase::*member) {
  std::vector<std::string> names;
  for (const auto& c : stress_catalogue()) {
    if (std::ranges::find(names, c.*member) == names.end()) names.push_back(c.*member);
  }
  return names;
}

// A case is chosen by its name, for all of its forms, or by name/form or kind/name/form.
bool names_case(const std::string& chosen, const StressCase& c) {
  return chosen == c.name || chosen == c.key() || (!c.form.empty() && chosen == c.name + "/" + c.form);
}

// How much slower a type is than double, roughly: which cases are the long ones.
double slowness_of_bits(long bits) {
  return bits <= 64 ? 1 : 10 + static_cast<double>(bits) / 10;
}
double slowness_of(const std::string& token) {
  return slowness_of_bits(type_or_fail(token).format.precision);
}

}  // namespace

std::string StressMeasurement::measure_piece(long /*steps*/, const ode::StopFlag& stop) {
  try {
    row_ = case_.run(token_, stop);
  } catch (const ode::Stopped&) {
    throw;
  } catch (const std::exception& e) {
    // A case that fails is a finding of its own: nothing it could have said is taken for good.
    row_ = StressRow();
    row_->verdict = StressVerdict::refused;
    row_->why = e.what();
  }
  complete_ = true;
  return row_ ? stress_json(*row_).dump() : "null";
}

bool StressMeasurement::take_piece(std::string_view piece) {
  if (complete_) return false;
  const Json j = Json::parse(piece, nullptr, false);
  if (j.is_discarded()) throw std::invalid_argument("no row of a stress case");
  row_ = j.is_null() ? std::nullopt : std::optional(stress_row_of(j));
  complete_ = true;
  return true;
}

std::vector<const StressCase*> select_cases(const std::string& cases, const std::string& kinds) {
  const auto all_kinds = distinct(&StressCase::kind);
  const auto wanted_kinds = kinds == "all" ? all_kinds : split(kinds, ',');
  for (const auto& k : wanted_kinds) {
    if (std::ranges::find(all_kinds, k) == all_kinds.end()) unknown_name("kind", k, all_kinds);
  }
  const bool all = cases == "all";
  const auto wanted = all ? std::vector<std::string>() : split(cases, ',');
  for (const auto& name : wanted) {
    if (std::ranges::any_of(stress_catalogue(), [&](const auto& c) { return names_case(name, c); })) continue;
    unknown_name("case", name, distinct(&StressCase::name));
  }
  std::vector<const StressCase*> chosen;
  for (const auto& c : stress_catalogue()) {
    if (std::ranges::find(wanted_kinds, c.kind) == wanted_kinds.end()) continue;
    if (all || std::ranges::any_of(wanted, [&](const auto& name) { return names_case(name, c); }))
      chosen.push_back(&c);
  }
  if (chosen.empty()) throw Failure(Standing::bad_input, "--cases and --kinds together name no case");
  return chosen;
}

StressJob make_stress_job(const StressOptions& o) {
  StressJob job;
  job.types = select_types(o.types);
  job.cases = select_cases(o.cases, o.kinds);
  std::string keys;
  for (std::size_t i = 0; i < job.cases.size(); ++i) {
    const StressCase& c = *job.cases[i];
    keys += c.key() + "\n";
    // What holds in every type, of a trajectory five runs of 62 digits, is found with the case's first: so
    // much dearer than its other rows that these come later in the queue than to compute it once more beside
    // it.
    double shared = 5 * slowness_of_bits(207);
    for (const auto& token : job.types) {
      job.measurements.push_back(std::make_unique<StressMeasurement>(c, token));
      job.names.push_back(c.key() + " " + token);
      job.costs.push_back({i, c.cost * (shared + slowness_of(token)), 1});
      shared = 0;
    }
  }
  job.plan_text = fmt::format("ulpgate stress plan 1\ntypes {}\n{}", fmt::join(job.types, " "), keys);
  job.plan = fmt::format("{:016x}", fnv1a(job.plan_text));
  return job;
}

}  // namespace ulpgate::app

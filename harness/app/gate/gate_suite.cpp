// A suite of the gate.
#include "harness/app/gate/gate_suite.hpp"

#include <fmt/format.h>

#include "harness/app/gate/held_budgets.hpp"
#include "harness/app/gate/measured_rows.hpp"
#include "harness/app/run/record_verdicts.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/store/records.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

// Says where records come from another machine than their budgets: limits that are exceeded by little may be
// that.
void note_other_machines(const Budgets& budgets, const RecordSet& set) {
  const auto here = deciding_facts(set.context);
  std::map<std::string, std::string> told;  // differences: types
  for (const auto& [token, type] : budgets) {
    if (type.machine.empty()) continue;
    std::string differences;
    for (const auto& [fact, value] : type.machine) {
      const auto mine = here.find(fact);
      if (mine != here.end() && mine->second != value)
        differences +=
            fmt::format("{}{} '{}', not '{}'", differences.empty() ? "" : "; ", fact, mine->second, value);
    }
    if (!differences.empty()) told[differences] += (told[differences].empty() ? "" : ", ") + token;
  }
  for (const auto& [differences, types] : told)
    fmt::print(stderr, "ulpgate: note: {}: measured on another machine than the budgets: {}\n", types,
               differences);
}

void use_platform(const std::optional<PlatformBudgets>& platform, GateResult& result) {
  if (!platform) return;
  result.platform = platform->words();
  result.platform_directory = platform->overlay_directory().string();
  fmt::print(stderr, "ulpgate: {}: {}\n", result.budgets_directory, result.platform);
}

// Digests hold where they were taken: on a platform without budgets of its own other libraries compute.
template <class Files>
typename Files::All held_here(const HeldBudgets<Files>& both,
                              const std::optional<PlatformBudgets>& platform) {
  auto held = both.held();
  using Match = PlatformBudgets::Match;
  if (platform && platform->match != Match::base && platform->match != Match::exact) forget_digests(held);
  return held;
}

void add_findings(GateResult& result, std::vector<GateFinding> findings) {
  for (const auto& f : findings) result.verdict.add(standing_of(f.kind));
  result.findings = std::move(findings);
}

Failure no_budgets(const std::string& budgets) {
  return Failure(Standing::incomplete, fmt::format("{}: no budgets; write them with --update", budgets));
}

// Lowers the budgets, those of the platform where it has its own rows, the base's only on its own platform.
template <class Files, class Tighten>
void tighten(const Files& files, HeldBudgets<Files>& held, const std::optional<PlatformBudgets>& platform,
             const GateResult& result, Tighten lower) {
  if (!result.verdict.passes()) {
    fmt::print(stderr, "ulpgate: {}: nothing tightened: its rows do not pass\n", result.records_directory);
    return;
  }
  const auto match = platform ? platform->match : PlatformBudgets::Match::base;
  if (match != PlatformBudgets::Match::base && match != PlatformBudgets::Match::exact) {
    throw Failure(Standing::another_machine,
                  fmt::format("{}: measured with {}, which has no budgets of its own to tighten",
                              result.records_directory, platform->here.words()));
  }
  const bool of_base = match == PlatformBudgets::Match::base;
  auto& own = of_base ? held.base : held.overlay;
  const auto changes = lower(own);
  for (const auto& c : changes) show("tightened {} {}: {}\n", c.row, c.type, c.what);
  const std::filesystem::path directory = of_base ? result.budgets_directory : result.platform_directory;
  if (!changes.empty()) files.write(directory, own);
  fmt::print(stderr, "ulpgate: {} budgets tightened in {}\n", changes.size(), directory.string());
}

void judge_samples(const GateRules& rules, GateResult& result) {
  const RecordSet set = read_records(result.records_directory);
  result.records = set.records.size();
  if (set.records.empty())
    throw Failure(Standing::nothing_measured, fmt::format("{}: no records", result.records_directory));
  const auto platform = platform_for(result.records_directory, result.budgets_directory, set.context, rules);
  const SampleFiles files;
  auto both = read_held(files, result.budgets_directory, platform);
  const Budgets held = held_here(both, platform);
  if (held.empty()) throw no_budgets(result.budgets_directory);
  use_platform(platform, result);
  for (const auto& other : other_codes(set.records, held)) {
    fmt::print(stderr, "ulpgate: note: {}: {} rows were measured with {}, their budgets with {}\n",
               other.type, other.rows, other.measured, other.budgeted);
  }
  note_other_machines(held, set);
  result.rows = judged_rows(set.records, held);
  add_findings(result,
               judge_records(set.records, held, rules.missing(), {rules.other_plan, rules.least_samples}));
  if (!set.context.at("complete").get<bool>()) {
    result.verdict.add(Standing::incomplete);
    result.remarks.push_back(fmt::format("{}: the run is not complete", result.records_directory));
  }
  const Verdict oracles = oracle_verdict(set.records);
  if (!oracles.passes()) result.remarks.push_back("the oracles disagree (stderr of the gate names the rows)");
  result.verdict |= oracles;
  if (rules.tighten) {
    tighten(files, both, platform, result, [&](Budgets& own) { return tighten_budgets(own, set.records); });
  }
}

void judge_measured(const GateRules& rules, GateResult& result) {
  if (rules.other_plan || rules.least_samples) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}: --other-plan and --least-samples are for samples, which it has none of",
                              result.records_directory));
  }
  const MeasuredRows measured = read_measured_rows(result.records_directory);
  result.records = measured.rows.size();
  const auto platform =
      platform_for(result.records_directory, result.budgets_directory, measured.context, rules);
  const FigureFiles files{measured.of};
  auto both = read_held(files, result.budgets_directory, platform);
  const FigureBudgets held = held_here(both, platform);
  if (held.empty()) throw no_budgets(result.budgets_directory);
  use_platform(platform, result);
  result.rows = judged_rows(measured.rows, held);
  add_findings(result, judge_figures(measured.rows, held, rules.missing()));
  if (rules.tighten) {
    tighten(files, both, platform, result,
            [&](FigureBudgets& own) { return tighten_figure_budgets(own, measured.rows); });
  }
}

}  // namespace

GateResult judge_suite(const std::string& records, const std::string& budgets, const GateRules& rules) {
  GateResult result;
  result.records_directory = records;
  result.budgets_directory = budgets;
  try {
    if (has_measured_rows(records)) {
      judge_measured(rules, result);
    } else {
      judge_samples(rules, result);
    }
  } catch (const Failure& failure) {
    result.verdict.add(failure.standing());
    result.remarks.emplace_back(failure.what());
  }
  return result;
}

}  // namespace ulpgate::app

// Budgets written from records.
#include <fmt/format.h>

#include "harness/app/gate/gate_suite.hpp"
#include "harness/app/gate/held_budgets.hpp"
#include "harness/app/gate/measured_rows.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/store/records.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/gate/bounds.hpp"

namespace ulpgate::app {

namespace {

// Budgets come from whole runs.
void want_complete(const std::string& budgets, const std::string& directory, const RecordSet& set) {
  for (const auto& r : set.records) {
    if (measured(r.summary.samples, r.planned) != Standing::pass) {
      throw Failure(Standing::incomplete,
                    fmt::format("{}: {} {} {} is incomplete: budgets come from whole runs", directory,
                                r.subject, r.type, r.stratum));
    }
  }
  const auto complete = set.context.find("complete");
  if (complete == set.context.end() || !complete->is_boolean() || !complete->get<bool>()) {
    throw Failure(Standing::incomplete,
                  fmt::format("{}: the run is not complete: the budgets of {} come from "
                              "whole runs",
                              directory, budgets));
  }
}

std::uint64_t count_in(const RecordSet& set, const std::string& directory, const char* key) {
  const auto it = set.context.find(key);
  if (it == set.context.end() || !it->is_number_unsigned()) {
    throw Failure(Standing::bad_input, fmt::format("{}/context.json: '{}' must be a number", directory, key));
  }
  return it->get<std::uint64_t>();
}

// What the other seeds' maxima bound.
void add_bounds_of_seeds(const GateRules& rules, const std::string& budgets, Budgets& measured,
                         std::uint64_t own_seed) {
  std::vector<std::vector<RowRecord>> seeds;
  for (const auto& directory : rules.seeds) {
    RecordSet set = read_records(directory);
    want_complete(budgets, directory, set);
    if (count_in(set, directory, "seed") == own_seed) {
      throw Failure(Standing::bad_input,
                    fmt::format("{} is of seed {}, which the budgets are of: bounds come from other seeds",
                                directory, own_seed));
    }
    seeds.push_back(std::move(set.records));
  }
  add_bounds(measured, seeds);
}

// Says what would become looser; whether it may.
bool may_loosen(const GateRules& rules, const std::vector<Raise>& raises) {
  for (const auto& r : raises) {
    show("{} {} {}: {}\n", rules.reason.empty() ? "WOULD LOOSEN" : "loosened", r.row, r.type, r.what);
  }
  if (raises.empty() || !rules.reason.empty()) return true;
  fmt::print(stderr, "ulpgate: nothing written: a budget is loosened only with --reason TEXT\n");
  return false;
}

// No budget is made of what is wrong whatever a budget says.
bool is_sound(const std::vector<MeasuredRow>& measured) {
  const auto wrong = breaches(measured);
  for (const auto& f : wrong) {
    show("{:<12} {} {}: {}\n", label_of(f.kind), f.row, f.type, f.message);
    show("{:<12}   reproduce: {}\n", "", f.reproduce);
  }
  if (!wrong.empty())
    fmt::print(stderr, "ulpgate: nothing written: {} rows are wrong whatever a budget says\n", wrong.size());
  return wrong.empty();
}

// The base becomes what was measured, where the records are of its platform.
template <class Files, class Update>
Verdict update_base(const Files& files, const std::string& records, const std::string& budgets,
                    const std::optional<PlatformBudgets>& platform, const GateRules& rules, Update update) {
  if (platform && platform->match != PlatformBudgets::Match::base) {
    throw Failure(
        Standing::another_machine,
        fmt::format("{}: measured with {}, the budgets of {} are of {}: --platform auto writes the rows "
                    "that differ, --platform base writes these budgets all the same",
                    records, platform->here.words(), budgets, platform->base.words()));
  }
  typename Files::All present;
  if (std::filesystem::is_directory(budgets)) present = files.read(budgets);
  if (!may_loosen(rules, update(present))) return Standing::regression;
  files.write(budgets, present);
  fmt::print(stderr, "ulpgate: budgets of {} files written to {}\n", present.size(), budgets);
  return Standing::pass;
}

// The rows of the platform that are not those of the base.  `rows_of` gives those that do not hold, `merge`
// puts them over what the platform has already.
template <class Files, class RowsOf>
Verdict update_platform(const Files& files, const std::string& budgets, const PlatformBudgets& platform,
                        const GateRules& rules, NewPlatforms& made, RowsOf rows_of) {
  const auto held = read_held(files, budgets, platform);
  const auto of_platform = platform.root / platform.here.key();
  if (platform.match != PlatformBudgets::Match::exact) made.insert(of_platform);
  const bool known = !made.contains(of_platform);
  // A first run needs no reason of its own; later ones would loosen what was known.
  const std::string reason = !rules.reason.empty() ? rules.reason
                             : known               ? ""
                                                   : "as measured with " + platform.here.words();
  const auto found = rows_of(held.held(), reason);
  for (const auto& change : found.changes) {
    show("{} {} {}: {}\n", reason.empty() ? "WOULD LOOSEN" : "of the platform", change.row, change.type,
         change.what);
  }
  if (!found.changes.empty() && reason.empty()) {
    fmt::print(stderr, "ulpgate: nothing written: the budgets of {} change only with --reason TEXT\n",
               platform.here.words());
    return Standing::regression;
  }
  const auto all = overlaid(held.overlay, found.rows);
  make_platform(platform);
  if (!all.empty()) files.write(platform.directory_of(platform.here), all);
  fmt::print(stderr, "ulpgate: {} rows of {} written to {}\n", found.changes.size(), platform.here.words(),
             platform.directory_of(platform.here).string());
  return Standing::pass;
}

Verdict update_samples(const std::string& records, const std::string& budgets, const GateRules& rules,
                       NewPlatforms& made) {
  const RecordSet set = read_records(records);
  if (set.records.empty()) throw Failure(Standing::nothing_measured, fmt::format("{}: no records", records));
  want_complete(budgets, records, set);
  const std::uint64_t samples = count_in(set, records, "samples");
  const std::uint64_t seed = count_in(set, records, "seed");
  const auto platform = platform_for(records, budgets, set.context, rules);
  const Budgets present = std::filesystem::is_directory(budgets) ? read_budgets(budgets) : Budgets{};
  const std::string why = why_another_plan(present, set.records, samples, seed);
  if (!why.empty()) throw Failure(Standing::another_plan, fmt::format("{}: {}", records, why));
  Budgets measured = measured_budgets(set.records, samples, seed);
  add_bounds_of_seeds(rules, budgets, measured, seed);
  for (auto& [token, type] : measured) type.machine = deciding_facts(set.context);
  const SampleFiles files;
  if (rules.platform == "auto" && platform && platform->match != PlatformBudgets::Match::base) {
    return update_platform(files, budgets, *platform, rules, made,
                           [&](const Budgets& held, const std::string& reason) {
                             return platform_rows(held, measured, set.records, reason);
                           });
  }
  return update_base(files, records, budgets, platform, rules,
                     [&](Budgets& all) { return update_budgets(all, measured, rules.reason); });
}

Verdict update_figures(const std::string& records, const std::string& budgets, const GateRules& rules,
                       NewPlatforms& made) {
  if (!rules.seeds.empty())
    throw Failure(Standing::bad_input,
                  fmt::format("{}: --seeds is for samples, which it has none of", records));
  const MeasuredRows measured = read_measured_rows(records);
  if (!is_sound(measured.rows)) return Standing::regression;
  const auto platform = platform_for(records, budgets, measured.context, rules);
  const FigureFiles files{measured.of};
  if (rules.platform == "auto" && platform && platform->match != PlatformBudgets::Match::base) {
    return update_platform(files, budgets, *platform, rules, made,
                           [&](const FigureBudgets& held, const std::string& reason) {
                             return platform_rows(held, measured.rows, reason);
                           });
  }
  return update_base(files, records, budgets, platform, rules, [&](FigureBudgets& all) {
    return update_figure_budgets(all, measured.rows, rules.reason);
  });
}

}  // namespace

Verdict update_suite(const std::string& records, const std::string& budgets, const GateRules& rules,
                     NewPlatforms& made) {
  return has_measured_rows(records) ? update_figures(records, budgets, rules, made)
                                    : update_samples(records, budgets, rules, made);
}

}  // namespace ulpgate::app

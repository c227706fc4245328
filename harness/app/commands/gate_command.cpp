// ulpgate gate: holds records against budgets; its exit code is what a merge waits for.
#include <fmt/format.h>

#include "harness/app/budgets/budget_files.hpp"
#include "harness/app/commands/commands.hpp"
#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/run/record_verdicts.hpp"
#include "harness/app/scenes/scene_gate.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/gate/bounds.hpp"
#include "harness/core/verdict/verdict.hpp"

namespace ulpgate::app {

namespace {

struct GateOptions {
  std::string directory;
  std::string budgets;
  bool update = false;
  std::string reason;
  std::vector<std::string> seeds;
  bool only_measured = false;
  bool other_plan = false;
  std::optional<std::uint64_t> least_samples;
  bool json = false;

  [[nodiscard]] MissingRecords missing() const {
    return only_measured ? MissingRecords::ignore : MissingRecords::fail;
  }
};

std::string_view name_of(FindingKind kind) {
  constexpr std::string_view names[] = {"FAIL",       "ANOTHER PLAN", "NO BUDGET", "NOT MEASURED",
                                        "INCOMPLETE", "LOST CASES",   "note"};
  return names[static_cast<std::size_t>(kind)];
}

Standing standing_of(FindingKind kind) {
  switch (kind) {
    case FindingKind::regression:
      return Standing::regression;
    case FindingKind::another_plan:
      return Standing::another_plan;
    case FindingKind::could_lower:
      return Standing::pass;
    default:
      return Standing::incomplete;
  }
}

std::string reproducer(const GateFinding& f) {
  if (f.at.empty()) return "";
  // Of a scene it is a command already.
  if (f.at.front().starts_with("ulpgate ")) return f.at.front();
  std::string text = fmt::format("ulpgate at {} {}", f.row.substr(0, f.row.find('.')), f.type);
  for (const auto& a : f.at) text += " " + a;
  return text;
}

void print(const std::vector<GateFinding>& findings, bool json) {
  Json rows = Json::array();
  for (const auto& f : findings) {
    if (json) {
      rows.push_back({{"kind", name_of(f.kind)},
                      {"function", f.row},
                      {"type", f.type},
                      {"message", f.message},
                      {"args", f.at},
                      {"reproduce", reproducer(f)}});
      continue;
    }
    fmt::print("{:<12} {} {}: {}\n", name_of(f.kind), f.row, f.type, f.message);
    if (!f.at.empty()) fmt::print("{:<12}   reproduce: {}\n", "", reproducer(f));
  }
  if (json) fmt::print("{}\n", rows.dump(2));
}

// Budgets come from whole runs.
void want_complete(const GateOptions& o, const std::string& directory, const RecordSet& set) {
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
                              directory, o.budgets));
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
void add_bounds_of_seeds(const GateOptions& o, Budgets& measured, std::uint64_t own_seed) {
  std::vector<std::vector<RowRecord>> seeds;
  for (const auto& directory : o.seeds) {
    RecordSet set = read_records(directory);
    want_complete(o, directory, set);
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
bool may_loosen(const GateOptions& o, const std::vector<Raise>& raises) {
  for (const auto& r : raises) {
    fmt::print("{} {} {}: {}\n", o.reason.empty() ? "WOULD LOOSEN" : "loosened", r.row, r.type, r.what);
  }
  if (raises.empty() || !o.reason.empty()) return true;
  fmt::print(stderr, "ulpgate: nothing written: a budget is loosened only with --reason TEXT\n");
  return false;
}

Verdict update(const GateOptions& o, const RecordSet& set) {
  want_complete(o, o.directory, set);
  const std::uint64_t samples = count_in(set, o.directory, "samples");
  const std::uint64_t seed = count_in(set, o.directory, "seed");
  Budgets present = std::filesystem::is_directory(o.budgets) ? read_budgets(o.budgets) : Budgets{};
  const std::string why = why_another_plan(present, set.records, samples, seed);
  if (!why.empty()) throw Failure(Standing::another_plan, fmt::format("{}: {}", o.directory, why));
  Budgets measured = measured_budgets(set.records, samples, seed);
  add_bounds_of_seeds(o, measured, seed);
  for (auto& [token, type] : measured) type.machine = deciding_facts(set.context);
  if (!may_loosen(o, update_budgets(present, measured, o.reason))) return Standing::regression;
  write_budgets(o.budgets, present);
  fmt::print(stderr, "ulpgate: budgets of {} types written to {}\n", present.size(), o.budgets);
  return Standing::pass;
}

// Prints the findings and counts them.
Verdict verdict(const GateOptions& o, const std::vector<GateFinding>& findings, std::size_t records,
                bool complete) {
  print(findings, o.json);
  Verdict verdict;
  for (const auto& f : findings) verdict.add(standing_of(f.kind));
  if (!complete) {
    fmt::print(stderr, "ulpgate: {}: the run is not complete\n", o.directory);
    verdict.add(Standing::incomplete);
  }
  const std::uint64_t other = verdict.count(Standing::another_plan);
  fmt::print(stderr, "ulpgate: gate: {} records, {} failed, {} incomplete or without budget{}\n", records,
             verdict.count(Standing::regression), verdict.count(Standing::incomplete),
             other > 0 ? fmt::format(", {} of another plan", other) : "");
  return verdict;
}

Failure no_budgets(const GateOptions& o) {
  return Failure(Standing::incomplete, fmt::format("{}: no budgets; write them with --update", o.budgets));
}

Verdict gate_scenes(const GateOptions& o) {
  if (o.other_plan || o.least_samples || !o.seeds.empty()) {
    throw Failure(Standing::bad_input,
                  "--other-plan, --least-samples and --seeds are for samples, which scenes have none of");
  }
  const auto measured = read_scene_measurements(o.directory);
  if (measured.empty()) throw Failure(Standing::nothing_measured, fmt::format("{}: no records", o.directory));
  SceneBudgets budgets;
  if (!o.update || std::filesystem::is_directory(o.budgets)) budgets = read_scene_budgets(o.budgets);
  if (!o.update) {
    if (budgets.empty()) throw no_budgets(o);
    return verdict(o, judge_scenes(measured, budgets, o.missing()), measured.size(), true);
  }
  if (!may_loosen(o, update_scene_budgets(budgets, measured, o.reason))) return Standing::regression;
  write_scene_budgets(o.budgets, budgets);
  fmt::print(stderr, "ulpgate: budgets of {} scenes written to {}\n", budgets.size(), o.budgets);
  return Standing::pass;
}

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

Verdict run_gate(const GateOptions& o) {
  if (!o.update && (!o.reason.empty() || !o.seeds.empty()))
    throw Failure(Standing::bad_input, "--reason and --seeds are of --update: nothing is written without it");
  if (o.update && (o.other_plan || o.only_measured)) {
    throw Failure(Standing::bad_input,
                  "--update writes the rows that were measured by the budgets' plan: --other-plan and "
                  "--only-measured are for judging");
  }
  if (o.least_samples && !o.other_plan)
    throw Failure(Standing::bad_input,
                  "--least-samples is of --other-plan: no other plan is judged without it");
  if (has_scene_records(o.directory)) return gate_scenes(o);
  const RecordSet set = read_records(o.directory);
  if (set.records.empty())
    throw Failure(Standing::nothing_measured, fmt::format("{}: no records", o.directory));
  if (o.update) return update(o, set);
  const Budgets budgets = read_budgets(o.budgets);
  if (budgets.empty()) throw no_budgets(o);
  for (const auto& other : other_codes(set.records, budgets)) {
    fmt::print(stderr, "ulpgate: note: {}: {} rows were measured with {}, their budgets with {}\n",
               other.type, other.rows, other.measured, other.budgeted);
  }
  note_other_machines(budgets, set);
  const auto findings = judge_records(set.records, budgets, o.missing(), {o.other_plan, o.least_samples});
  Verdict judged = verdict(o, findings, set.records.size(), set.context.at("complete").get<bool>());
  judged |= oracle_verdict(set.records);
  return judged;
}

}  // namespace

void add_gate_command(CLI::App& app, Action& action) {
  auto* gate = app.add_subcommand("gate", "Hold records against budgets");
  auto o = std::make_shared<GateOptions>();
  gate->add_option("DIR", o->directory, "directory of the records")->required();
  gate->add_option("--budgets", o->budgets, "directory of the budgets, <type>.toml each")->required();
  gate->add_flag("--update", o->update, "write what was measured by the budgets' plan; limits only fall");
  gate->add_option("--reason", o->reason,
                   "with --update: why limits may become looser; stands in the budget file");
  gate->add_option("--seeds", o->seeds,
                   "with --update: directories of records of other seeds, three at least, whose maxima bound "
                   "those of any seed")
      ->delimiter(',');
  gate->add_flag("--only-measured", o->only_measured, "do not ask for records of every budgeted row");
  gate->add_flag("--other-plan", o->other_plan,
                 "hold drawn strata of another seed or size to what no seed exceeds; refused without");
  gate->add_option("--least-samples", o->least_samples,
                   "with --other-plan: fewer of a stratum are too few to judge (default: a tenth of the "
                   "budget's)");
  gate->add_flag("--json", o->json, "print the findings as JSON");
  gate->callback([=, &action] { action = [=] { return run_gate(*o); }; });
}

}  // namespace ulpgate::app

// ulpgate gate: holds records against budgets; its exit code is what a merge waits for.
#include <fmt/format.h>

#include "harness/app/commands/commands.hpp"
#include "harness/app/scenes/scene_gate.hpp"
#include "harness/app/store/budget_files.hpp"
#include "harness/app/store/records.hpp"

namespace ulpgate::app {

namespace {

struct GateOptions {
  std::string directory;
  std::string budgets;
  bool update = false;
  std::string reason;
  bool only_measured = false;
  bool json = false;
};

std::string_view name_of(FindingKind kind) {
  constexpr std::string_view names[] = {"FAIL", "NO BUDGET", "NOT MEASURED", "INCOMPLETE", "note"};
  return names[static_cast<std::size_t>(kind)];
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

ExitCode update(const GateOptions& o, const RecordSet& set) {
  for (const auto& r : set.records) {
    if (r.summary.samples != r.planned) {
      throw Failure(ExitCode::incomplete,
                    fmt::format("{}: {} {} {} is incomplete: budgets come from whole runs", o.directory,
                                r.subject, r.type, r.stratum));
    }
  }
  Budgets present = std::filesystem::is_directory(o.budgets) ? read_budgets(o.budgets) : Budgets{};
  const Budgets measured = measured_budgets(set.records, set.context.at("samples"), set.context.at("seed"));
  const auto raises = update_budgets(present, measured, o.reason);
  for (const auto& r : raises) {
    fmt::print("{} {} {}: {}\n", o.reason.empty() ? "WOULD RAISE" : "raised", r.row, r.type, r.what);
  }
  if (!raises.empty() && o.reason.empty()) {
    fmt::print(stderr, "ulpgate: nothing written: a budget rises only with --reason TEXT\n");
    return ExitCode::regression;
  }
  write_budgets(o.budgets, present);
  fmt::print(stderr, "ulpgate: budgets of {} types written to {}\n", present.size(), o.budgets);
  return ExitCode::pass;
}

// Prints the findings and counts them.
ExitCode verdict(const GateOptions& o, const std::vector<GateFinding>& findings, std::size_t records,
                 bool complete) {
  print(findings, o.json);
  std::size_t failed = 0;
  std::size_t incomplete = 0;
  for (const auto& f : findings) {
    failed += f.kind == FindingKind::regression ? 1U : 0U;
    incomplete += f.kind != FindingKind::regression && f.kind != FindingKind::could_lower ? 1U : 0U;
  }
  if (!complete) {
    fmt::print(stderr, "ulpgate: {}: the run is not complete\n", o.directory);
    ++incomplete;
  }
  fmt::print(stderr, "ulpgate: gate: {} records, {} failed, {} incomplete or without budget\n", records,
             failed, incomplete);
  if (failed > 0) return ExitCode::regression;
  return incomplete > 0 ? ExitCode::incomplete : ExitCode::pass;
}

ExitCode gate_scenes(const GateOptions& o) {
  const auto measured = read_scene_measurements(o.directory);
  if (measured.empty()) throw Failure(ExitCode::incomplete, fmt::format("{}: no records", o.directory));
  SceneBudgets budgets = read_scene_budgets(o.budgets);
  if (!o.update) {
    if (budgets.empty())
      throw Failure(ExitCode::incomplete, fmt::format("{}: no budgets; write them with --update", o.budgets));
    return verdict(
        o, judge_scenes(measured, budgets, o.only_measured ? MissingRecords::ignore : MissingRecords::fail),
        measured.size(), true);
  }
  const auto raises = update_scene_budgets(budgets, measured, o.reason);
  for (const auto& r : raises)
    fmt::print("{} {} {}:{}\n", o.reason.empty() ? "WOULD LOOSEN" : "loosened", r.row, r.type, r.what);
  if (!raises.empty() && o.reason.empty()) {
    fmt::print(stderr, "ulpgate: nothing written: a budget is loosened only with --reason TEXT\n");
    return ExitCode::regression;
  }
  write_scene_budgets(o.budgets, budgets);
  fmt::print(stderr, "ulpgate: budgets of {} scenes written to {}\n", budgets.size(), o.budgets);
  return ExitCode::pass;
}

ExitCode run_gate(const GateOptions& o) {
  if (has_scene_records(o.directory)) return gate_scenes(o);
  const RecordSet set = read_records(o.directory);
  if (set.records.empty()) throw Failure(ExitCode::incomplete, fmt::format("{}: no records", o.directory));
  if (o.update) return update(o, set);
  const Budgets budgets = read_budgets(o.budgets);
  if (budgets.empty()) {
    throw Failure(ExitCode::incomplete, fmt::format("{}: no budgets; write them with --update", o.budgets));
  }
  for (const auto& other : other_codes(set.records, budgets)) {
    fmt::print(stderr, "ulpgate: note: {}: {} rows were measured with {}, their budgets with {}\n",
               other.type, other.rows, other.measured, other.budgeted);
  }
  const auto findings =
      judge_records(set.records, budgets, o.only_measured ? MissingRecords::ignore : MissingRecords::fail);
  return verdict(o, findings, set.records.size(), set.context.value("complete", false));
}

}  // namespace

void add_gate_command(CLI::App& app, Action& action) {
  auto* gate = app.add_subcommand("gate", "Hold records against budgets");
  auto o = std::make_shared<GateOptions>();
  gate->add_option("DIR", o->directory, "directory of the records")->required();
  gate->add_option("--budgets", o->budgets, "directory of the budgets, <type>.toml each")->required();
  gate->add_flag("--update", o->update, "write what was measured as budgets; limits only fall");
  gate->add_option("--reason", o->reason, "with --update: why limits may rise; stands in the budget file");
  gate->add_flag("--only-measured", o->only_measured, "do not ask for records of every budgeted row");
  gate->add_flag("--json", o->json, "print the findings as JSON");
  gate->callback([=, &action] { action = [=] { return run_gate(*o); }; });
}

}  // namespace ulpgate::app

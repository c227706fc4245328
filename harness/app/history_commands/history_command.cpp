// ulpgate history: runs in one file, how a row went from run to run, and the commits at which rows stepped.
#include <fmt/format.h>

#include "harness/app/history_commands/history_commands.hpp"
#include "harness/app/history_commands/history_output.hpp"
#include "harness/app/history_commands/revision.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

struct HistoryOptions {
  std::string name, type;
  std::vector<std::string> add;
  std::string commit;
  std::optional<std::int64_t> time_s;
  std::string file = "history.sqlite";
  bool steps = false;
  bool json = false;
};

Verdict add_runs(const HistoryOptions& o) {
  // All are read before any is kept: a bad one among them keeps none.
  std::vector<RunSummary> runs;
  for (const auto& directory : o.add) runs.push_back(read_run_summary(directory));
  const std::string commit = revision_of(o.commit);
  HistoryFile file(o.file, Database::Access::write);
  std::string said;
  Transaction transaction = file.begin();
  for (const auto& run : runs) {
    const bool added = file.add(run, commit, o.time_s.value_or(run.time_s));
    said += fmt::format("ulpgate: {}: {}, {} rows and {} times of {}\n", run.directory.string(),
                        added ? "added to " + o.file : o.file + " has it already", run.rows.size(),
                        run.times.size(), short_commit(commit));
  }
  file.keep_steps(all_steps(file));
  transaction.commit();
  fmt::print(stderr, "{}", said);
  return Standing::pass;
}

void print_steps(const std::vector<HistoryRun>& runs, const std::vector<HistoryStep>& steps) {
  for (const auto& step : steps) show("{}", step_line(runs, step));
}

Json steps_json(const std::vector<HistoryRun>& runs, const std::vector<HistoryStep>& steps) {
  Json rows = Json::array();
  for (const auto& step : steps) rows.push_back(step_json(runs, step));
  return rows;
}

void want_runs(const HistoryFile& file, const HistoryOptions& o) {
  if (file.runs().empty())
    throw Failure(Standing::nothing_measured, fmt::format("{}: no run is in it", o.file));
}

Verdict show_steps(const HistoryOptions& o) {
  HistoryFile file(o.file, Database::Access::read);
  want_runs(file, o);
  const auto steps = all_steps(file);
  if (o.json) {
    fmt::print("{}\n", steps_json(file.runs(), steps).dump(2));
  } else {
    print_steps(file.runs(), steps);
    fmt::print(stderr, "ulpgate: {} steps in {} runs\n", steps.size(), file.runs().size());
  }
  return Standing::pass;
}

std::string value_text(const RowResult& result) {
  std::string text = result.error ? fmt::format("{:.5g}", *result.error) : "-";
  // Whatever has no error of its own is marked, not hidden behind the error of the others.
  if (result.mismatches > 0) text += fmt::format(" !{}", result.mismatches);
  return text;
}

TrendColumn accuracy_column(HistoryFile& file, const RowKey& key, const std::vector<RowPoint>& points) {
  const RowKind* kind = find_row_kind(key.kind);
  TrendColumn column{key, kind == nullptr ? "" : std::string(kind->unit), {}, {}};
  column.values.resize(file.runs().size());
  column.texts.resize(file.runs().size());
  for (const auto& p : points) {
    const RowResult result = file.result(p.result);
    column.values[p.run] = result.error;
    column.texts[p.run] = value_text(result);
  }
  return column;
}

TrendColumn speed_column(const HistoryFile& file, const SpeedHistory& speed, const RowKey& key) {
  const double unit = key.kind == "time" ? 1e-9 : 1;
  TrendColumn column{key, key.kind == "time" ? "ns an evaluation" : "s", {}, {}};
  column.values.resize(file.runs().size());
  column.texts.resize(file.runs().size());
  for (const auto& level : speed.levels(key)) {
    column.values[level.run] = level.seconds / unit;
    column.texts[level.run] = fmt::format("{:.4g}", level.seconds / unit);
  }
  return column;
}

Json column_json(const HistoryFile& file, const TrendColumn& column) {
  Json values = Json::array();
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    if (column.texts[i].empty()) continue;
    const auto& x = column.values[i];
    Json value = x && std::isinf(*x)   ? Json("inf")
                 : x && std::isnan(*x) ? Json("nan")
                 : x                   ? Json(*x)
                                       : Json(nullptr);
    values.push_back(
        {{"commit", file.runs()[i].commit}, {"time_s", file.runs()[i].time_s}, {"value", value}});
  }
  return {{"kind", column.key.kind},
          {"part", column.key.part},
          {"setting", column.key.setting},
          {"unit", column.unit},
          {"values", values}};
}

Verdict show_trend(const HistoryOptions& o) {
  HistoryFile file(o.file, Database::Access::read);
  want_runs(file, o);
  const RowChoice choice{o.name, o.type};
  std::vector<TrendColumn> columns;
  std::vector<HistoryStep> steps;
  for (const auto& [key, points] : file.rows(choice)) {
    columns.push_back(accuracy_column(file, key, points));
    for (auto& step : accuracy_steps(file, key, points)) steps.push_back(std::move(step));
  }
  // The noise of times is that of all rows.
  const SpeedHistory speed(file.runs(), file.times());
  for (const auto& key : speed.keys()) {
    if (key.name != o.name || key.type != o.type) continue;
    columns.push_back(speed_column(file, speed, key));
    for (auto& step : speed.steps(key)) steps.push_back(std::move(step));
  }
  if (columns.empty()) {
    const auto names = file.names();
    if (std::ranges::find(names, o.name) == names.end()) unknown_name("row of this history", o.name, names);
    throw Failure(Standing::nothing_measured, fmt::format("{}: no run has {} in {}", o.file, o.name, o.type));
  }
  if (o.json) {
    Json rows = Json::array();
    for (const auto& column : columns) rows.push_back(column_json(file, column));
    const Json all = {
        {"name", o.name}, {"type", o.type}, {"series", rows}, {"steps", steps_json(file.runs(), steps)}};
    fmt::print("{}\n", all.dump(2));
    return Standing::pass;
  }
  show("{} {}\n{}", o.name, o.type, trend_table(file.runs(), columns));
  show("{}", steps.empty() ? "no step\n" : "");
  print_steps(file.runs(), steps);
  return Standing::pass;
}

Verdict run_history(const HistoryOptions& o) {
  const int asked = (o.add.empty() ? 0 : 1) + (o.steps ? 1 : 0) + (o.name.empty() ? 0 : 1);
  if (asked != 1 || o.name.empty() != o.type.empty())
    throw Failure(Standing::bad_input, "history: give FUNCTION TYPE, --steps or --add DIR, one of them");
  if (o.add.empty() && (!o.commit.empty() || o.time_s))
    throw Failure(Standing::bad_input, "--commit and --time are of --add");
  if (!o.add.empty() && o.json) throw Failure(Standing::bad_input, "--json is of FUNCTION TYPE and --steps");
  if (!o.add.empty()) return add_runs(o);
  return o.steps ? show_steps(o) : show_trend(o);
}

}  // namespace

void add_history_command(CLI::App& app, Action& action) {
  auto* verb =
      app.add_subcommand("history", "Keep runs in a file; show a trend and the commits at which it stepped");
  set_foot(
      *verb,
      {"ulpgate math --functions exp --types double --timing repeats --samples 2000 --out A && ulpgate "
       "history --add A --db h.sqlite",
       "ulpgate history exp double --db h.sqlite", "ulpgate history --steps --json --db h.sqlite"},
      "Accuracy is deterministic: any change of a figure is a step.  Times are noisy: a step of speed is a "
      "change by 5 % and by five standard errors between levels of three runs at least.");
  auto o = std::make_shared<HistoryOptions>();
  verb->add_option("FUNCTION", o->name, "function, kernel, scene, integrator or case");
  verb->add_option("TYPE", o->type, "token of its type");
  verb->add_option("--add", o->add, "put the finished run of a directory into the file; again for another")
      ->allow_extra_args(false);
  verb->add_option("--commit", o->commit, "with --add: the run's commit (default: what is checked out here)");
  verb->add_option("--time", o->time_s,
                   "with --add: when it ran, seconds since 1970 (default: when its context was written)")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 40U));
  verb->add_option("--db", o->file, "the file")->capture_default_str();
  verb->add_flag("--steps", o->steps, "every row that stepped, with its commit");
  verb->add_flag("--json", o->json, "print JSON");
  verb->callback([=, &action] { action = [=] { return run_history(*o); }; });
}

}  // namespace ulpgate::app

// ulpgate gate: holds records against budgets; its exit code is what a merge waits for.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "harness/app/commands/commands.hpp"
#include "harness/app/gate/gate_suite.hpp"
#include "harness/app/gate_output/outputs.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

struct GateOptions {
  std::vector<std::string> directories;
  std::vector<std::string> budgets;  // one for all, or one each
  GateRules rules;
  OutputFiles files;
  bool json = false;

  [[nodiscard]] const std::string& budgets_of(std::size_t i) const {
    return budgets.size() == 1 ? budgets.front() : budgets[i];
  }
};

void check(const GateOptions& o) {
  const auto refuse = [](const std::string& what) { throw Failure(Standing::bad_input, what); };
  const GateRules& r = o.rules;
  if (!r.update && (!r.reason.empty() || !r.seeds.empty()))
    refuse("--reason and --seeds are of --update: nothing is written without it");
  if (r.update && (r.other_plan || r.only_measured)) {
    refuse(
        "--update writes the rows that were measured by the budgets' plan: --other-plan and "
        "--only-measured are for judging");
  }
  if (r.tighten && (r.other_plan || r.update)) {
    refuse(
        "--tighten lowers the budgets by a run of their own plan that passes: --other-plan and --update are "
        "something else");
  }
  if (r.least_samples && !r.other_plan)
    refuse("--least-samples is of --other-plan: no other plan is judged without it");
  if (o.budgets.size() != 1 && o.budgets.size() != o.directories.size()) {
    refuse(fmt::format("{} directories of records and {} of budgets: give one --budgets for all, or one each",
                       o.directories.size(), o.budgets.size()));
  }
  std::set<std::filesystem::path> seen;
  for (const auto& directory : o.directories) {
    if (!seen.insert(std::filesystem::absolute(directory).lexically_normal()).second)
      refuse(fmt::format("{}: given twice", directory));
  }
  if (r.update && !(o.files.junit + o.files.markdown + o.files.openmetrics + o.files.sarif).empty())
    refuse("--update judges nothing: --junit, --markdown, --openmetrics and --sarif are of a verdict");
  check_output_files(o.files);
}

void print_summary(const GateResult& r, bool alone) {
  for (const auto& remark : r.remarks) fmt::print(stderr, "ulpgate: {}\n", remark);
  const std::uint64_t other = r.verdict.count(Standing::another_plan);
  const std::string line = fmt::format(
      "ulpgate: gate: {}{} records, {} failed, {} incomplete or without budget{}",
      alone ? "" : r.records_directory + ": ", r.records, r.verdict.count(Standing::regression),
      r.verdict.count(Standing::incomplete), other > 0 ? fmt::format(", {} of another plan", other) : "");
  fmt::print(stderr, "{}\n", painted(r.verdict.passes() ? Paint::good : Paint::bad, line, stderr));
}

Verdict run_gate(const GateOptions& o) {
  check(o);
  if (o.rules.update) {
    Verdict verdict;
    NewPlatforms made;
    for (std::size_t i = 0; i < o.directories.size(); ++i) {
      // The others are written all the same.
      try {
        verdict |= update_suite(o.directories[i], o.budgets_of(i), o.rules, made);
      } catch (const Failure& failure) {
        fmt::print(stderr, "ulpgate: {}\n", failure.what());
        verdict.add(failure.standing());
      }
    }
    return verdict;
  }
  std::vector<GateResult> results;
  for (std::size_t i = 0; i < o.directories.size(); ++i)
    results.push_back(judge_suite(o.directories[i], o.budgets_of(i), o.rules));
  // What it came to stands first: hundreds of findings may follow.
  for (const auto& r : results) print_summary(r, results.size() == 1);
  if (o.json) {
    fmt::print("{}", json_report(results));
  } else {
    show_text(text_report(results));
  }
  // The verdict is said before anything can go wrong with a file.
  std::fflush(stdout);
  write_outputs(o.files, results);
  return verdict_of(results);
}

}  // namespace

void add_gate_command(CLI::App& app, Action& action) {
  auto* gate = app.add_subcommand("gate", "Hold records against budgets");
  set_foot(*gate, {"ulpgate gate out/sin --budgets mine --update",
                   "ulpgate gate out/sin --budgets mine --json > gate.json"});
  auto o = std::make_shared<GateOptions>();
  GateRules& rules = o->rules;
  gate->add_option("DIR", o->directories, "directories of records of any verb")->required();
  gate->add_option(
          "--budgets", o->budgets,
          "directory of the budgets, <type>.toml or <name>.toml each; again for each further DIR, or "
          "one for all")
      ->required()
      ->allow_extra_args(false);
  auto* update = gate->add_flag("--update", rules.update,
                                "write what was measured by the budgets' plan; limits only fall");
  gate->add_option("--reason", rules.reason,
                   "with --update: why limits may become looser; stands in the budget file");
  gate->add_option("--seeds", rules.seeds,
                   "with --update: directories of records of other seeds, three at least, whose maxima bound "
                   "those of any seed")
      ->delimiter(',')
      ->allow_extra_args(false);
  gate->add_flag(
          "--tighten", rules.tighten,
          "where all rows pass, lower the budgets that are above twice what was measured; rows that were "
          "raised for a reason stay")
      ->excludes(update);
  gate->add_option(
          "--platform", rules.platform,
          "auto: budgets of the libraries that the records name, with --update the rows that differ from "
          "the base; base: no other than the base (default: auto, with --update the base)")
      ->check(CLI::IsMember({"auto", "base"}));
  gate->add_flag("--only-measured", rules.only_measured, "do not ask for records of every budgeted row");
  gate->add_flag("--other-plan", rules.other_plan,
                 "hold drawn strata of another seed or size to what no seed exceeds; refused without");
  gate->add_option("--least-samples", rules.least_samples,
                   "with --other-plan: fewer of a stratum are too few to judge (default: a tenth of the "
                   "budget's)");
  gate->add_option("--junit", o->files.junit, "write the verdict as JUnit XML");
  gate->add_option("--markdown", o->files.markdown, "write a summary in Markdown: the worst 20, then counts");
  gate->add_option("--openmetrics", o->files.openmetrics,
                   "write what was measured and its budgets as metrics");
  gate->add_option("--sarif", o->files.sarif, "write the failing rows as SARIF 2.1.0");
  gate->add_flag("--json", o->json, "print the findings as JSON");
  gate->callback([=, &action] { action = [=] { return run_gate(*o); }; });
}

}  // namespace ulpgate::app

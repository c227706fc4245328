// ulpgate compare: tells two runs apart, of one platform or of two.
#include <fmt/format.h>

#include "harness/app/history_commands/compare_output.hpp"
#include "harness/app/history_commands/history_commands.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

struct CompareOptions {
  std::string before, after;
  std::string markdown;
  std::size_t most = 20;
  bool only_common = false;
  bool json = false;
};

Verdict verdict_of(const RunDifferences& found, const CompareOptions& o) {
  if (found.compared == 0 && found.times.empty()) {
    throw Failure(
        Standing::nothing_measured,
        fmt::format("{} and {} have no row in common: another seed, number of samples or kind of run",
                    o.before, o.after));
  }
  Verdict verdict;
  verdict.add(Standing::regression, found.count(Change::worse) + found.count_times(Change::worse));
  // What is no longer measured may be what got worse.
  if (!o.only_common) verdict.add(Standing::incomplete, found.only_before.size());
  return verdict;
}

Verdict run_compare(const CompareOptions& o) {
  const RunSummary before = read_run_summary(o.before);
  const RunSummary after = read_run_summary(o.after);
  const RunDifferences found = compare_runs(before, after);
  const Verdict verdict = verdict_of(found, o);
  const Comparison comparison{before, after, found};
  if (!o.markdown.empty()) write_file(o.markdown, comparison_markdown(comparison, o.most));
  if (o.json) {
    fmt::print("{}", comparison_json(comparison));
  } else {
    show_text(comparison_text(comparison, o.most));
  }
  return verdict;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  auto* verb =
      app.add_subcommand("compare", "Tell two runs apart row by row: accuracy exactly, speed beyond noise");
  set_foot(*verb,
           {"ulpgate compare debian12 debian13 --markdown summary.md",
            "ulpgate math --functions exp --types double --timing repeats --samples 2000 --out B && ulpgate "
            "compare A B --json"},
           "Exit 1 where a row of B is worse or slower, 3 where a row of A is not in B.");
  auto o = std::make_shared<CompareOptions>();
  verb->add_option("A", o->before, "directory of the records before")->required();
  verb->add_option("B", o->after, "directory of the records after")->required();
  verb->add_option("--markdown", o->markdown, "write the differences there as tables");
  verb->add_option("--most", o->most, "rows that are shown of each kind of change; JSON has all")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000}));
  verb->add_flag("--only-common", o->only_common, "rows of A that B has not are no fault");
  verb->add_flag("--json", o->json, "print the differences as JSON");
  verb->callback([=, &action] { action = [=] { return run_compare(*o); }; });
}

}  // namespace ulpgate::app
